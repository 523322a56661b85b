"""A property of laws each: what the data say of it, in % of the output's range, with a p-value and a sentence."""
