"""The FE deck for a solver the user has: Abaqus or CalculiX, as the method's paper runs it."""

from peenflow.export.write import TOOLS, Tool, write

__all__ = ["TOOLS", "Tool", "write"]
