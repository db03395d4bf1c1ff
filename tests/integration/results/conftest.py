"""Records of made-up runs, as smooth formulas, so that the whole report can be made without the other stages."""

from pathlib import Path

import numpy as np
import pytest

from peenflow.case.model import Case
from peenflow.geometry import BoltHole
from peenflow.geometry.block import build_block
from peenflow.records.calibration import Calibration, SingleHit
from peenflow.records.contacts import Contacts
from peenflow.records.deck import Controls, Deck
from peenflow.records.impacts import Impacts
from peenflow.records.material import Material
from peenflow.records.response import Energies, Response, SphereResults
from peenflow.records.target import Patch
from peenflow.records.translation import Translation
from peenflow.records.upstream import Upstream
from peenflow.scene import Decision, Knobs, Limit, Scene, ShotProperties, Thrown

DIAMETER = 0.3556e-3
HOLE = BoltHole(3.75e-3, 25e-3)
MATERIAL = Material("inconel718", 8200, 211e9, 0.29, 1241e6, 622e6, 0.6522, None, None)
SHOT = ShotProperties(DIAMETER, 7800, 210e9, 0.3)


def in_plane(depth):
    """A residual stress like shot peening's [Pa]: −900 MPa at 0.05 mm, zero near 0.14 mm."""
    return -9e8 * np.exp(-(((depth - 0.05e-3) / 0.055e-3) ** 2)) + 1.2e8 * (1 - np.exp(-depth / 0.15e-3))


def make_hit(speed=62.5, number=1):
    t = np.linspace(0, 0.6e-6, 121)
    phase = np.clip(t / 0.45e-6, 0, 1)
    force = 58 * (speed / 62.5) * np.sin(np.pi * phase)
    radius, a = np.linspace(2e-6, 90e-6, 45), 62e-6 * np.sqrt(np.sin(np.pi * phase))
    inside = np.clip(1 - (radius / np.maximum(a, 1e-9)[:, None]) ** 4, 0, None)
    line = np.linspace(0, 0.4e-3, 81)
    cor = 0.36 + 0.05 * np.log(number) + (62.5 - speed) * 0.002
    return SingleHit(
        speed=speed,
        hit=number,
        cor=cor,
        peak_force=float(force.max()),
        contact_time=0.45e-6,
        impulse=15.6e-6,
        dent_depth=10.3e-6 * number**0.3 * speed / 62.5,
        dent_diameter=123e-6 * number**0.15 * (speed / 62.5) ** 0.5,
        max_mean_pressure=4.3e9,
        time=t,
        velocity=speed * (-1 + (1 + cor) * phase**2 * (3 - 2 * phase)),
        force=force,
        contact_radius=a,
        radius=radius,
        pressure=5e9 * np.sqrt(inside),
        dent_radius_axis=line,
        dent_uz=number**0.3
        * (2e-6 * np.exp(-(((line - 85e-6) / 30e-6) ** 2)) - 10.3e-6 * np.exp(-((line / 45e-6) ** 2))),
    )


def make_calibration(hits=4):
    depth = (np.arange(40) + 0.5) * 0.01e-3
    stress = np.stack([in_plane(depth), in_plane(depth), 0.05 * in_plane(depth)], axis=-1)
    peeq = 0.3 * np.exp(-depth / 0.05e-3)
    return Calibration(
        shot_diameter=DIAMETER,
        shot_density=7800,
        speeds=tuple(make_hit(v) for v in (20, 40, 62.5)),
        hits=tuple(make_hit(number=n) for n in range(1, hits + 1)),
        depth=depth,
        mean_stress=stress,
        mean_peeq=peeq,
        axis_stress=1.8 * stress,
        axis_peeq=2 * peeq,
        elements=64000,
        nodes=68921,
        steps=1500,
        time_step=8e-10,
        energy_error=0.003,
        hourglass_energy_ratio=0.011,
        element_updates_per_s=2.1e7,
    )


