"""What is checked before a fit: what was asked for, and what the plugins do."""
