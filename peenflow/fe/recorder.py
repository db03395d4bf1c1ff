"""What each sphere felt: its impulses step by step, and the figures defined on them."""

from dataclasses import dataclass, field

import numpy as np

FORCE_WINDOW = 12e-9  # s, centred mean (design: definitions)


@dataclass
class ContactRecorder:
    """Impulses of the spheres in contact, one row a sphere and step."""

    time: list[float] = field(default_factory=list)  # the step's start
    step: list[float] = field(default_factory=list)
    sphere: list[int] = field(default_factory=list)
    impulse: list[float] = field(default_factory=list)  # along the sphere's first normal, of the meshed share

    def take(self, time: float, step: float, impulses: np.ndarray, normals: np.ndarray) -> None:
        """Record one step; impulses (s, 3) on the spheres, normals (s, 3)."""
        for s in np.flatnonzero(impulses.any(axis=1)):
            self.time.append(time)
            self.step.append(step)
            self.sphere.append(int(s))
            self.impulse.append(float(impulses[s] @ normals[s]))

    def of(self, sphere: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(start times, steps, impulses) of one sphere."""
        mine = np.array(self.sphere, int) == sphere
        return np.array(self.time)[mine], np.array(self.step)[mine], np.array(self.impulse)[mine]


def mean_force(time: np.ndarray, step: np.ndarray, impulse: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Centred 12 ns mean of the contact force [N] at times `at`, from impulses over [time, time + step]."""
    edges = np.concatenate([time, time[-1:] + step[-1:]])
    total = np.concatenate([[0.0], np.cumsum(impulse)])
    half = 0.5 * FORCE_WINDOW
    return np.asarray((np.interp(at + half, edges, total) - np.interp(at - half, edges, total)) / FORCE_WINDOW)


def contact_time(time: np.ndarray, step: np.ndarray, impulse: np.ndarray) -> float:
    """From 0.01 to 99.99 % of the impulse [s]."""
    edges = np.concatenate([time, time[-1:] + step[-1:]])
    total = np.concatenate([[0.0], np.cumsum(impulse)])
    share = total / total[-1]
    # Between two impulses the sum stands still: take the last time at 0.01 % and the first at 99.99 %.
    begin = edges[np.searchsorted(share, 1e-4, side="right") - 1]
    end = edges[np.searchsorted(share, 1 - 1e-4, side="left")]
    return float(end - begin)
