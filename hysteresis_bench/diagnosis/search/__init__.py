"""Hypotheses, a model with effects around it: fitted, tested, selected."""