def make_impacts(count, on_patch_within):
    rng = np.random.default_rng(3)
    axial = 12.5e-3 + rng.normal(0, 3e-3, count)
    angle = rng.normal(0, 0.3, count)
    point = np.stack([HOLE.radius * np.cos(angle), HOLE.radius * np.sin(angle), axial], axis=-1)
    normal = HOLE.normals(point)
    normal_speed = rng.uniform(8, 44, count)
    along = rng.uniform(10, 30, count)
    velocity = -normal_speed[:, None] * normal - along[:, None] * np.array([0, 0, 1.0])
    uv = HOLE.unroll(point) - np.array([12.5e-3, 0])
    on_patch = (np.abs(uv) < on_patch_within).all(axis=1)
    group = np.where(on_patch, np.cumsum(on_patch) - 1, -1).astype(np.int32)
    return Impacts(
        t=np.sort(rng.uniform(0, 5e-3, count)),
        point=point,
        velocity=velocity,
        normal=normal,
        normal_speed=normal_speed,
        angle=np.arctan2(normal_speed, along),
        peak_force=1.1 * normal_speed,
        diameter=np.full(count, DIAMETER),
        shot=np.arange(count),
        on_patch=on_patch,
        group=group,
        t_start=np.where(on_patch, group * 1.5e-6, np.nan),
        rows=12 * count,
        merged_rows=11 * count - 7,
        duplicates_removed=7,
        rim_dropped=0,
        slow_dropped=212,
        min_normal_speed=6.2,
        shots_hitting=min(197, count),
        groups=int(on_patch.sum()),
    )


def make_response(patch: Patch, impacts: Impacts):
    uv = HOLE.unroll(impacts.point[impacts.on_patch]) - np.array([12.5e-3, 0])
    speed = impacts.normal_speed[impacts.on_patch]
    y = np.arctan2(patch.nodes[:, 1], HOLE.radius - patch.nodes[:, 2]) * HOLE.radius
    depth = np.hypot(patch.nodes[:, 1], HOLE.radius - patch.nodes[:, 2]) - HOLE.radius
    r = np.hypot(patch.nodes[:, 0, None] - uv[:, 0], y[:, None] - uv[:, 1])
    sink = np.exp(-((r / 40e-6) ** 2)) * 8e-6 - np.exp(-(((r - 75e-6) / 25e-6) ** 2)) * 1.5e-6
    down = (sink * speed / 44).sum(axis=1) * np.exp(-depth / 0.06e-3)
    normals = np.stack([np.zeros_like(y), -np.sin(y / HOLE.radius), np.cos(y / HOLE.radius)], axis=-1)
    near = np.exp(-((np.hypot(*(patch.uv[patch.column, None] - uv).T) / 90e-6) ** 2)).T @ (speed / 44)
    level = in_plane(patch.depth) * (0.6 + 0.4 * np.clip(near, 0, 1.5))
    local = np.zeros((len(patch.depth), 3, 3))
    local[:, 0, 0], local[:, 1, 1] = 1.1 * level, 0.9 * level
    s = np.einsum("mai,mab,mbj->mij", patch.axes, local, patch.axes)
    spheres = SphereResults(
        velocity_out=np.tile([0.0, 0.0, 12.0], (len(uv), 1)),
        spin_out=np.zeros((len(uv), 3)),
        peak_force=speed,
        first_contact=np.zeros(len(uv)),
        last_contact=np.full(len(uv), 1e-6),
    )
    return Response(
        displacement=-down[:, None] * normals,
        stress=np.stack([s[:, 0, 0], s[:, 1, 1], s[:, 2, 2], s[:, 0, 1], s[:, 1, 2], s[:, 2, 0]], axis=-1),
        peeq=0.25 * np.exp(-patch.depth / 0.05e-3) * (0.3 + near),
        temperature=None,
        spheres=spheres,
        energies=make_energies(),
        energy_error=0.004,
        hourglass_energy_ratio=0.012,
        residual=0.0008,
        side_reaction=0.002,
        retries=0,
        steps=30000,
        time_step=9e-10,
        element_updates_per_s=2.3e7,
    )


def make_energies():
    t = np.linspace(0, 30e-6, 200)
    done, work = np.clip(t / 24e-6, 0, 1), 1.5e-3
    zero = np.zeros_like(t)
    plastic, shots = 0.8 * work * done, work * (1 - 0.9 * done)
    elastic, kinetic = 0.03 * work * done, 0.01 * work * done * (t < 25e-6)
    rest = work - plastic - shots - elastic - kinetic
    return Energies(
        time=t,
        kinetic=kinetic,
        shots=shots,
        internal=plastic + elastic,
        plastic=plastic,
        hourglass=0.1 * rest,
        viscous=0.2 * rest,
        contact=zero,
        friction=0.3 * rest,
        absorbed=0.3 * rest,
        relaxed=0.1 * rest,
        work=np.full_like(t, work),
    )


