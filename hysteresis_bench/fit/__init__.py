"""Fitting: a problem, its meter, searches, and the fitted model as a file."""
