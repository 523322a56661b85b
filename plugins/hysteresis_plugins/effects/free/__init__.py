"""Free forms: for every family a curve without a formula, linear in its coefficients."""
