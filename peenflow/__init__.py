"""peenflow: residual stress of shot peening from discrete elements and explicit finite elements."""

__version__ = "0.1.0"
