"""gmsh, loaded when there is something to mesh, started and ended so that equal calls give equal bits."""

from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType

from peenflow.errors import InputError

PACKAGES = "libglu1-mesa libgl1 libxcursor1 libxft2 libxinerama1"  # Debian's, of the libraries gmsh loads


@contextmanager
def gmsh_model(name: str) -> Iterator[ModuleType]:
    """gmsh with a fresh model for the length of a `with` block.

    One thread (more change the bits), no user's configuration files, no signal handler (it only works in the main
    thread, and Ctrl-C is the program's own), silent.

    Raises:
        InputError: gmsh cannot be loaded on this machine.
    """
    gmsh = _load()
    gmsh.initialize([], readConfigFiles=False, run=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("General.NumThreads", 1)
        gmsh.model.add(name)
        yield gmsh
    finally:
        gmsh.finalize()


def _load() -> ModuleType:
    try:
        import gmsh  # its import loads OpenGL and X libraries, which a machine that only looks need not have
    except OSError as error:
        raise InputError(
            f"gmsh, which the mesh stage needs, cannot be loaded: {error}. It loads OpenGL and X libraries even where "
            f"nothing is drawn: install them with: apt-get install {PACKAGES}"
        ) from error
    loaded: ModuleType = gmsh
    return loaded
