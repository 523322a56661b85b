"""Files of a results folder as they are found: what they must look like, and reading what still does."""
