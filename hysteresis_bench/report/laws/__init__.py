"""Laws beside each other: the figure, the table, the page of a comparison."""
