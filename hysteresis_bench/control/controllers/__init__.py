"""The controllers that close the loop, and how they are tuned."""
