"""How the searches of a study went."""
