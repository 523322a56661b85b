"""The page that leads to all kept results: what each of them answers."""
