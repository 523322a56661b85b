"""What `new-plugin` begins with: a working example of every kind, and the files around it."""
