"""What a study computes once its trials are in."""
