"""Whether what is asked of the scheduler is enough for what the case is predicted to need."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from peenflow.jobs.script import Allocation, megabytes, seconds

SPARE = 1.5  # times what is predicted, which errs by some tens of percent
MEBIBYTE = 1 << 20


def shortfalls(allocation: Allocation, stages: Sequence[Mapping[str, Any]]) -> list[str]:
    """What is asked below its prediction, each in words with what to ask instead.

    Args:
        allocation: what is asked.
        stages: predictions as `peenflow.estimate.estimate` gives them.

    Raises:
        InputError: time or memory are not written as [hpc] has them.
    """
    found = []
    wall, memory = math.ceil(sum(s["predicted_wall_s"] for s in stages)), max(s["predicted_memory_B"] for s in stages)
    if allocation.time is not None and seconds(allocation.time) < wall:
        found.append(
            f"the job asks for {clock(seconds(allocation.time))} and is predicted to take {clock(wall)}: ask for "
            f"--time {clock(math.ceil(SPARE * wall / 60) * 60)}, or submit it again each time it is cut off."
        )
    if allocation.memory is not None and megabytes(allocation.memory) * MEBIBYTE < memory:
        found.append(
            f"the job asks for {megabytes(allocation.memory)} MB of memory and is predicted to need "
            f"{math.ceil(memory / MEBIBYTE)} MB: ask for --memory {math.ceil(SPARE * memory / MEBIBYTE / 1024)}GB."
        )
    return found


def clock(total: int) -> str:
    """Seconds as [hpc] has a duration: hours:minutes:seconds, after its days where there are any."""
    days, rest = divmod(total, 86400)
    return (f"{days}-" if days else "") + f"{rest // 3600:02d}:{rest // 60 % 60:02d}:{rest % 60:02d}"
