"""What `control` makes of a fitted model: an input, errors to expect, controllers compared."""
