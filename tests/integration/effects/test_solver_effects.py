"""Effects of the finite elements: what they change where they are called for, and how little where they are not.

One hit at 62.5 m/s on coarse elements (two in a dent's radius); the result is the residual stress profile of the dent,
its depth and the rebound.
"""

import dataclasses
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest

from peenflow.calibrate import stage as calibrate
from peenflow.calibrate.kept import Kept
from peenflow.calibrate.shoot import calibrate as shoot
from peenflow.case.directory import read_case
from peenflow.fe import stage as solve
from peenflow.loads import stage as translate
from peenflow.mesh import stage as mesh
from peenflow.progress import Silent
from peenflow.records.upstream import Upstream
from peenflow.resolve import resolve
from peenflow.results.profiles import evaluation_square, overlap, weighted
from peenflow.scene import Decision, Scene

CASES = Path(__file__).parents[3] / "cases"
COARSE = ("accuracy.calibration_mesh_size=0.03 mm", "accuracy.relaxation=0.004")
AUTO = tuple(f"effects.{name}=auto" for name in ("thermal_softening", "contact_friction", "kinematic_hardening"))
THRESHOLD = 0.02  # of the standard preset
SEEN = 0.3e-3  # m, to which depth the profiles are compared


@dataclasses.dataclass(frozen=True)
class Result:
    """What one hit leaves."""

    depth: np.ndarray  # m
    stress: np.ndarray  # Pa, (S11+S22)/2 by depth
    dent: float = 0.0  # m
    cor: float = 0.0

    def change(self, other: "Result") -> float:
        """The largest of the changes: profile (rms over its minimum), dent, rebound."""
        seen = self.depth < SEEN
        profile = np.sqrt(np.mean((self.stress - other.stress)[seen] ** 2)) / abs(self.stress.min())
        figures = [abs(other.dent / self.dent - 1), abs(other.cor / self.cor - 1)] if self.dent else []
        return float(max([profile, *figures]))


def scene(*settings: str) -> Scene:
    return resolve(*read_case(CASES / "single-shot", [*COARSE, *AUTO, *settings]))


@cache
def hit(*settings: str) -> Result:
    """One hit with no effect but what the settings switch on; equal inputs are computed once."""
    off = [f"effects.{name}=off" for name in ("thermal_softening", "contact_friction", "kinematic_hardening")]
    inputs = calibrate.inputs(resolve(*read_case(CASES / "single-shot", [*COARSE, *off, *settings])), Upstream())
    with TemporaryDirectory() as folder:
        found = shoot(inputs, Kept(Path(folder), ""), Silent())
    dent = found.hits[0].dent_depth
    return Result(found.depth, found.mean_stress[:, :2].mean(axis=1), dent, found.hits[0].cor)


@pytest.mark.parametrize(
    ("effect", "calls_for_it", "does_not"),
    [
        ("rate_hardening", (), ("target.johnson_cook.C=0.0008",)),
        ("thermal_softening", ("target.temperature=600 K",), ()),
        ("kinematic_hardening", (), ("target.kinematic_hardening.modulus=4 GPa",)),
        ("contact_friction", ("dem.friction=0.3",), ("dem.friction=0.01",)),
    ],
)
def test_an_effect_changes_the_result_where_auto_says_on_and_else_not(
    effect: str, calls_for_it: tuple[str, ...], does_not: tuple[str, ...]
) -> None:
    def decided(*settings: str) -> Decision:
        return scene(f"effects.{effect}=auto", *settings).effects[effect]

    def change(*settings: str) -> float:
        return hit(f"effects.{effect}=off").change(hit(f"effects.{effect}=on", *settings))

    needed, idle = decided(*calls_for_it), decided(*does_not)
    assert needed.on
    assert needed.threshold == THRESHOLD
    assert change(*calls_for_it) > THRESHOLD
    assert idle.estimate is not None
    assert not idle.on
    assert change(*does_not) < THRESHOLD


PATCH = """\
title = "one hit"
[shot]
diameter = "0.3556 mm"
[target]
material = "inconel718"
geometry = { kind = "plate", thickness = "8 mm" }
patch = { length = "1 mm", width = "1 mm" }
[impacts]
file = "shots.csv"
[accuracy]
mesh_size = "0.033 mm"
relaxation = 0.004
[effects]
contact_friction = "off"
kinematic_hardening = "off"
"""


def patch_scene(directory: Path, *settings: str) -> Scene:
    (directory / "case.toml").write_text(PATCH, encoding="utf-8")
    (directory / "shots.csv").write_text("t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n0,0,0,0,0,0,-62.5\n", encoding="utf-8")
    return resolve(*read_case(directory, settings))


def solved(directory: Path, *settings: str) -> Result:
    """The mean profile under one hit in the middle of a patch."""
    found = patch_scene(directory, *settings)
    target = mesh.run(mesh.inputs(found, Upstream()), directory, Silent())
    translation = translate.run(translate.inputs(found, Upstream(target=target)), directory, Silent())
    response = solve.run(solve.inputs(found, Upstream(translation=translation)), directory, Silent())
    patch = translation.deck.patch
    profile = weighted(patch, response, overlap(patch, evaluation_square(patch, 0.2e-3, found.shot.diameter)))
    return Result(profile.depth, profile.in_plane)


@pytest.mark.parametrize(("depth", "matters"), [("0.36 mm", True), ("1.2 mm", False)])
def test_the_far_field_matters_under_a_shallow_patch(tmp_path: Path, depth: str, matters: bool) -> None:
    decision = patch_scene(tmp_path, f"accuracy.depth={depth}").effects["far_field"]
    assert decision.on == matters
    with_it, without = (
        solved(tmp_path, f"accuracy.depth={depth}", f"effects.far_field={switch}") for switch in ("on", "off")
    )
    assert (with_it.change(without) > THRESHOLD) == matters


def test_a_unit_cell_is_wide_enough_without_far_field() -> None:
    assert not scene("effects.far_field=auto").effects["far_field"].on
    assert hit("effects.far_field=on").change(hit("effects.far_field=off")) < THRESHOLD
