"""What this machine does in a second: memory, solver, compilation, DEM."""
