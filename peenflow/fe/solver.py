"""The explicit solver: steps in bundles, with everything that need not happen every step between them."""

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from peenflow.errors import RunError
from peenflow.fe import activity, boundary, external, motion, ordering, pressure
from peenflow.fe import balls as spheres
from peenflow.fe.contact import Balls, Surface, correct
from peenflow.fe.internal_forces import HOURGLASS, add_internal_forces
from peenflow.fe.ledger import Ledger
from peenflow.fe.model import build
from peenflow.fe.recorder import ContactRecorder
from peenflow.fe.rows import LANES
from peenflow.fe.timestep import damped, least_transit_time
from peenflow.records.deck import Deck

BUNDLE = 20  # steps between looks at step size, candidates, energies and whether all is well
SMALLER = 0.6  # of the step, each time the guard has gone back
LARGEST_GROWTH = 0.1  # of the energy, over all that was brought in, at which a run is stopped before its end


class UnstableError(RunError):
    """The solution has gone wrong; `short` says what and where, the message what to do as well."""

    def __init__(self, short: str, advice: str) -> None:
        super().__init__(f"{short} {advice}")
        self.short = short


FIELDS = ("u", "v", "force", "deviator", "peeq", "temperature", "hottest", "backstress")  # in the deck's precision


@dataclass
class State:
    """What changes from step to step: all a checkpoint must hold."""

    step: int
    time: float  # s
    dt: float  # s, next step
    last_dt: float  # s
    u: np.ndarray  # (n, 3) m
    v: np.ndarray  # (n, 3) m/s, half a step ago
    force: np.ndarray  # (threads, n, 3) N, internal forces at `time`
    deviator: np.ndarray  # (b, 5·LANES) Pa
    peeq: np.ndarray  # (b, LANES)
    temperature: np.ndarray  # (b, LANES) K
    hottest: np.ndarray  # (b, LANES) K, in groups before the present one; one block where nothing softens
    backstress: np.ndarray  # (b, 5·LANES) Pa, static; one block where there is none
    active: np.ndarray  # numbers of the blocks of elements that take part
    balls: Balls
    ledger: Ledger
    recorder: ContactRecorder
    first_dt: float = 0.0  # s
    relaxing_since: float = np.nan  # s, NaN while impacts go on
    hourglass_ratio: float = 0.0  # at the end of the impacts
    damping: float = 0.04  # share of its velocity that a node loses each step of the relaxation
    groups_begun: int = 0
    retries: int = 0  # times the guard went back, each with smaller steps


