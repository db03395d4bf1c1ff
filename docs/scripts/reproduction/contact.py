"""Section 2.2: one shot by FEM and by DEM, its mesh, its contact pressure, and what the two methods make of the hit."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import contact_pictures
import numpy as np
import shot_on_plate
from cell_picture import cell_picture
from parts import ROOT, Bench, Found, Part, Row, Table
from shot_on_plate import Hit, Throw

from peenflow.calibrate import stage as calibrate
from peenflow.case.directory import read_case
from peenflow.fe.recorder import FORCE_WINDOW
from peenflow.loads.pressure import IMPULSE_SHARES
from peenflow.records.calibration import SingleHit
from peenflow.records.upstream import Upstream
from peenflow.resolve import resolve
from peenflow.results import drawing
from peenflow.scene import Scene, Skip

STATED = 62.5  # m/s, the paper's speed
RESTITUTION = 0.4  # the paper's, of Table 2
VARIATION = ("27 %", "0 %", "0.5 %")  # of force, duration and force × duration, as the paper prints them
DEM_PAPER = (87.8, 5.0e-7, 2.70e-5)  # N, s, N s: Table 2
FEM_PAPER = (111.6, 5.0e-7, 2.69e-5)
FINE_STEP = 0.02  # of the Rayleigh step: 60 steps and more while the force rises
MESH_SIZE = "0.005 mm"
SETTINGS = (f"accuracy.mesh_size={MESH_SIZE}", "accuracy.relaxation=0.02")  # histories end before the cell is at rest
US, NS = 1e6, 1e9


@dataclass(frozen=True)
class Pair:
    """The same hit by both methods at one speed."""

    speed: float  # m/s
    fem: SingleHit
    dem: Hit  # with the paper's restitution
    same: Hit  # with the FE run's
    scene: Scene  # of the FE run
    plate: Scene  # of the DEM runs

    @property
    def fem_turn(self) -> float:
        """When the FE run's shot stands still [s]."""
        turned = int((self.fem.velocity >= 0).argmax())
        before, after = self.fem.velocity[turned - 1], self.fem.velocity[turned]
        step = self.fem.time[turned] - self.fem.time[turned - 1]
        return float(self.fem.time[turned] - step * after / (after - before))

    @property
    def fem_figures(self) -> tuple[float, float, float]:
        """Largest force [N], duration [s], impulse [N s]."""
        return self.fem.peak_force, pushing(self.fem.time, self.fem.force), self.fem.impulse

    @property
    def dem_figures(self) -> tuple[float, float, float]:
        """Likewise, by the same rule."""
        return dem_figures(self.dem)

    @property
    def rigid_modulus(self) -> float:
        """E* [Pa] of a rigid sphere on the target, as in the FE run."""
        return self.scene.material.young / (1 - self.scene.material.poisson**2)

    @property
    def dem_modulus(self) -> float:
        """E* [Pa] of shot and target, as in the DEM."""
        shot, wall = self.plate.shot, self.plate.material
        return 1 / ((1 - shot.poisson**2) / shot.young + (1 - wall.poisson**2) / wall.young)


def pushing(time: np.ndarray, force: np.ndarray) -> float:
    """How long a shot is pushed [s]: between the `IMPULSE_SHARES` of the impulse of the forces (k,) above zero."""
    push = np.maximum(force, 0.0)
    impulse = np.concatenate([[0.0], np.cumsum((push[1:] + push[:-1]) / 2 * np.diff(time))])
    rising = np.concatenate([[True], np.diff(impulse) > 0])
    first, last = np.interp(np.array(IMPULSE_SHARES) * impulse[-1], impulse[rising], time[rising])
    return float(last - first)


def dem_figures(hit: Hit) -> tuple[float, float, float]:
    """Largest force [N], duration [s], impulse [N s]."""
    return hit.peak, pushing(np.append(0.0, hit.time), np.append(0.0, hit.force)), hit.impulse


def hertz(modulus: float, scene: Scene, speed: float) -> tuple[float, float, float]:
    """Largest force [N], duration [s] and impulse [N s] of an elastic hit (Johnson, Contact Mechanics, §11.4)."""
    radius, mass = scene.shot.diameter / 2, scene.shot.mass
    depth = (15 * mass * speed**2 / (16 * math.sqrt(radius) * modulus)) ** 0.4
    return 4 / 3 * modulus * math.sqrt(radius) * depth**1.5, 2.94 * depth / speed, 2 * mass * speed


