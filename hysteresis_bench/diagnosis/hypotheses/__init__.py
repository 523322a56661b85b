"""Hypotheses: a model with effects around it; how one is fitted, compared with another, and tested."""
