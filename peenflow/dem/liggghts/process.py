"""LIGGGHTS as a child process: started, looked at, never left behind."""

import re
import shutil
import subprocess
from pathlib import Path

from peenflow.dem.liggghts.deck import DECK
from peenflow.errors import InputError

LOG = "liggghts.log"
_TAIL = 4096  # bytes of the log in which the newest thermo line stands
_STEP = re.compile(rb"^ *(\d+) +\d+ +\S+ *\n", re.MULTILINE)
_PACKAGES = {"liggghts": "liggghts", "stdbuf": "coreutils", "setpriv": "util-linux"}


def require_tools() -> None:
    """Make sure that LIGGGHTS can be started.

    Raises:
        InputError: it, or a tool it is started with, is not installed.
    """
    for tool, package in _PACKAGES.items():
        if shutil.which(tool) is None:
            raise InputError(
                f"The program {tool}, which the dem stage needs, is not on the PATH. "
                f"Install it with: apt-get install {package}"
            )


class Process:
    """LIGGGHTS on the deck in a directory, its output in the log there."""

    def __init__(self, directory: Path) -> None:
        """Start it.

        `stdbuf`: an error message would be lost in an unflushed buffer. `setpriv`: it dies with us even where we cannot
        end it. Its own session: Ctrl-C reaches us alone, who then kill it (it would end as if all were well).
        """
        self._log = directory / LOG
        command = ["setpriv", "--pdeathsig", "KILL", "stdbuf", "-oL", "liggghts", "-in", DECK, "-log", "none"]
        with open(self._log, "wb") as log:
            self._child = subprocess.Popen(
                command,
                cwd=directory,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    @property
    def pid(self) -> int:
        """Process id."""
        return self._child.pid

    def status(self) -> int | None:
        """Exit status, minus the signal's number where one killed it; None while it runs."""
        return self._child.poll()

    def step(self) -> int:
        """The last time step of which the log tells; 0 before the first."""
        with open(self._log, "rb") as log:
            log.seek(max(0, self._log.stat().st_size - _TAIL))
            steps = _STEP.findall(log.read())
        return int(steps[-1]) if steps else 0

    def kill(self) -> None:
        """End it, whatever it does, and wait until it has gone."""
        self._child.kill()
        self._child.wait()
