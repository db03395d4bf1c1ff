"""What a shot will do next on its present path, if no other changes its own.

A shot keeps only its earliest event. That is enough: whoever changes its path looks at all its neighbours again, so a
meeting is always known to the one of the two who changed last, and an event with a shot that has changed since is
thrown away and foreseen anew when it is due (Lubachevsky, J. Comput. Phys. 94 (1991) 255).
"""

import math

from peenflow.dem.event_driven.flight import position, set_out
from peenflow.dem.event_driven.jit import inner
from peenflow.dem.event_driven.meeting import box_time, feature_time, point_time
from peenflow.dem.event_driven.queue import place
from peenflow.dem.event_driven.state import BENDS, CROSSES, HITS_ROD, HITS_TARGET, MEETS, RETURNS
from peenflow.dem.event_driven.vectors import dot, minus, norm, of, plus


@inner
def change_path(world, i):
    """Shot `i` goes on from here with its present velocity: new path, new events."""
    set_out(world.shots[i], world.forces)
    foresee_rod(world.shots[i], world.rod)
    _foresee_return(world.shots[i], world.nozzles)
    foresee(world, i)


@inner
def foresee(world, i):
    """Find the earliest event of shot `i` from its own time on."""
    shots, grid = world.shots, world.grid
    shot = shots[i]
    now = shot.t
    due, what, whom, path = shot.until, BENDS, -1, 0
    if shot.rod_due < due:
        due, what, whom = shot.rod_due, HITS_ROD, shot.rod_feature
    if shot.home_due < due:
        due, what = shot.home_due, RETURNS
    t, side = _crossing(grid, shot)
    if now + t < due:
        due, what, whom = now + t, CROSSES, side
    t, feature = _target(grid, world.target, shot)
    if now + t < due:
        due, what, whom = now + t, HITS_TARGET, feature
    if world.law.meets:
        t, other = _meeting(grid, shots, i)
        if now + t < due:
            due, what, whom, path = now + t, MEETS, other, shots[other].path
    place(world, i, due, what, whom, path)


@inner
def _crossing(grid, shot):
    """When a shot leaves its cell, and across which side: 2·axis, +1 upwards."""
    t, side = math.inf, -1
    for k in range(3):
        if shot.go[k] != 0:
            upwards = 1 if shot.go[k] > 0 else 0
            wall = grid.low[k] + (shot.cell[k] + upwards) * grid.size
            reached = max(0.0, (wall - shot.x[k]) / shot.go[k])
            if reached < t:
                t, side = reached, 2 * k + upwards
    return t, side


@inner
def cell_number(grid, a, b, c):
    """Of the cell in the grid's arrays; −1 outside."""
    if a < 0 or b < 0 or c < 0 or a >= grid.shape[0] or b >= grid.shape[1] or c >= grid.shape[2]:
        return -1
    return (a * grid.shape[1] + b) * grid.shape[2] + c


@inner
def _target(grid, target, shot):
    x, u = of(shot.x), of(shot.go)
    number = cell_number(grid, shot.cell[0], shot.cell[1], shot.cell[2])
    best, which = math.inf, -1
    for k in range(grid.first[number], grid.first[number + 1]):
        t = feature_time(x, u, shot.radius, target[grid.feature[k]])
        if t < best:
            best, which = t, grid.feature[k]
    return best, which


@inner
def _meeting(grid, shots, i):
    """The first of the shots in this and the 26 cells around, which are no smaller than a shot."""
    shot = shots[i]
    now, x, u, cell = shot.t, of(shot.x), of(shot.go), of(shot.cell)
    best, which = math.inf, -1
    for a in range(cell[0] - 1, cell[0] + 2):
        for b in range(cell[1] - 1, cell[1] + 2):
            for c in range(cell[2] - 1, cell[2] + 2):
                number = cell_number(grid, a, b, c)
                j = grid.head[number] if number >= 0 else -1
                while j >= 0:
                    if j != i:
                        other = shots[j]
                        away = minus(x, position(other, now))
                        t = point_time(away, minus(u, of(other.go)), shot.radius + other.radius)
                        if t < best and now + t <= other.until:
                            best, which = t, j
                    j = shots[j].next
    return best, which


@inner
def foresee_rod(shot, rod):
    """When a shot on its present path meets the rod in the rod's present phase."""
    shot.rod_due = math.inf
    if len(rod.features) == 0:
        return
    now = shot.t
    r = minus(of(shot.x), rod_place(rod, now))
    u = minus(of(shot.go), rod.velocity)
    latest = min(rod.until, shot.until)
    if now + box_time(r, u, shot.radius, rod.low, rod.high) > latest:
        return
    for k in range(len(rod.features)):
        due = now + feature_time(r, u, shot.radius, rod.features[k])
        if due < shot.rod_due and due <= latest:
            shot.rod_due, shot.rod_feature = due, k


@inner
def rod_place(rod, now):
    """How far the rod has moved since t = 0."""
    return plus(rod.offset, now - rod.since, rod.velocity)


@inner
def _foresee_return(shot, nozzles):
    """When a shot on its present path flies backwards through a nozzle's disc."""
    shot.home_due = math.inf
    x, u = of(shot.x), of(shot.go)
    for k in range(len(nozzles)):
        direction = of(nozzles[k].direction)
        away = minus(x, of(nozzles[k].position))
        ahead, coming = dot(away, direction), -dot(u, direction)
        if coming > 0 and ahead >= 0:
            t = ahead / coming
            due = shot.t + t
            if norm(plus(away, t, u)) <= nozzles[k].radius and due < min(shot.home_due, shot.until):
                shot.home_due = due
