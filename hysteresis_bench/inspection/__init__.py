"""What is odd about measured records, before any model is fitted to them."""
