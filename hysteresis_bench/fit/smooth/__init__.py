"""Laws of so many linear parameters that they want to be smooth: solved, not searched."""
