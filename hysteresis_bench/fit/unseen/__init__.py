"""What a fit does on samples that it was not shown."""
