"""What followed a static problem."""
