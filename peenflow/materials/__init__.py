"""Tables of materials and shots, with their sources, and how a case's choice is looked up in them."""
