"""Measured data as files: CSV cells, records with units, quantities."""
