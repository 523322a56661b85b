"""What every kind of plugin promises, a test each."""
