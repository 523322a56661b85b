"""What is fuzzed, a kind of input a file."""
