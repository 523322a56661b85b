"""Families: where no formula of an effect does as well as its family's free form, the family is what is told."""
