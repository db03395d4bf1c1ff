"""The loop: the earliest event happens, and who took part looks ahead again."""

from peenflow.dem.event_driven.flight import fly, position
from peenflow.dem.event_driven.foresight import cell_number, change_path, foresee, foresee_rod, rod_place
from peenflow.dem.event_driven.jit import inner, kernel
from peenflow.dem.event_driven.meeting import feature_normal
from peenflow.dem.event_driven.queue import never, place
from peenflow.dem.event_driven.rebound import meet, strike
from peenflow.dem.event_driven.state import (
    BENDS,
    CROSSES,
    EVENTS,
    FLYING,
    GONE,
    HITS_ROD,
    HITS_TARGET,
    LEFT,
    MEETINGS,
    MEETS,
    RETURNED,
    RETURNS,
    ROWS,
    THROWN,
    UNTHROWN,
    WEDGED,
)
from peenflow.dem.event_driven.vectors import minus, norm, of, put

WEDGE = 100  # contacts in a row, each within the time of one after the last, after which a shot is taken out


@kernel
def advance(world, until, latest, limit):
    """Let events happen up to time `until`, at most `limit` of them, or until there is no room for more hits.

    Args:
        world: as it stands.
        until: [s].
        latest: [s], until when shots are thrown.
        limit: events.

    Returns:
        The time of the next event [s], above `until` when all is done.
    """
    shots, heap, tally = world.shots, world.heap, world.tally
    for _ in range(limit):
        if shots[heap[0]].due > until or tally[ROWS] == len(world.hits):
            break
        tally[EVENTS] += 1
        _happen(world, heap[0], latest)
    return shots[heap[0]].due


@kernel
def turn(world, now):
    """The rod has a new phase from `now` on: every shot in flight looks ahead again."""
    for i in range(len(world.shots)):
        if world.shots[i].state == FLYING:
            fly(world.shots[i], now)
            foresee_rod(world.shots[i], world.rod)
            foresee(world, i)


@inner
def _happen(world, i, latest):
    shot = world.shots[i]
    if shot.what == THROWN:
        _throw(world, i, latest)
        return
    fly(shot, shot.due)
    if shot.what == CROSSES:
        _cross(world, i, shot.whom)
    elif shot.what == HITS_TARGET:
        _hit(world, i, 0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), world.target[shot.whom])
    elif shot.what == HITS_ROD:
        _hit(world, i, 1, rod_place(world.rod, shot.t), world.rod.velocity, world.rod.features[shot.whom])
    elif shot.what == MEETS:
        _meet(world, i, shot.whom)
    elif shot.what == RETURNS:
        _remove(world, i, RETURNED)
    elif shot.what == BENDS:
        change_path(world, i)


@inner
def _hit(world, i, surface, moved, velocity, feature):
    """Shot `i` touches a feature of a surface that has `moved` and moves with `velocity`."""
    shot, row = world.shots[i], world.tally[ROWS]
    hit = world.hits[row]
    hit.shot, hit.surface, hit.facet = i, surface, feature.facet
    put(hit.normal, feature_normal(minus(of(shot.x), moved), feature))
    put(hit.wall_velocity, velocity)
    strike(world.law, world.table, world.hits, row, shot, shot.t)
    world.tally[ROWS] += 1
    _go_on(world, i)


@inner
def _meet(world, i, j):
    one, other = world.shots[i], world.shots[j]
    if other.path != one.whose_path:
        foresee(world, i)  # the other has changed its path since
        return
    fly(other, one.t)
    meet(world.law, one, other, one.t)
    world.tally[MEETINGS] += 1
    _go_on(world, i)
    _go_on(world, j)


@inner
def _go_on(world, i):
    """After a contact; a shot that only trembles in a wedge is taken out."""
    if world.shots[i].quick > WEDGE:
        _remove(world, i, WEDGED)
    else:
        change_path(world, i)


@inner
def _throw(world, i, latest):
    """Shot `i` leaves its nozzle, or waits for the time of one diameter while another is in its way."""
    shot = world.shots[i]
    now = shot.due
    if world.law.meets and not _room(world.grid, world.shots, i, now):
        later = now + 2 * shot.radius / norm(of(shot.v))
        if later > latest:
            _remove(world, i, UNTHROWN)
        else:
            place(world, i, later, THROWN, -1, 0)
        return
    shot.t, shot.state = now, FLYING
    _enter(world.grid, world.shots, i)
    change_path(world, i)


@inner
def _room(grid, shots, i, now):
    shot = shots[i]
    x, cell = of(shot.x), of(shot.cell)
    for a in range(cell[0] - 1, cell[0] + 2):
        for b in range(cell[1] - 1, cell[1] + 2):
            for c in range(cell[2] - 1, cell[2] + 2):
                number = cell_number(grid, a, b, c)
                j = grid.head[number] if number >= 0 else -1
                while j >= 0:
                    if norm(minus(x, position(shots[j], now))) < shot.radius + shots[j].radius:
                        return False
                    j = shots[j].next
    return True


@inner
def _cross(world, i, side):
    """Shot `i` goes into the next cell, or out of the domain."""
    shot, axis = world.shots[i], side // 2
    _leave(world.grid, world.shots, i)
    shot.cell[axis] += 1 if side % 2 else -1
    if shot.cell[axis] < 0 or shot.cell[axis] >= world.grid.shape[axis]:
        _end(world, i, LEFT)
    else:
        _enter(world.grid, world.shots, i)
        foresee(world, i)


@inner
def _remove(world, i, reason):
    if world.shots[i].state == FLYING:
        _leave(world.grid, world.shots, i)
    _end(world, i, reason)


@inner
def _end(world, i, reason):
    shot = world.shots[i]
    shot.state = GONE
    shot.path += 1
    world.tally[reason] += 1
    never(world, i)


@inner
def _enter(grid, shots, i):
    """Into the list of its cell."""
    shot = shots[i]
    number = cell_number(grid, shot.cell[0], shot.cell[1], shot.cell[2])
    first = grid.head[number]
    shot.next, shot.previous = first, -1
    if first >= 0:
        shots[first].previous = i
    grid.head[number] = i


@inner
def _leave(grid, shots, i):
    """Out of the list of its cell."""
    shot = shots[i]
    if shot.previous >= 0:
        shots[shot.previous].next = shot.next
    else:
        grid.head[cell_number(grid, shot.cell[0], shot.cell[1], shot.cell[2])] = shot.next
    if shot.next >= 0:
        shots[shot.next].previous = shot.previous
