"""Who is next: a binary heap of all shots by the time of their next event, each shot's place in it known."""

import numpy as np

from peenflow.dem.event_driven.jit import inner


@inner
def place(world, i, due, what, whom, path):
    """Set what shot `i` does next, and move it to its place in the heap."""
    shots, heap = world.shots, world.heap
    shot = shots[i]
    shot.due, shot.what, shot.whom, shot.whose_path = due, what, whom, path
    _down(shots, heap, _up(shots, heap, shot.place))


@inner
def never(world, i):
    """Shot `i` does nothing more."""
    place(world, i, np.inf, world.shots[i].what, -1, 0)


@inner
def _up(shots, heap, k):
    while k > 0 and shots[heap[k]].due < shots[heap[(k - 1) // 2]].due:
        _swap(shots, heap, k, (k - 1) // 2)
        k = (k - 1) // 2
    return k


@inner
def _down(shots, heap, k):
    n = len(heap)
    while True:
        least = k
        for child in (2 * k + 1, 2 * k + 2):
            if child < n and shots[heap[child]].due < shots[heap[least]].due:
                least = child
        if least == k:
            return
        _swap(shots, heap, k, least)
        k = least


@inner
def _swap(shots, heap, a, b):
    heap[a], heap[b] = heap[b], heap[a]
    shots[heap[a]].place, shots[heap[b]].place = a, b
