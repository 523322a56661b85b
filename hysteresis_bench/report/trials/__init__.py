"""The numbers of a study's trials: one row an optimizer and problem, and what the tests say of them."""
