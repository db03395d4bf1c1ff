"""What a run says in the end: profiles, coverage, roughness, tables, pictures and one page."""
