"""A trajectory that is known ahead: the input that makes a fitted model follow it, and with what error."""
