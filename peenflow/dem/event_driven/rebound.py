"""What a touch does to velocities and spins: hard spheres with restitution and Coulomb friction.

Walton's rule (O. R. Walton, in Particulate Two-Phase Flow, ed. M. C. Roco, 1993, ch. 25; Foerster et al., Phys. Fluids
6 (1994) 1108): the normal impulse is (1+e) m* times the approach; the tangential one turns the contact's tangential
velocity g_t into −β g_t, (1+β)(2/7) m* g_t for solid spheres, unless that exceeds μ times the normal one: it slides.
"""

import numpy as np

from peenflow.dem.event_driven.jit import inner
from peenflow.dem.event_driven.vectors import cross, dot, minus, norm, of, plus, put, times

ROLLING = 2 / 7  # of g_t m*: impulse after which a solid sphere rolls


@inner
def impulse(g, n, mass, e, tangential, law):
    """Impulse on the first body, and its tangential part over its normal one.

    Args:
        g: velocity of the first body's contact point against the second's [m/s].
        n: unit vector from the second to the first.
        mass: m* = 1/(1/m₁ + 1/m₂) [kg].
        e: restitution.
        tangential: β.
        law: friction, slowest rebound.
    """
    away = dot(g, n)
    normal = mass * max(0.0, max(-e * away, law.least) - away)
    slip = plus(g, -away, n)
    speed = norm(slip)
    if normal == 0 or speed == 0:
        return times(normal, n), (0.0, 0.0, 0.0)
    share = min((1 + tangential) * ROLLING * mass * speed / normal, law.friction)
    friction = times(-share / speed, slip)
    return times(normal, plus(n, 1.0, friction)), friction


@inner
def push(shot, n, j):
    """Give a shot the impulse `j` at its surface point −R n."""
    put(shot.v, plus(of(shot.v), 1 / shot.mass, j))
    put(shot.spin, plus(of(shot.spin), -2.5 / (shot.mass * shot.radius), cross(n, j)))


@inner
def surface_velocity(shot, n):
    """Of a shot where it is touched: v − R ω×n, `n` from the touched place to the centre."""
    return plus(of(shot.v), -shot.radius, cross(of(shot.spin), n))


@inner
def repeats(shot, now):
    """Note a contact of a shot; whether it follows the last one within the time of a contact."""
    again = now - shot.touched < shot.contact
    shot.quick = shot.quick + 1 if again else 0
    shot.touched = now
    return again


@inner
def tangential(law, values, e):
    """β at restitution `e`."""
    return np.interp(e, law.grid, values)


@inner
def meet(law, one, other, now):
    """Two shots, brought to `now`, touch."""
    r = minus(of(one.x), of(other.x))
    n = times(1 / norm(r), r)
    back = times(-1.0, n)
    g = minus(surface_velocity(one, n), surface_velocity(other, back))
    again, again_other = repeats(one, now), repeats(other, now)
    e = 1.0 if again or again_other or -dot(g, n) < law.slow else law.shots
    mass = one.mass * other.mass / (one.mass + other.mass)
    pushed, _ = impulse(g, n, mass, e, tangential(law, law.tangential_shots, e), law)
    push(one, n, pushed)
    push(other, back, times(-1.0, pushed))
    one.met, other.met = min(one.met, now), min(other.met, now)


@inner
def strike(law, table, hits, row, shot, now):
    """A shot, brought to `now`, touches a wall; `row` of the hits has its surface, facet, normal and wall velocity."""
    hit = hits[row]
    n = of(hit.normal)
    g = minus(surface_velocity(shot, n), of(hit.wall_velocity))
    hit.t, hit.approach = now, max(0.0, -dot(g, n))
    put(hit.point, plus(of(shot.x), -shot.radius, n))
    put(hit.velocity, of(shot.v))
    put(hit.spin, of(shot.spin))
    hit.restitution = law.wall
    if hit.surface == 0 and len(table.speed):
        hit.restitution = hardened(table, hits, row)
    if repeats(shot, now) or hit.approach < law.slow:
        hit.restitution = 1.0
    beta = tangential(law, law.tangential_wall, hit.restitution)
    pushed, friction = impulse(g, n, shot.mass, hit.restitution, beta, law)
    put(hit.friction, friction)
    push(shot, n, pushed)


@inner
def hardened(table, hits, row):
    """CoR by normal speed and by the hits that count within `near`; the hit itself then counts if it is hard enough."""
    point, approach = of(hits[row].point), hits[row].approach
    before = 0
    for a in range(-1, 2):
        for b in range(-1, 2):
            for c in range(-1, 2):
                earlier = table.head[_bin(table, point, a, b, c)]
                while earlier >= 0:
                    there = of(hits[earlier].point)
                    if _same_bin(table, there, point, a, b, c) and norm(minus(there, point)) < table.near:
                        before += 1
                    earlier = hits[earlier].older
    if approach >= table.counts:
        place = _bin(table, point, 0, 0, 0)
        hits[row].older, table.head[place] = table.head[place], row
    factor = table.factor[min(before, len(table.factor) - 1)]
    return min(1.0, max(0.0, np.interp(approach, table.speed, table.first) * factor))


@inner
def _cell(table, point, k):
    return int(np.floor(point[k] / table.near))


@inner
def _bin(table, point, a, b, c):
    """Hash of the cube `near` wide that lies a, b, c cubes from the point's (Teschner et al., VMV 2003)."""
    x, y, z = _cell(table, point, 0) + a, _cell(table, point, 1) + b, _cell(table, point, 2) + c
    return ((x * 73856093) ^ (y * 19349663) ^ (z * 83492791)) % len(table.head)


@inner
def _same_bin(table, there, point, a, b, c):
    """Whether `there` lies in that cube, and not in another of the same hash."""
    return (
        _cell(table, there, 0) == _cell(table, point, 0) + a
        and _cell(table, there, 1) == _cell(table, point, 1) + b
        and _cell(table, there, 2) == _cell(table, point, 2) + c
    )
