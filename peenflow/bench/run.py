"""One `bench`: triad, compilation, solver, DEM, in that order."""

from dataclasses import dataclass

from peenflow.bench import first_step, stream, threads, traffic, updates
from peenflow.bench.found import Found
from peenflow.bench.triad import bandwidth
from peenflow.progress import Progress


@dataclass(frozen=True)
class Plan:
    """How much is measured."""

    triad_length: int  # numbers in each of three arrays
    cubes: tuple[tuple[int, str, str], ...]  # elements along an edge, order of the nodes, precision
    bundles: int  # timed, of each situation
    stream: str  # duration of the DEM's


FULL = Plan(
    triad_length=1 << 25,
    cubes=(
        (32, "structured", "float64"),
        (32, "gmsh", "float64"),
        (64, "structured", "float64"),
        (64, "gmsh", "float64"),
        (64, "random", "float64"),
        (100, "structured", "float64"),
        (100, "gmsh", "float64"),
        (64, "structured", "float32"),
        (100, "structured", "float32"),
    ),
    bundles=7,
    stream="2 ms",
)
QUICK = Plan(
    triad_length=1 << 23,
    cubes=((16, "structured", "float64"), (16, "random", "float64"), (16, "structured", "float32")),
    bundles=3,
    stream="0.2 ms",
)


def measure(plan: Plan, progress: Progress) -> Found:
    """Measure all that `plan` names.

    Raises:
        RunError: a process failed, or the solver did something else than was meant.
        InputError: gmsh cannot be loaded although LIGGGHTS is there.
    """
    progress.note("memory: triad")
    triad = {count: bandwidth(count, plan.triad_length) for count in threads.counts()}
    progress.note("solver: compiling in a process of its own")
    cold, cached = first_step.cold_and_cached()
    solver = []
    with progress.task("solver", float(sum(n**3 for n, _, _ in plan.cubes))) as task:
        done = 0.0
        for n, order, precision in plan.cubes:
            each = n**3 / (len(triad) * len(updates.SHARES))
            for found in updates.measure(n, order, precision, triad, plan.bundles):
                solver.append(found)
                done += each
                task.update(done)
    progress.note("dem: a short stream")
    return Found(triad, cold, cached, tuple(solver), traffic.formula(), stream.measure(plan.stream))
