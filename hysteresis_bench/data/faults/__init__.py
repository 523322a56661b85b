"""Faults of records that no device made: found without a model, told, and mended or left out."""
