"""What a part of the reproduction is: the paper's tables and figures it answers, and what was measured for them."""

import json
import os
import subprocess
import sys
import time
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import tomli_w

from peenflow.records.deck import Deck
from peenflow.records.deck_files import save_deck

ROOT = Path(__file__).parents[3]


@dataclass(frozen=True)
class Row:
    """One figure beside the paper's."""

    what: str
    paper: float | str | None  # None: the paper gives no number
    measured: float | str
    unit: str  # "" for a pure number
    told: str  # one sentence: why they agree or differ


@dataclass(frozen=True)
class Table:
    """Figures of which the paper has no counterpart one by one: a sweep, say."""

    title: str
    head: Sequence[str]
    lines: Sequence[Sequence[float | str]]


@dataclass(frozen=True)
class Found:
    """What a part measured; pictures by file name, with captions."""

    rows: Sequence[Row]
    pictures: Mapping[str, str] = field(default_factory=dict)
    tables: Sequence[Table] = ()
    told: str = ""  # a paragraph under the rows


@dataclass(frozen=True)
class Part:
    """One section of the page."""

    title: str
    of: str  # the paper's section, tables and figures
    here: str  # where the program does the same: modules, functions, keys, commands
    measure: Callable[["Bench"], Found]
    elements: str = ""  # why they are not of 0.01 mm, where they are not
    beside: Sequence[str] = ()  # folders of other parts' runs that it looks at
    lasts: float = 0.0  # s on one thread, about: the longest begin first
    quiet: bool = False  # it uses several cores itself and tells wall times: nothing else is measured meanwhile


@dataclass(frozen=True)
class Bench:
    """Where a part works: its runs, which are kept and not repeated while nothing they depend on has changed."""

    work: Path  # of the part's runs
    pictures: Path  # into which it draws

    def case(self, name: str, like: str, changes: Mapping[str, Any] | None = None) -> Path:
        """A case directory `name` as `like` (a folder of cases) with tables of case.toml replaced; None removes one."""
        place = self.work / "cases" / name
        place.mkdir(parents=True, exist_ok=True)
        content = shipped(like)
        for key, value in (changes or {}).items():
            if value is None:
                content.pop(key, None)
            else:
                content[key] = value
        (place / "case.toml").write_text(tomli_w.dumps(content), encoding="utf-8")
        return place

    def run(self, case: Path, name: str, *settings: str, until: str | None = None) -> Path:
        """Results of `peenflow run CASE --set …`, a process of its own; `case` may be a folder of cases."""
        words = ["run", str(case), *(("--until", until) if until else ())]
        return self._kept(name, *words, *_set(settings))

    def solve(self, deck: Deck, name: str) -> Path:
        """Results of `peenflow solve` of a deck that no case makes."""
        folder = self.work / "decks" / name
        save_deck(deck, folder)
        return self._kept(name, "solve", str(folder))

    def _kept(self, name: str, *words: str) -> Path:
        out, told = self.work / "results" / name, f"{self.work.name}/{name}"
        began = time.monotonic()
        _peenflow(told, *words, "--out", str(out))
        print(f"    {told}: {time.monotonic() - began:.0f} s", flush=True)
        return out


def shipped(case: str | Path) -> dict[str, Any]:
    """case.toml of a folder of cases."""
    return tomllib.loads((ROOT / "cases" / case / "case.toml").read_text(encoding="utf-8"))


def summary(results: Path) -> dict[str, Any]:
    """summary.json of a run."""
    content: dict[str, Any] = json.loads((results / "summary.json").read_text(encoding="utf-8"))
    return content


def check(case: Path, *settings: str) -> dict[str, Any]:
    """What `peenflow check CASE --json --set …` tells."""
    content: dict[str, Any] = json.loads(_peenflow("check", "check", str(case), "--json", *_set(settings)))
    return content


def _set(settings: Sequence[str]) -> list[str]:
    return [word for setting in settings for word in ("--set", setting)]


def _peenflow(name: str, *words: str) -> str:
    """What `peenflow WORDS` prints; ends this process where it fails, with what it says."""
    command, own = [sys.executable, "-P", "-m", "peenflow", *words], os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, cwd=ROOT, env=own, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{name}: {done.stderr.strip() or done.stdout.strip()}")
    return done.stdout


def store(found: Found, seconds: float, place: Path) -> None:
    """Keep what a part measured."""
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_text(json.dumps(asdict(found) | {"seconds": seconds}, indent=1) + "\n", encoding="utf-8")
