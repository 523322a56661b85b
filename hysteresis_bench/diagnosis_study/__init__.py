"""How often is the diagnosis right? Cases with known truth."""