def measure(bench: Bench) -> Found:
    """Both speeds by both methods, and the pictures."""
    case, _ = read_case(ROOT / "cases" / "single-shot", SETTINGS)
    scene = resolve(case, ROOT / "cases" / "single-shot")
    fitting = round(DEM_PAPER[2] / (scene.shot.mass * (1 + RESTITUTION)), 1)
    pairs = [pair(bench, speed) for speed in (STATED, fitting)]
    inputs = calibrate.inputs(scene, Upstream())
    assert not isinstance(inputs, Skip)
    if told := cell_picture(inputs, bench.pictures / "unit-cell.png"):
        raise SystemExit(f"Figure 8: {told}")
    stated = pairs[0]
    drawing.save(
        lambda: contact_pictures.pressure(stated.fem, stated.scene.material.A), bench.pictures / "pressure.svg"
    )
    drawing.save(lambda: contact_pictures.velocities(pairs), bench.pictures / "velocity.svg")
    drawing.save(lambda: contact_pictures.forces(pairs, DEM_PAPER[0], FEM_PAPER[0]), bench.pictures / "force.svg")
    return Found(
        rows=[*pressure_rows(stated), *(row for each in pairs for row in table_2(each)), *order_rows(pairs)],
        pictures=captions(stated, fitting),
        tables=[all_runs(pairs)],
        told=verdict(pairs),
    )


def pair(bench: Bench, speed: float) -> Pair:
    """FE and DEM at one speed [m/s]."""
    setting = f"single_shot.speed={speed} m/s"
    results = bench.run(ROOT / "cases" / "single-shot", f"fem-{speed:g}", setting, *SETTINGS)
    fem = calibrate.load(results).hits[0]
    case, directory = read_case(ROOT / "cases" / "single-shot", (setting, *SETTINGS))
    runs = {
        f"dem-{speed:g}-{name}": Throw(speed, restitution, FINE_STEP)
        for name, restitution in (("stated", RESTITUTION), ("fem", round(fem.cor, 4)))
    }
    mass = resolve(case, directory).shot.mass
    dem, same = (shot_on_plate.hits(shot_on_plate.run(bench, name, throw), mass)[0] for name, throw in runs.items())
    return Pair(speed, fem, dem, same, resolve(case, directory), shot_on_plate.scene(bench, next(iter(runs))))


def pressure_rows(one: Pair) -> list[Row]:
    """What the FE run hands to the DEM and to the look-up table."""
    hit, sigma_y = one.fem, one.scene.material.A
    profile = contact_pictures.at_peak(hit)
    return [
        Row(
            f"restitution at {one.speed:g} m/s",
            RESTITUTION,
            hit.cor,
            "",
            f"Johnson–Cook set `{one.scene.material.name}`, elements of {MESH_SIZE}; the paper does not state its set",
        ),
        Row(
            "diameter of the dent",
            "0.1–0.3 mm",
            1e3 * hit.dent_diameter,
            "mm",
            "of shots as the paper's text sees them; here where the "
            f"dent crosses the original surface, at {one.speed:g} m/s",
        ),
        Row(
            "Figure 9: mean pressure at the peak force over the yield stress",
            3.0,
            profile.mean / sigma_y,
            "",
            f"force over contact area; σ_y is the static yield stress, {1e-6 * sigma_y:.0f} MPa, and the flow stress "
            "under the shot is higher by hardening and rate",
        ),
        Row(
            "Figure 9: largest mean pressure over the yield stress",
            3.0,
            hit.max_mean_pressure / sigma_y,
            "",
            f"from a tenth of the peak force on; at the peak it is {1e-9 * profile.mean:.2f} GPa",
        ),
        Row(
            "Figure 9: pressure near the rim over that of the inner half",
            "almost flat",
            profile.rim / profile.inner,
            "",
            "at the peak force, rings from 0.8 to 0.95 of the contact radius against those within a half",
        ),
    ]


def table_2(one: Pair) -> list[Row]:
    """Table 2 at one speed."""
    return [*force_rows(one), *duration_rows(one), *impulse_rows(one)]


