"""What the verification ladder and the stability suite measured: every comparison is recorded before it is judged.

A test takes the `rung` fixture and states quantities through it. All of them are recorded, the failed ones too; the
test fails at its end if one of them lies outside its band. With `--record DIR` each test leaves a JSON file there,
from which `ladder_page.py` writes docs/verification.md or docs/stability.md.
"""

import json
import math
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Row:
    """One quantity against what is expected of it."""

    quantity: str
    measured: float
    expected: float | None  # None: only a band is asked for
    band: str
    unit: str
    passed: bool


@dataclass
class Rung:
    """The rows of one test, and the curves its pictures are drawn from."""

    title: str = ""  # what the page calls it, where the test's name would not do
    rows: list[Row] = field(default_factory=list)
    curves: dict[str, dict[str, list[float]]] = field(default_factory=dict)

    def near(self, quantity, measured, expected, unit="", *, rel=None, abs=None):
        """Within a share `rel` of what is expected, or within `abs`; either in `unit` as given."""
        tolerance = rel * math.fabs(expected) if abs is None else abs
        band = f"± {100 * rel:.3g} %" if abs is None else f"± {abs:.3g}"
        passed = math.fabs(measured - expected) <= tolerance  # False for NaN
        self._add(quantity, measured, expected, band, unit, passed)

    def between(self, quantity, measured, low, high, unit=""):
        """From `low` to `high`."""
        self._add(quantity, measured, None, f"{low:.4g} … {high:.4g}", unit, low <= measured <= high)

    def below(self, quantity, measured, limit, unit=""):
        """A size that must not exceed `limit`."""
        self._add(quantity, measured, None, f"≤ {limit:.3g}", unit, measured <= limit)

    def note(self, quantity, measured, expected=None, unit=""):
        """Shown beside its reference, but no rung: nothing is asked of it."""
        self._add(quantity, measured, expected, "shown only", unit, True)

    def curve(self, name, **columns):
        """Columns of equal length under a name the pictures know."""
        self.curves[name] = {key: np.asarray(column, float).tolist() for key, column in columns.items()}

    def judge(self):
        """Fail with all rows outside their bands."""
        __tracebackhide__ = True
        failed = [row for row in self.rows if not row.passed]
        told = (f"{r.quantity}: {r.measured:.5g} {r.unit}, expected {r.expected or ''} {r.band}" for r in failed)
        assert not failed, "\n".join(told)

    def _add(self, quantity, measured, expected, band, unit, passed):
        self.rows.append(
            Row(quantity, float(measured), None if expected is None else float(expected), band, unit, bool(passed))
        )


def fault(report) -> str:
    """Why a test failed, in one line."""
    crash = getattr(report.longrepr, "reprcrash", None)
    return " ".join((crash.message if crash else str(report.longrepr)).split())


def save(folder: Path, item, report, rung: Rung, seconds: float) -> None:
    """One test's record: where it stands in the ladder, how it ended, its rows and curves."""
    module = item.module
    record = {
        "module": module.__name__.rpartition(".")[2],
        "told": module.__doc__.strip(),
        "test": item.name,
        "title": rung.title,
        "passed": report.passed,
        "skipped": report.skipped,
        "fault": "" if report.passed else fault(report),
        "start": report.start,
        "seconds": seconds,
        "rows": [asdict(row) for row in rung.rows],
        "curves": rung.curves,
    }
    folder.mkdir(parents=True, exist_ok=True)
    name = "".join(c if c.isalnum() else "-" for c in f"{record['module']}-{item.name}")
    (folder / f"{name}.json").write_text(json.dumps(record, indent=1), encoding="utf-8")