class Solver:
    """A deck in motion."""

    def __init__(self, deck: Deck, threads: int) -> None:
        self.deck, self.order = ordering.local(deck)
        self.model = build(self.deck, threads)
        self.threads = threads
        self.state = self._initial()
        self.as_in_motion()
        self.friction = deck.spheres.friction if deck.spheres else 0.0
        self.list_candidates(0.0)
        self._impulses = np.zeros((len(self.state.balls.radius), 3))
        self._kinetic = np.zeros((threads, 8))
        self._least = np.zeros((threads, 2))
        self._external = np.zeros((len(self.model.X) if len(self.model.loaded) else 0, 3))
        self._before_far = np.zeros((len(self.model.far.nodes), 3))
        self._before_loads = np.zeros((len(self.model.loaded), 3))

    def _initial(self) -> State:
        model, n, b = self.model, len(self.model.X), len(self.model.blocks.nodes)
        real, thermal = model.X.dtype, self.deck.material.thermal
        state = State(
            step=0,
            time=0.0,
            dt=0.0,
            last_dt=0.0,
            u=np.zeros((n, 3), real),
            v=np.zeros((n, 3), real),
            force=np.zeros((self.threads, n, 3), real),
            deviator=np.zeros((b, 5 * LANES), real),
            peeq=np.zeros((b, LANES), real),
            temperature=np.full((b, LANES), thermal.initial if thermal else 0.0, real),
            hottest=np.full((b if thermal else 1, LANES), thermal.initial if thermal else 0.0, real),
            backstress=np.zeros((b if model.kinematic else 1, 5 * LANES), real),
            active=activity.everywhere(model),
            balls=spheres.initial(model),
            ledger=Ledger(self.threads),
            recorder=ContactRecorder(),
        )
        state.ledger.work = state.ledger.shots = spheres.kinetic_energy(state.balls)
        return state

    def as_in_motion(self) -> None:
        """Masses, far field, viscosity, precision and who takes part, of real motion; relaxation changes them."""
        for name in FIELDS:
            setattr(self.state, name, np.asarray(getattr(self.state, name), self.model.X.dtype))
        self._take_up()
        self.mass, self.viscosity = self.model.mass, self.model.viscosity

    def go_on_in_double(self) -> None:
        """Double precision from now on: single precision's noise in the pressure hides residuals of thousandths."""
        if self.model.X.dtype == np.float64:
            return
        controls = dataclasses.replace(self.deck.controls, precision="float64")
        self.model = build(dataclasses.replace(self.deck, controls=controls), self.threads)
        self.as_in_motion()

    def take_over(self, earlier: "Solver") -> None:
        """Start from where an earlier run of the same mesh came to rest, its heat gone (`_cool`)."""
        state, before = self.state, earlier.state
        state.u, state.force = before.u.copy(), before.force.copy()
        state.deviator, state.peeq = before.deviator.copy(), before.peeq.copy()
        state.backstress = before.backstress.copy()
        # internal energy counts from here, hourglass energy is what elements hold: of that, this much is brought along
        state.ledger.work += before.ledger.of_elements(HOURGLASS)

    @property
    def share(self) -> float:
        """Of the stable step, after what the guard has taken off."""
        return float(self.deck.controls.time_step_share * SMALLER**self.state.retries)

    @property
    def touching(self) -> bool:
        """A sphere got an impulse in the last step."""
        recorder = self.state.recorder
        return bool(recorder.time) and recorder.time[-1] + 1.5 * recorder.step[-1] > self.state.time

    def unfinished(self, until: float) -> bool:
        """Time `until` [s] is not reached, or a sphere still touches."""
        return self.state.time < until or self.touching

    def run(self, until: float, after_step: Callable[["Solver"], None] | None = None) -> None:
        """Step to time `until` [s], and on while a sphere still touches.

        Raises:
            UnstableError: an element inverted, a figure is no longer finite, or energy grows.
        """
        while self.unfinished(until):
            self.bundle(after_step)

    def bundle(self, after_step: Callable[["Solver"], None] | None = None) -> None:
        """BUNDLE steps of one size, after a look at what may have changed."""
        state = self.state
        state.dt = self.stable_step()
        state.first_dt = state.first_dt or state.dt
        self._cool(state.time + BUNDLE * state.dt)
        if self.model.spheres is not None:
            horizon = BUNDLE * state.dt
            spheres.update_phases(state.balls, self.model.spheres, state.time, 2 * horizon)
            self.list_candidates(horizon)
            self._wake()
        for _ in range(BUNDLE):
            self.step()
            if after_step is not None:
                after_step(self)
        state.ledger.sample(state.time)
        self._look()

    def _cool(self, until: float) -> None:
        """Back to the part's initial temperature where a group of impacts starts before `until` [s].

        A hit is adiabatic. Groups stand for hits on one place that are further apart than its heat needs to leave.
        """
        state, starts, thermal = self.state, self.deck.group_starts, self.deck.material.thermal
        if starts is None or thermal is None:
            return
        begun = int(np.searchsorted(starts, until))
        if begun > state.groups_begun:
            np.maximum(state.hottest, state.temperature, out=state.hottest)
            state.temperature[:] = thermal.initial
            state.groups_begun = begun

    def list_candidates(self, horizon: float) -> None:
        """Surface nodes that spheres may touch within `horizon` seconds."""
        state = self.state
        self.candidates = spheres.candidates(state.balls, self.model, state.u, state.v, horizon)

    def _wake(self) -> None:
        """Let elements near impacts take part, and others sleep, where the deck says so."""
        radius, state = self.deck.controls.active_radius, self.state
        if not radius or not np.isnan(state.relaxing_since):
            return
        lasting = 2 * radius / self.deck.material.c_s  # a shear wave's way there and back
        places = self.deck.spheres.point[activity.live(state.balls, state.time, lasting)]  # type: ignore[union-attr]
        self.let_take_part(activity.near(self.model, places, radius))

    def _take_up(self) -> None:
        """Who takes part, of elements, nodes and the far field's nodes, from `state.active`."""
        self.activity = activity.of_blocks(self.model, self.state.active)
        far, awake = self.model.far, self.activity.awake
        self.far = boundary.Absorbers(*(part[awake[far.nodes]] for part in far))

    def let_take_part(self, blocks: np.ndarray) -> None:
        """From now on those blocks (k,) of elements take part, and the nodes of no other."""
        state = self.state
        if np.array_equal(blocks, state.active):
            return
        hourglass = []
        for part in (activity.everywhere(self.model), blocks):
            state.active = part
            self._take_up()
            state.force[:] = 0.0
            self.update_forces(0.0)
            hourglass.append(float(state.ledger.elements[:, HOURGLASS].sum()))
        state.ledger.dormant = hourglass[0] - hourglass[1]
        standing = ~self.activity.awake
        speeds = np.einsum("ij,ij->i", state.v[standing], state.v[standing])
        state.ledger.absorbed += 0.5 * float(self.mass[standing] @ speeds)
        state.v[standing] = 0.0

    def stable_step(self) -> float:
        """The next step [s] from the deformed mesh.

        Raises:
            UnstableError: an element has inverted, or is not finite.
        """
        model, controls = self.model, self.deck.controls
        least_transit_time(
            model.ranges, model.blocks, model.elements, model.X, self.state.u, model.law.c_p, self._least
        )
        step, element = self._least[np.argmin(self._least[:, 0])]
        if not step > 0.0:
            e = int(element)
            raise UnstableError(
                f"The solver stopped at {self._now()}: element {self.order.elements[e]} at "
                f"{_place(model.X[self.deck.patch.hexes[e]].mean(axis=0))} of the patch has no volume left.",
                "A smaller accuracy.time_step or a finer accuracy.mesh_size bears larger deformation; a speed or a "
                "material constant may be out of range.",
            )
        return damped(float(step), self.share, controls.bulk_viscosity_linear)

    def step(self) -> None:
        """From tⁿ to tⁿ⁺¹: predict, correct at the boundaries and contacts, new internal forces."""
        model, state, ledger, dt = self.model, self.state, self.state.ledger, self.state.dt
        kick = 0.5 * (state.last_dt + dt)
        motion.remember(self.far.nodes, state.v, self._before_far)
        motion.remember(self.candidates.nodes, state.v, self.candidates.before)
        if len(model.loaded):
            motion.remember(model.loaded, state.v, self._before_loads)
            self._push()
        part = self.activity
        motion.advance(
            model.chunks, part.spans, part.awake, state.force, self.mass, state.u, state.v, kick, dt, self._kinetic
        )
        boundary.hold(model.rollers.nodes, model.rollers.projectors, state.u, state.v, dt)
        motion.remember(self.candidates.nodes, state.v, self.candidates.predicted)
        ledger.absorbed += boundary.absorb(self.far, self.mass, state.u, state.v, self._before_far, kick, dt)
        if len(model.loaded):
            ledger.work += external.work_done(model.loaded, self._external, self._before_loads, state.v, dt)
        if model.spheres is not None:
            self._collide(dt)
        ledger.kinetic = float(self._kinetic[:, 0].sum())
        state.time += dt
        state.step += 1
        state.last_dt = dt
        self.update_forces(dt)

    def _push(self) -> None:
        model, state = self.model, self.state
        external.clear(model.loaded, self._external)
        if model.loads is not None:
            pressure.add_pressure(model.loads, state.time, model.X, state.u, self._external)
        if model.forces is not None:
            external.add_prescribed(model.forces, state.time, self._external)
        external.add_at(model.loaded, self._external, state.force[0])

    def _collide(self, dt: float) -> None:
        model, state = self.model, self.state
        surface = Surface(model.X, state.u, state.v, self.mass, model.held, model.rollers.projectors)
        backwards = state.step % 2 == 1
        lost, rubbed = correct(state.balls, self.candidates, surface, dt, self.friction, self._impulses, backwards)
        state.ledger.contact += lost
        state.ledger.friction += rubbed
        state.ledger.shots = spheres.kinetic_energy(state.balls)
        state.recorder.take(state.time, dt, self._impulses, model.spheres.normal)  # type: ignore[union-attr]

    def update_forces(self, dt: float) -> None:
        """Internal forces of the present displacements into state.force, the material advanced by dt."""
        model, state, part = self.model, self.state, self.activity
        fields = (state.deviator, state.peeq, state.temperature, state.backstress)
        add_internal_forces(
            part.ranges, part.blocks, model.blocks, model.elements, model.undeformed, model.X, state.u, state.v,
            fields, state.force, state.ledger.elements, model.X.dtype.type(dt), model.law, self.viscosity,
            model.rate, model.thermal, model.kinematic,
        )  # fmt: skip

    def _look(self) -> None:
        """See whether energies are finite and balance.

        Raises:
            UnstableError: they are not, or do not.
        """
        ledger, model = self.state.ledger, self.model
        # what loads will have brought in, or a motion set by hand has, is not known: there only NaN tells
        judged = ledger.work > 0.0 and not len(model.loaded)
        growth = ledger.imbalance / ledger.work if judged else 0.0 * ledger.imbalance
        if growth <= LARGEST_GROWTH:
            return
        fastest = int(np.argmax(np.nan_to_num(np.abs(self.state.v).max(axis=1), nan=np.inf)))
        what = f"energy has grown by {100 * growth:.2g} %" if np.isfinite(growth) else "energies are no longer finite"
        raise UnstableError(
            f"The solver stopped at {self._now()}: {what}, nodes are fastest at {_place(model.X[fastest])}.",
            "Lower accuracy.time_step, and look for a speed or a material constant out of range.",
        )

    def _now(self) -> str:
        return f"step {self.state.step} ({self.state.time * 1e6:.4g} µs)"


def _place(point: np.ndarray) -> str:
    x, y, z = 1e3 * point.astype(float)
    return f"({x:.4g}, {y:.4g}, {z:.4g}) mm"