def force_rows(one: Pair) -> list[Row]:
    """Largest forces."""
    v, at = one.speed, table_2_at(one)
    damped, rigid = hertz(one.dem_modulus, one.plate, v)[0], hertz(one.rigid_modulus, one.scene, v)[0]
    dem, fem = one.dem_figures, one.fem_figures
    return [
        Row(
            f"{at}: largest force, DEM",
            DEM_PAPER[0],
            one.dem.peak,
            "N",
            f"damped Hertz, E* {1e-9 * one.dem_modulus:.0f} GPa, e = {RESTITUTION:g}; undamped it is {damped:.1f} N",
        ),
        Row(
            f"{at}: largest force, FEM",
            FEM_PAPER[0],
            one.fem.peak_force,
            "N",
            f"the metal yields; were it elastic, the rigid sphere would meet {rigid:.1f} N",
        ),
        Row(
            f"{at}: largest force, FEM against DEM",
            VARIATION[0],
            100 * (fem[0] / dem[0] - 1),
            "%",
            "the DEM's law does not know where the metal yields, only how much energy is lost",
        ),
    ]


def duration_rows(one: Pair) -> list[Row]:
    """How long the contact lasts, by one rule."""
    at, rule = table_2_at(one), " to ".join(f"{100 * share:g}" for share in IMPULSE_SHARES)
    dem, fem = one.dem_figures, one.fem_figures
    return [
        Row(
            f"{at}: duration, DEM",
            US * DEM_PAPER[1],
            US * dem[1],
            "µs",
            f"from {rule} % of the impulse while the force pushes; the paper does not define it",
        ),
        Row(
            f"{at}: duration, FEM",
            US * FEM_PAPER[1],
            US * fem[1],
            "µs",
            f"by the same rule, of means over {NS * FORCE_WINDOW:g} ns; of single steps "
            f"{US * one.fem.contact_time:.3f} µs",
        ),
        Row(
            f"{at}: duration, FEM against DEM",
            VARIATION[1],
            100 * (fem[1] / dem[1] - 1),
            "%",
            "each has its own law of force over depth; the paper finds them equal to two digits",
        ),
        Row(
            f"{at}: overlap ends, DEM",
            US * DEM_PAPER[1],
            US * one.dem.ended,
            "µs",
            f"after first touch, to within a step of {NS * one.dem.step:.1f} ns: at last damping exceeds the spring "
            "and pulls at the shot, which a count of overlaps takes for contact",
        ),
    ]


def impulse_rows(one: Pair) -> list[Row]:
    """What the paper calls force × duration."""
    at, mass = table_2_at(one), one.scene.shot.mass
    needed = [paper[2] / (mass * (1 + cor)) for paper, cor in ((DEM_PAPER, RESTITUTION), (FEM_PAPER, one.fem.cor))]
    dem, fem = one.dem_figures, one.fem_figures
    return [
        Row(
            f"{at}: impulse, DEM",
            US * DEM_PAPER[2],
            US * one.dem.impulse,
            "µN s",
            f"m v (1 + e) with m = {1e6 * mass:.4f} mg; the paper's needs {needed[0]:.0f} m/s. Its *Force x Duration* "
            f"is read as the integral: the product of its two rows is {US * DEM_PAPER[0] * DEM_PAPER[1]:.1f} µN s",
        ),
        Row(
            f"{at}: impulse, FEM",
            US * FEM_PAPER[2],
            US * one.fem.impulse,
            "µN s",
            f"likewise with e = {one.fem.cor:.3f}; the paper's needs {needed[1]:.0f} m/s",
        ),
        Row(
            f"{at}: impulse, FEM against DEM",
            VARIATION[2],
            100 * (fem[2] / dem[2] - 1),
            "%",
            f"the difference of e alone, {one.fem.cor:.3f} against {RESTITUTION:g}; its two printed impulses differ by "
            f"{100 * abs(FEM_PAPER[2] / DEM_PAPER[2] - 1):.1f} %",
        ),
    ]


def table_2_at(one: Pair) -> str:
    """How its rows begin."""
    return f"Table 2 at {one.speed:g} m/s"


def order_rows(pairs: Sequence[Pair]) -> list[Row]:
    """What Figures 11 and 12 say in words."""
    return [
        Row(
            f"Figure 11 at {one.speed:g} m/s: the shot stands still, DEM over FEM",
            "below 1",
            one.dem.turn / one.fem_turn,
            "",
            f"{NS * one.dem.turn:.0f} against {NS * one.fem_turn:.0f} ns after first touch",
        )
        for one in pairs
    ]


