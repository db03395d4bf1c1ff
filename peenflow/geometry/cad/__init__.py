"""Faces of a solid, from a STEP file or built in memory, read by OpenCASCADE (gmsh) in a process of its own."""

from peenflow.geometry.cad.survey import BladeRoot, StepFile, Wish, survey

__all__ = ["BladeRoot", "StepFile", "Wish", "survey"]
