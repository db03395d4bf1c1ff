"""The command line as a user calls it: a process of its own, from the repository's root."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
STAGES = ["mesh", "calibrate", "dem", "translate", "solve", "report"]


def command(*arguments: object) -> list[str]:
    return [sys.executable, "-m", "peenflow", *map(str, arguments)]


def peenflow(*arguments: object, **environment: str) -> subprocess.CompletedProcess[str]:
    env = os.environ | {"PYTHONPATH": str(ROOT), "COLUMNS": "200"} | environment
    return subprocess.run(command(*arguments), capture_output=True, text=True, check=False, cwd=ROOT, env=env)


def one_paragraph(text: str) -> bool:
    return text.startswith("Error: ") and text.count("\n") == 1 and "Traceback" not in text


def states(told: subprocess.CompletedProcess[str]) -> dict[str, str]:
    """State of each stage, as `run` and `status` print it."""
    rows = [line.split() for line in told.stdout.splitlines()]
    return {row[0]: row[1] for row in rows if row and row[0] in STAGES}