def all_runs(pairs: Sequence[Pair]) -> Table:
    """Every hit, and the closed forms between which they lie."""
    lines: list[list[float | str]] = [
        ["paper, DEM", STATED, RESTITUTION, *handy(*DEM_PAPER)],
        ["paper, FEM", STATED, "about 0.4", *handy(*FEM_PAPER)],
    ]
    for one in pairs:
        fem, v = one.fem, one.speed
        lines += [
            ["FEM", v, fem.cor, *handy(*one.fem_figures)],
            ["DEM", v, RESTITUTION, *handy(*one.dem_figures)],
            ["DEM, FEM's restitution", v, fem.cor, *handy(*dem_figures(one.same))],
            ["elastic, DEM's moduli", v, 1.0, *handy(*hertz(one.dem_modulus, one.plate, v))],
            ["elastic, rigid sphere", v, 1.0, *handy(*hertz(one.rigid_modulus, one.scene, v))],
        ]
    head = ["hit", "speed [m/s]", "restitution", "largest force [N]", "duration [µs]", "impulse [µN s]", "J/(F T)"]
    return Table("Every run, and elastic hits in closed form", head, lines)


def handy(force: float, duration: float, impulse: float) -> tuple[float, float, float, float]:
    """Force, duration, impulse in the table's units, and the history's fullness."""
    return force, US * duration, US * impulse, impulse / (force * duration)


def verdict(pairs: Sequence[Pair]) -> str:
    """How the paper's three figures go together, here and there."""
    dem = nearest("DEM", DEM_PAPER, {one.speed: one.dem_figures for one in pairs})
    fem = nearest("FEM", FEM_PAPER, {one.speed: one.fem_figures for one in pairs})
    one = pairs[0]
    elastic = [hertz(one.rigid_modulus, one.scene, STATED)[0], hertz(one.dem_modulus, one.plate, STATED)[0]]
    over = all(paper[0] > limit for paper, limit in zip((FEM_PAPER, DEM_PAPER), elastic, strict=True))
    full = [impulse / (force * duration) for force, duration, impulse in (DEM_PAPER, FEM_PAPER)]
    return (
        f"The paper's Table 2 does not fit one hit at {STATED:g} m/s: its impulse asks for {pairs[1].speed:g} m/s at "
        f"its own restitution of {RESTITUTION:g}, and its largest forces, {FEM_PAPER[0]:g} and {DEM_PAPER[0]:g} N, "
        f"{'exceed' if over else 'stand beside'} those of elastic hits by Hertz, {elastic[0]:.1f} N (rigid sphere) and "
        f"{elastic[1]:.1f} N. So both speeds are shown and nothing is fitted. Its {dem}; its {fem}. "
        f"J/(F T) is how full a force history is (a half sine has {2 / math.pi:.3f}, a triangle 0.5): the paper's two "
        f"columns have {full[0]:.3f} and {full[1]:.3f}."
    )


def nearest(name: str, paper: Sequence[float], runs: Mapping[float, Sequence[float]]) -> str:
    """At which speed a column of Table 2 is met best, and by how much it is missed there."""
    off = {speed: max(abs(a / b - 1) for a, b in zip(found, paper, strict=True)) for speed, found in runs.items()}
    best = min(off, key=off.__getitem__)
    return (
        f"{name} column is met better, of the two speeds, at {best:g} m/s, where the worst of the three figures is off "
        f"by {100 * off[best]:.0f} %"
    )


def captions(one: Pair, fitting: float) -> dict[str, str]:
    """What the pictures show."""
    return {
        "unit-cell.png": "Figure 8. The unit cell under its shot, cut open along a plane of symmetry; computed is a "
        "quarter. Waves leave through the far sides and the bottom, where the paper's cell has symmetry.",
        "pressure.svg": f"Figure 9. Left: contact pressure over radius at {one.speed:g} m/s, rings one element wide, "
        f"centred means over {NS * FORCE_WINDOW:g} ns. Right: force over contact area. Both over the static yield "
        "stress A.",
        "velocity.svg": f"Figure 11. Velocity of the shot by FEM and DEM, at the paper's speed and at {fitting:g} m/s. "
        "The DEM's damping pulls at the shot while it leaves.",
        "force.svg": "Figure 12. Contact force of the same hits; dotted strokes are the largest forces of Table 2. "
        "Below zero the DEM's damping pulls at the shot that leaves; the metal only pushes.",
    }


PART = Part(
    title="One shot by FEM and by DEM",
    of="section 2.2, Table 2, Figures 8, 9, 11 and 12",
    here="`cases/single-shot` (`peenflow.calibrate`: history.csv, pressure.csv, dent.csv); LIGGGHTS behind "
    "`peenflow.dem.liggghts` with `[dem] restitution`, `accuracy.contact_interval = 1`",
    measure=measure,
    lasts=130,
    elements="Finer, for the pressure over the radius; DEM runs use nothing of their coarse unit cell.",
)
