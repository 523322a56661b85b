"""Commands on data files, and the options of all commands that read them."""
