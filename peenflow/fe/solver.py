"""The explicit solver: steps in bundles, with everything that need not happen every step between them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from peenflow.errors import RunError
from peenflow.fe import balls as spheres
from peenflow.fe import boundary, motion, pressure
from peenflow.fe.contact import Balls, Surface, correct
from peenflow.fe.internal_forces import add_internal_forces
from peenflow.fe.lanes import LANES
from peenflow.fe.ledger import Ledger
from peenflow.fe.model import build
from peenflow.fe.recorder import ContactRecorder
from peenflow.fe.timestep import damped, least_transit_time
from peenflow.records.deck import Deck

BUNDLE = 20  # steps between looks at step size, candidates, energies and the guard


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
    balls: Balls
    ledger: Ledger
    recorder: ContactRecorder
    first_dt: float = 0.0  # s
    relaxing_since: float = np.nan  # s, NaN while impacts go on
    hourglass_ratio: float = 0.0  # at the end of the impacts


class Solver:
    """A deck in motion."""

    def __init__(self, deck: Deck, threads: int) -> None:
        self.deck = deck
        self.model = build(deck, threads)
        self.threads = threads
        self.state = self._initial()
        # relaxation puts others in the place of these
        self.mass, self.far, self.damping = self.model.mass, self.model.far, self.model.damping
        self.friction = deck.spheres.friction if deck.spheres else 0.0
        self.candidates = spheres.candidates(self.state.balls, self.model, self.state.u, 0.0)
        self._impulses = np.zeros((len(self.state.balls.radius), 3))
        self._kinetic = np.zeros((threads, 8))
        self._least = np.zeros((threads, 2))
        self._external = np.zeros_like(self.model.X)
        self._before_far = np.zeros((len(self.model.far.nodes), 3))
        self._before_loads = np.zeros((len(self.model.loads.nodes) if self.model.loads else 0, 3))

    def _initial(self) -> State:
        model, n, b = self.model, len(self.model.X), len(self.model.blocks)
        thermal = self.deck.material.thermal
        state = State(
            step=0,
            time=0.0,
            dt=0.0,
            last_dt=0.0,
            u=np.zeros((n, 3)),
            v=np.zeros((n, 3)),
            force=np.zeros((self.threads, n, 3)),
            deviator=np.zeros((b, 5 * LANES)),
            peeq=np.zeros((b, LANES)),
            temperature=np.full((b, LANES), thermal.initial if thermal else 0.0),
            balls=spheres.initial(model),
            ledger=Ledger(self.threads),
            recorder=ContactRecorder(),
        )
        state.ledger.work = state.ledger.shots = spheres.kinetic_energy(state.balls)
        return state

    def take_over(self, earlier: "Solver") -> None:
        """Start from where an earlier run of the same mesh came to rest."""
        state, before = self.state, earlier.state
        state.u, state.force = before.u.copy(), before.force.copy()
        state.deviator, state.peeq, state.temperature = (
            a.copy() for a in (before.deviator, before.peeq, before.temperature)
        )

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
            RunError: an element inverted or a figure is no longer finite.
        """
        while self.unfinished(until):
            self.bundle(after_step)

    def bundle(self, after_step: Callable[["Solver"], None] | None = None) -> None:
        """BUNDLE steps of one size, after a look at what may have changed."""
        state = self.state
        state.dt = self.stable_step()
        state.first_dt = state.first_dt or state.dt
        if self.model.spheres is not None:
            horizon = BUNDLE * state.dt
            spheres.update_phases(state.balls, self.model.spheres, state.time, 2 * horizon)
            self.candidates = spheres.candidates(state.balls, self.model, state.u, horizon)
        for _ in range(BUNDLE):
            self.step()
            if after_step is not None:
                after_step(self)
        state.ledger.sample(state.time)
        self._guard()

    def stable_step(self) -> float:
        """The next step [s] from the deformed mesh.

        Raises:
            RunError: an element has inverted, or is not finite.
        """
        model, controls = self.model, self.deck.controls
        least_transit_time(
            model.ranges, model.blocks, model.elements, model.X, self.state.u, model.law.c_p, self._least
        )
        step, element = self._least[np.argmin(self._least[:, 0])]
        if not step > 0.0:
            nodes = self.deck.patch.hexes[int(element)]
            x, y, z = 1e3 * (model.X[nodes].mean(axis=0))
            raise RunError(
                f"The solver stopped at {self._now()}: element {int(element)} at ({x:.4g}, {y:.4g}, {z:.4g}) mm of the "
                "patch has no volume left. A smaller accuracy.time_step or a finer accuracy.mesh_size bears larger "
                "deformation; a speed or a material constant may be out of range."
            )
        return damped(float(step), controls.time_step_share, controls.bulk_viscosity_linear)

    def step(self) -> None:
        """From tⁿ to tⁿ⁺¹: predict, correct at the boundaries and contacts, new internal forces."""
        model, state, ledger, dt = self.model, self.state, self.state.ledger, self.state.dt
        kick = 0.5 * (state.last_dt + dt)
        motion.remember(model.far.nodes, state.v, self._before_far)
        motion.remember(self.candidates.nodes, state.v, self.candidates.before)
        if model.loads is not None:
            motion.remember(model.loads.nodes, state.v, self._before_loads)
            pressure.load_forces(model.loads, state.time, model.X, state.u, self._external)
            pressure.add_at(model.loads.nodes, self._external, state.force[0])
        motion.advance(model.chunks, model.spans, state.force, self.mass, state.u, state.v, kick, dt, self._kinetic)
        boundary.hold(model.rollers.nodes, model.rollers.projectors, state.u, state.v, dt)
        ledger.absorbed += boundary.absorb(self.far, self.mass, state.u, state.v, self._before_far, kick, dt)
        if model.loads is not None:
            ledger.work += pressure.work_done(model.loads.nodes, self._external, self._before_loads, state.v, dt)
        if model.spheres is not None:
            self._collide(dt)
        ledger.kinetic = float(self._kinetic[:, 0].sum())
        state.time += dt
        state.step += 1
        state.last_dt = dt
        self.update_forces(dt)

    def _collide(self, dt: float) -> None:
        model, state = self.model, self.state
        surface = Surface(model.X, state.u, state.v, self.mass, model.held, model.rollers.projectors)
        lost, rubbed = correct(state.balls, self.candidates, surface, dt, self.friction, self._impulses)
        state.ledger.contact += lost
        state.ledger.friction += rubbed
        state.ledger.shots = spheres.kinetic_energy(state.balls)
        state.recorder.take(state.time, dt, self._impulses, model.spheres.normal)  # type: ignore[union-attr]

    def update_forces(self, dt: float) -> None:
        """Internal forces of the present displacements into state.force, the material advanced by dt."""
        model, state = self.model, self.state
        fields = (state.deviator, state.peeq, state.temperature)
        add_internal_forces(
            model.ranges, model.blocks, model.elements, model.X, state.u, state.v, fields,
            state.force, state.ledger.elements, dt, model.law, self.damping, model.rate, model.thermal,
        )  # fmt: skip

    def _guard(self) -> None:
        """Fail where a figure is no longer finite."""
        if not np.isfinite(self.state.ledger.imbalance):
            raise RunError(
                f"The solver stopped at {self._now()}: energies are no longer finite. Lower accuracy.time_step, and "
                "look for a speed or a material constant out of range."
            )

    def _now(self) -> str:
        return f"step {self.state.step} ({self.state.time * 1e6:.4g} µs)"
