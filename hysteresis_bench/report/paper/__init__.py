"""A paper's printed numbers and claims beside ours."""
