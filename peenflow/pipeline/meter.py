"""What a stage costs: wall time, processor time and memory, child processes included."""

import os
import resource
import threading
import time
from dataclasses import dataclass
from pathlib import Path

from peenflow import compiling

SAMPLING_INTERVAL = 0.25  # s


@dataclass(frozen=True)
class Cost:
    """Of one stage; `+` joins an interrupted run with the one that goes on."""

    wall_s: float = 0.0
    cpu_s: float = 0.0
    peak_memory_B: int = 0  # noqa: N815 (the name it has in summary.json)
    compile_s: float = 0.0  # of cpu_s: kernels that were in no cache, once on each machine

    def __add__(self, other: "Cost") -> "Cost":
        peak = max(self.peak_memory_B, other.peak_memory_B)
        compiled = self.compile_s + other.compile_s
        return Cost(self.wall_s + other.wall_s, self.cpu_s + other.cpu_s, peak, compiled)


class Meter:
    """Measures from its construction until `stop`.

    Peak memory is the larger of this process's own high-water mark and the largest sampled sum of resident memory
    over this process and its descendants. (`ru_maxrss` of children would not do: it counts the parent's pages that
    a child had between fork and exec.)
    """

    def __init__(self) -> None:
        self._wall, self._cpu, self._compiled = time.monotonic(), _cpu_time(), compiling.SPENT.seconds
        _reset_high_water()
        self._sampled = 0
        self._done = threading.Event()
        self._sampler = threading.Thread(target=self._sample, daemon=True)
        self._sampler.start()

    def stop(self) -> Cost:
        """What was used since construction."""
        self._done.set()
        self._sampler.join()
        peak = max(_status_bytes(os.getpid(), "VmHWM"), self._sampled)
        compiled = compiling.SPENT.seconds - self._compiled
        return Cost(time.monotonic() - self._wall, _cpu_time() - self._cpu, peak, compiled)

    def _sample(self) -> None:
        while not self._done.wait(SAMPLING_INTERVAL):
            tree = _descendants(os.getpid())
            if tree:
                self._sampled = max(self._sampled, sum(_status_bytes(pid, "VmRSS") for pid in [os.getpid(), *tree]))


def _cpu_time() -> float:
    usages = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)


def _reset_high_water() -> None:
    """Let the kernel count VmHWM anew, so that a stage is not charged for what an earlier one used."""
    try:
        Path("/proc/self/clear_refs").write_text("5")
    except OSError:
        return  # not allowed in some containers: the peak is then the whole process's


def _status_bytes(pid: int, name: str) -> int:
    """A figure of /proc/PID/status in bytes; 0 if the process has ended."""
    try:
        lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) * 1024 for line in lines if line.startswith(f"{name}:")), 0)


def _descendants(pid: int) -> list[int]:
    found = []
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            children = [int(word) for word in task.read_text().split()]
        except OSError:
            continue
        for child in children:
            found += [child, *_descendants(child)]
    return found
