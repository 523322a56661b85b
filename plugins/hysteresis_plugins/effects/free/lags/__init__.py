"""The free forms of dynamics before and after the law."""
