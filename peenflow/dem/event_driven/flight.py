"""Paths between touches: straight, or chords of the path that gravity and drag bend.

A bent path is followed from chord to chord, each as long as the path deviates from it by `forces.deviation` radii at
most (|a| h²/8), its end found by one Runge–Kutta step of fourth order; on a chord the velocity changes linearly. So
every touch is one of straight flight, in closed form, whatever the forces.
"""

import math

from peenflow.dem.event_driven.jit import inner
from peenflow.dem.event_driven.vectors import minus, norm, of, plus, put, times

SHORTEST_MEMORY = 0.1  # of the time in which drag would stop the shot: the longest chord


@inner
def fly(shot, now):
    """Bring a shot to the time `now` on its present path."""
    h = now - shot.t
    put(shot.x, plus(of(shot.x), h, of(shot.go)))
    put(shot.v, plus(of(shot.v), h, of(shot.change)))
    shot.t = now


@inner
def position(shot, now):
    """Of a shot at `now`, on its present path."""
    return plus(of(shot.x), now - shot.t, of(shot.go))


@inner
def drag_rate(v, radius, forces):
    """How fast drag slows a shot, |a|/|v| [1/s]: 18μ/(ρd²)·(1 + 0.15 Re^0.687) (see `peenflow.drag`)."""
    if forces.air_density == 0:
        return 0.0
    diameter = 2 * radius
    reynolds = forces.air_density * norm(v) * diameter / forces.air_viscosity
    stokes = 18 * forces.air_viscosity / (forces.density * diameter**2)
    return stokes * (1 + forces.drag_factor * reynolds**forces.drag_power)


@inner
def acceleration(v, radius, forces):
    """Of a shot in gravity and still air [m/s²]."""
    return plus((0.0, 0.0, -forces.gravity), -drag_rate(v, radius, forces), v)


@inner
def set_out(shot, forces):
    """Give a shot a new path from where it is, with the velocity it has."""
    shot.path += 1
    v, radius = of(shot.v), shot.radius
    if forces.gravity == 0 and forces.air_density == 0:
        put(shot.go, v)
        return
    h = _chord(v, radius, forces)
    way, faster = _step(v, h, radius, forces)
    put(shot.go, times(1 / h, way))
    put(shot.change, times(1 / h, minus(faster, v)))
    shot.until = shot.t + h


@inner
def _chord(v, radius, forces):
    """Its duration [s]."""
    bend, rate = norm(acceleration(v, radius, forces)), drag_rate(v, radius, forces)
    h = math.sqrt(8 * forces.deviation * radius / bend) if bend > 0 else math.inf
    memory = SHORTEST_MEMORY / rate if rate > 0 else math.inf
    return min(h, memory)


@inner
def _step(v, h, radius, forces):
    """Way and velocity after `h`: Runge–Kutta of fourth order."""
    k1 = acceleration(v, radius, forces)
    v2 = plus(v, h / 2, k1)
    k2 = acceleration(v2, radius, forces)
    v3 = plus(v, h / 2, k2)
    k3 = acceleration(v3, radius, forces)
    v4 = plus(v, h, k3)
    k4 = acceleration(v4, radius, forces)
    way = times(h / 6, plus(plus(plus(v, 2.0, v2), 2.0, v3), 1.0, v4))
    return way, plus(v, h / 6, plus(plus(plus(k1, 2.0, k2), 2.0, k3), 1.0, k4))
