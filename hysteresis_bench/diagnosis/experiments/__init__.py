"""What to measure next: the experiments that a bench can play, whether one tells ties apart, and what it did."""
