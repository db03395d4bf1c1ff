"""Single DEM hits as a user has them: `peenflow run --until dem` of shots that fall straight down onto a plate."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import reading
from parts import Bench

from peenflow.scene import Scene

HEIGHT = 2.0  # mm, of the nozzle over the plate
RATE = 40e3  # 1/s, of one shot after another
CELL = "0.03 mm"  # elements of the calibration, whose figures these runs do not use


@dataclass(frozen=True)
class Throw:
    """What to throw, and how finely."""

    speed: float  # m/s
    restitution: float
    step: float  # share of the Rayleigh step
    shots: int = 1


@dataclass(frozen=True)
class Hit:
    """One shot's contact; time counts from first touch, which lies between two steps."""

    time: np.ndarray  # (k,) s, of the forces
    force: np.ndarray  # (k,) N, along the outward normal
    velocity: np.ndarray  # (k,) m/s, along it, half a step after `time`
    impulse: float  # N s
    step: float  # s

    @property
    def peak(self) -> float:
        """Largest force [N]."""
        return float(self.force.max())

    @property
    def duration(self) -> float:
        """From first touch until the force has fallen to zero [s]: beyond, damping pulls at the shot."""
        top = int(self.force.argmax())
        pulling = np.flatnonzero(self.force[top:] <= 0)
        if not len(pulling):
            return float(self.time[-1]) + self.step
        last = top + int(pulling[0]) - 1
        falling = self.force[last] / (self.force[last] - self.force[last + 1])
        return float(self.time[last] + falling * self.step)

    @property
    def ended(self) -> float:
        """When the overlap ends [s], half a step after it was last seen."""
        return float(self.time[-1]) + self.step / 2

    @property
    def turn(self) -> float:
        """When the shot stands still [s]."""
        turned = int((self.velocity >= 0).argmax())
        before, after = self.velocity[turned - 1 : turned + 1]
        return float(self.time[turned] + self.step * (0.5 - after / (after - before)))


def run(bench: Bench, name: str, throw: Throw) -> Path:
    """Results of LIGGGHTS with a contact row every step."""
    changes = {
        "title": f"{throw.shots} shots at {throw.speed:g} m/s onto a plate",
        "shot": {"diameter": "0.3556 mm", "material": "steel"},
        "nozzle": [
            {
                "position": ["0.4 mm", "0.9 mm", f"{HEIGHT} mm"],
                "direction": [0, 0, -1],
                "diameter": "1.5 mm",
                "speed": f"{throw.speed} m/s",
                "rate": f"{RATE} 1/s",
            }
        ],
        "dem": {"engine": "liggghts", "restitution": throw.restitution},
        "exposure": {"duration": f"{throw.shots / RATE * 1e6} us", "seed": 1},
        "accuracy": {
            "preset": "draft",
            "dem_time_step": throw.step,
            "contact_interval": 1,
            "calibration_mesh_size": CELL,
        },
        "effects": dict.fromkeys(("gravity", "air_drag", "shot_collisions", "cor_hardening"), "off"),
    }
    return bench.run(bench.case(name, "plate", changes), name, until="dem")


def scene(bench: Bench, name: str) -> Scene:
    """The case of a run, resolved."""
    return reading.scene(bench.work / "cases" / name)


def hits(results: Path, mass: float) -> list[Hit]:
    """Contacts of the shots of `mass` [kg], one each."""
    contacts = reading.record(results, "dem")
    found = []
    for shot in np.unique(contacts.shot).tolist():
        rows = np.flatnonzero(contacts.shot == shot)
        time, at = np.unique(contacts.t[rows], return_inverse=True)  # a hit on an edge has a row for each facet
        force = np.bincount(at, weights=contacts.force[rows, 2])
        before = contacts.velocity[rows[0], 2]
        velocity = before + np.cumsum(force) * contacts.time_step / mass
        touch = time[0] + contacts.overlap[rows[0]] / before
        impulse = float(force.sum() * contacts.time_step)
        found.append(Hit(time - touch, force, velocity, impulse, contacts.time_step))
    return found
