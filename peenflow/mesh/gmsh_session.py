"""gmsh, started and ended so that equal calls give equal bits."""

from collections.abc import Iterator
from contextlib import contextmanager

import gmsh


@contextmanager
def gmsh_model(name: str) -> Iterator[None]:
    """A fresh gmsh model for the length of a `with` block.

    One thread (more change the bits), no user's configuration files, no signal handler (it only works in the main
    thread, and Ctrl-C is the program's own), silent.
    """
    gmsh.initialize([], readConfigFiles=False, run=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("General.NumThreads", 1)
        gmsh.model.add(name)
        yield
    finally:
        gmsh.finalize()
