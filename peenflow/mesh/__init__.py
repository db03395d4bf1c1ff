"""The `mesh` stage: hexahedra of the FE patch and facets for DEM."""
