"""The page of one trial, which is run once more for it."""
