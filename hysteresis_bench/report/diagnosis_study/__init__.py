"""The page of a study of diagnosis."""
