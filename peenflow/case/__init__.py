"""The case: read, checked, in SI units."""
