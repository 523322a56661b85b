"""A fitted model as a single file that needs nothing of this package."""
