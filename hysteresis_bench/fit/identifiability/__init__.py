"""What the data determine: standard errors, and parameters that act only together."""
