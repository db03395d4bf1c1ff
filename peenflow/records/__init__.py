"""What stages hand to each other: frozen records in SI units, their fields declared with unit and shape."""
