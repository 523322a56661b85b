"""What the data say before any effect is added."""
