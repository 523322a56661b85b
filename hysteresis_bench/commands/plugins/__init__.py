"""Commands for plugins: what there is, a new one, and whether one keeps its promises."""
