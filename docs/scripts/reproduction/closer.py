"""An impact of a run looked at again, on a small patch around it, whose elements may be smaller for the same time."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shots_table
from parts import Bench, Row, shipped, summary
from peened import Peened, curve, percent_off, read

from peenflow.case.accuracy import MARGIN
from peenflow.loads.placement import Room, on_patch
from peenflow.results import profiles
from peenflow.results.evaluation import Peening
from peenflow.results.profiles import Profile
from peenflow.scene import Scene

SOLVED = ("rate_hardening", "thermal_softening", "kinematic_hardening", "contact_friction", "shot_spin", "far_field")
MM = 1e3


@dataclass(frozen=True)
class Spot:
    """An impact of a run of a case."""

    like: str  # folder of cases
    of: Scene
    results: Path
    peening: Peening
    row: int  # of the impacts
    at: tuple[str, str]  # where it is, as `[target] patch.at` has it

    def on_patch(self, size: float) -> np.ndarray:
        """Which impacts (n,) of those on the case's patch a square one of `size` [m] around this one bears too."""
        impacts, surface = self.peening.impacts, self.peening.surface
        centre = surface.unroll(impacts.point[self.row])
        return impacts.on_patch & on_patch(impacts, Room(surface, (size, size), MARGIN * self.of.dent_radius), centre)


def pinned(results: Path) -> dict[str, str]:
    """`[effects]` of a case whose solver is to take those that a run had."""
    states = summary(results)["effects"]
    return {name: states[name]["state"].split()[-1] for name in SOLVED}


def look(bench: Bench, spot: Spot, size: float, mesh_size: float, **effects: str) -> Peened:
    """The impact again with those beside it, on a square patch of `size` [m] centred on it, else as in its case.

    Args:
        effects: those that are to be another than in the run.
    """
    impacts, borne = spot.peening.impacts, spot.on_patch(size)
    name = "-".join([f"closer-{MM * size:.3g}-{MM * mesh_size:.3g}", *(f"{key}-{is_}" for key, is_ in effects.items())])
    case = bench.case(
        name,
        spot.like,
        {
            "title": "An impact looked at again",
            "nozzle": None,
            "deflector": None,
            "exposure": None,
            "dem": {"friction": spot.of.case.dem.friction},
            "impacts": {"file": shots_table.NAME},
            "target": shipped(spot.like)["target"]
            | {"patch": {"length": f"{MM * size} mm", "arc": f"{MM * size} mm", "at": spot.at}},
            "accuracy": {"preset": spot.of.case.accuracy.preset, "mesh_size": f"{MM * mesh_size} mm"},
            "effects": pinned(spot.results) | effects,
        },
    )
    spin = None if impacts.spin is None else impacts.spin[borne]
    shots_table.write(case, impacts.t[borne], impacts.point[borne], impacts.velocity[borne], spin)
    return read(bench.run(case, name, until="solve"))


@dataclass(frozen=True)
class Closer:
    """Profiles under an impact, and what tells one from another (m)."""

    fine: float  # elements
    own: float  # elements of the patch that the case has
    small: float  # patch
    wide: float  # patch
    borne: tuple[int, int]  # impacts on the small patch and on the wide one
    profile: Profile  # on the small patch with fine elements
    whole: Profile  # on the case's own patch
    coarse: Profile  # on the small patch with the elements of the case's own
    wider: Profile  # on the wide patch, likewise

    def row(self, what: str, whole: str) -> Row:
        """How far the case's own patch, told as `whole`, is off, and what makes the difference."""
        off, coarse, around = (
            percent_off(curve(one), curve(against))
            for one, against in (
                (self.whole, self.profile),
                (self.coarse, self.profile),
                (self.coarse, self.wider),
            )
        )
        return Row(
            f"{what}: {whole}, elements of {MM * self.own:.3g} mm",
            None,
            off,
            "% rms",
            f"off the small patch's, {MM * self.small:g} mm wide with elements of {MM * self.fine:g} mm. On the small "
            f"patch elements of {MM * self.own:.3g} mm change the profile by {coarse:.1f} %; with them a patch of "
            f"{MM * self.wide:g} mm, which bears {self.borne[1]} impacts instead of {self.borne[0]}, changes it by "
            f"{around:.1f} %. Where the shot meets the mesh counts too",
        )


def compare(bench: Bench, spot: Spot, sizes: tuple[float, float], fine: float) -> Closer:
    """The impact on a small and a wide patch of `sizes` [m], the small one with `fine` elements [m] too."""
    patch, own = spot.peening.patch, spot.of.knobs.mesh_size
    small, wide = sizes
    return Closer(
        fine=fine,
        own=own,
        small=small,
        wide=wide,
        borne=(int(spot.on_patch(small).sum()), int(spot.on_patch(wide).sum())),
        profile=look(bench, spot, small, fine).profile(),
        whole=profiles.weighted(patch, spot.peening.response, profiles.below(patch, spot.peening.uv()[spot.row])),
        coarse=look(bench, spot, small, own).profile(),
        wider=look(bench, spot, wide, own).profile(),
    )
