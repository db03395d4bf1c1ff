"""How the mean stress scatters over seeds, by the area over which the mean is taken: the part `seeds` of `make study`.

One stream a seed, whose stress is evaluated over squares of several sizes: only the report is made again.
"""

import csv
import json
import statistics
from dataclasses import dataclass

from command import ROOT, peenflow

from peenflow.study.rows import cpu_seconds

BUILD = ROOT / "build" / "study" / "seeds"
CASE = "cases/plate"
SETTINGS = (
    "accuracy.preset=draft",
    "accuracy.mesh_size=0.03 mm",
    "exposure.duration=6 ms",
    "target.patch.length=1.6 mm",
    "target.patch.width=1.6 mm",
    'target.patch.at=["0 mm", "0 mm"]',
)
SEEDS = (1, 2, 3, 4, 5, 6)
AREAS = (0.1, 0.2, 0.4, 0.8, 1.2)  # mm, sides of the squares


@dataclass(frozen=True)
class Mean:
    """Of one seed over one square."""

    impacts: int  # on the square
    least: float  # Pa, of the mean profile
    surface: float  # Pa
    told: tuple[float | None, float | None]  # Pa, the standard errors of both that the run itself tells
    cpu_s: float  # of the stages that do not depend on the square


def run() -> None:
    """Every seed's stream once, every square's report; what is up to date is not run again."""
    found = [[_measured(seed, side) for side in AREAS] for seed in SEEDS]
    BUILD.mkdir(parents=True, exist_ok=True)
    rows = [[vars(mean) for mean in of_seed] for of_seed in found]
    (BUILD / "seeds.json").write_text(json.dumps(rows, indent=1) + "\n")


def section() -> list[str]:
    """The page's lines; none where the part was not run."""
    if not (BUILD / "seeds.json").exists():
        return []
    found = [[Mean(**mean) for mean in of_seed] for of_seed in json.loads((BUILD / "seeds.json").read_text())]
    told = ", ".join(f"`{setting}`" for setting in SETTINGS)
    cost = statistics.mean(of_seed[0].cpu_s for of_seed in found)
    lines = [
        "## Seeds and area",
        "",
        f"What chance leaves: {len(found)} seeds of a stream, means over squares of several sizes. Case `{CASE}` with "
        f"{told}; {cost:.3g} CPU s a seed. ± is the standard deviation of one seed; that of a mean over n seeds is √n "
        "times smaller. *Told* is the standard error that a run tells of itself (`min_standard_error_Pa`, "
        "`surface_standard_error_Pa`), its root mean square over the seeds; – where the square holds too few dents.",
        "",
        "| side of the square, mm | impacts on it | least RCS, MPa | ± % | told, % | surface, MPa | ± % | told, % |",
        "| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |",
    ]
    for side, means in zip(AREAS, zip(*found, strict=True), strict=True):
        impacts = statistics.mean(mean.impacts for mean in means)
        least, surface = [mean.least for mean in means], [mean.surface for mean in means]
        told = [alone([mean.told[i] for mean in means], stresses) for i, stresses in enumerate((least, surface))]
        lines.append(
            f"| {side:g} | {impacts:.3g} | {scattered(least)} | {told[0]} | {scattered(surface)} | {told[1]} |"
        )
    return [*lines, ""]


def scattered(stresses: list[float]) -> str:
    """Mean [MPa] and standard deviation [% of it], as two cells."""
    mean = statistics.mean(stresses)
    return f"{mean * 1e-6:.0f} | {100 * statistics.stdev(stresses) / abs(mean):.2g}"


def alone(errors: list[float | None], stresses: list[float]) -> str:
    """What runs tell of their own scatter, rms [% of the mean stress], as a cell; – where not all could tell."""
    known = [error for error in errors if error is not None]
    if len(known) < len(errors):
        return "–"
    return f"{100 * statistics.mean(error**2 for error in known) ** 0.5 / abs(statistics.mean(stresses)):.2g}"


def _measured(seed: int, side: float) -> Mean:
    out = BUILD / f"seed-{seed}"
    settings = (*SETTINGS, f"exposure.seed={seed}", f"report.area={side:g} mm")
    peenflow("run", CASE, "--out", str(out), settings=settings, NUMBA_NUM_THREADS="1")
    summary = json.loads((out / "summary.json").read_text())
    with open(out / "impacts.csv", newline="") as file:
        places = [(float(row["x_m"]), float(row["y_m"])) for row in csv.DictReader(file)]
    return Mean(
        impacts=sum(max(abs(x), abs(y)) <= side * 0.5e-3 for x, y in places),
        least=summary["residual"]["min_Pa"],
        surface=summary["residual"]["surface_Pa"],
        told=(summary["residual"]["min_standard_error_Pa"], summary["residual"]["surface_standard_error_Pa"]),
        cpu_s=cpu_seconds(summary["ledger"]),
    )
