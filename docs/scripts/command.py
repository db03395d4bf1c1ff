"""`peenflow` as a user runs it, from a checkout."""

import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).parents[2]


def peenflow(*words: str, settings: Sequence[str] = (), **environment: str) -> None:
    """Run `peenflow WORDS --set …`, with `environment` beside this process's own; fails as it fails."""
    told = [word for setting in settings for word in ("--set", setting)]
    subprocess.run(
        [sys.executable, "-m", "peenflow", *words, *told], check=True, cwd=ROOT, env=os.environ | environment
    )
