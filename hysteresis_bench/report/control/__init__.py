"""The page of a control comparison."""