def make_contacts(shots):
    rows = 40
    return Contacts(
        t=np.repeat(np.arange(rows // 4) * 1e-4, 4) + np.tile(np.arange(4) * 7.5e-8, rows // 4),
        shot=np.repeat(np.arange(rows // 4), 4),
        surface=np.ones(rows, np.int32),
        facet=np.zeros(rows, np.int32),
        point=np.zeros((rows, 3)),
        velocity=np.zeros((rows, 3)),
        wall_velocity=np.zeros((rows, 3)),
        force=np.zeros((rows, 3)),
        overlap=np.zeros(rows),
        diameter=np.full(rows, DIAMETER),
        surfaces=("target", "deflector"),
        interval=7.5e-8,
        duration=6e-3,
        shots=shots,
        engine="LIGGGHTS-PUBLIC 3.8.0",
        time_step=3.75e-8,
    )


def make_scene(case, surface):
    effects = {
        "rate_hardening": Decision(True, "auto: on", 0.11, 0.01, "1 + C ln(1.2e6 /s) = 1.19 at the dent", "4 %"),
        "gravity": Decision(False, "auto: off", 2e-6, 0.01, "2 g h / v² over <40 mm> of flight", "nothing"),
    }
    knobs = Knobs(20e-6, 10e-6, 0.6e-3, "far-field", "symmetric", "impact", 0.8, 0.01, 0.2, 2, 1.5, 0.0, 6.2)
    return Scene(
        case=Case.model_validate(case),
        directory=Path("."),
        surface=surface,
        shot=SHOT,
        thrown=Thrown(SHOT, np.array([SHOT.diameter]), np.ones(1)),
        material=MATERIAL,
        knobs=knobs,
        effects=effects,
        not_modelled={"shot_yielding": Limit(0.5, "4.4 GPa is 3 times the shot's yield stress")},
        speed=62.5,
        dent_radius=61e-6,
        contact_time=0.45e-6,
        plastic_radius=1.4e-4,
        normal_speed=62.5,
    )


COMMON = {"shot": {"diameter": "0.3556 mm"}, "target": {"material": "inconel718"}}


@pytest.fixture
def hole_run():
    """Scene and records of a run from nozzle to stress."""
    case = COMMON | {"title": "Deflector peening of a <bolt> hole", "exposure": {"duration": "5 ms"}}
    lines = np.linspace(-0.5e-3, 0.5e-3, 41)
    patch = build_block(lines, lines, np.full(14, 25e-6) * 1.05 ** np.arange(14), HOLE.radius)
    impacts = make_impacts(900, 0.5e-3)
    controls = Controls(
        title="", end_time=1e-5, time_step_share=0.8, relaxation=0.01, relaxation_time=1e-5, checkpoint_steps=1000
    )
    placement = HOLE.placement(np.array([12.5e-3, 0]))
    deck = Deck(controls, patch, placement, MATERIAL, (), (), None, None)
    upstream = Upstream(
        calibration=make_calibration(),
        contacts=make_contacts(200),
        translation=Translation(impacts, deck),
        response=make_response(patch, impacts),
    )
    return make_scene(case, HOLE), upstream


@pytest.fixture
def single_run():
    """Scene and records of a calibration alone."""
    case = COMMON | {"title": "Single shot", "single_shot": {"speed": "62.5 m/s", "hits": 3}}
    return make_scene(case, None), Upstream(calibration=make_calibration(hits=3))


@pytest.fixture
def stage_costs():
    """Rows of a ledger, one of them from the cache, one not predicted."""
    rows = [
        ("mesh", 1.2, 1.5, False),
        ("calibrate", 61.0, 55.0, True),
        ("dem", 23.4, 30.0, False),
        ("translate", 0.8, None, False),
        ("solve", 97.5, 88.0, False),
    ]
    return tuple(
        {
            "stage": stage,
            "wall_s": wall,
            "cpu_s": 1.9 * wall,
            "compile_s": 0.0,
            "peak_memory_B": 4.1e8,
            "predicted_wall_s": predicted,
            "from_cache": cached,
        }
        for stage, wall, predicted, cached in rows
    )
