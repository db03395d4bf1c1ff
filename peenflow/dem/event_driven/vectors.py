"""Vectors of three numbers as tuples: numba keeps them in registers."""

import math

from peenflow.dem.event_driven.jit import kernel


@kernel
def of(array):
    """The vector in an array (3,)."""
    return (array[0], array[1], array[2])


@kernel
def put(array, a):
    """Write a vector into an array (3,)."""
    array[0], array[1], array[2] = a


@kernel
def dot(a, b):
    """a·b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def cross(a, b):
    """a×b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@kernel
def plus(a, s, b):
    """a + s b."""
    return (a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2])


@kernel
def minus(a, b):
    """a − b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


@kernel
def times(s, a):
    """s a."""
    return (s * a[0], s * a[1], s * a[2])


@kernel
def norm(a):
    """|a|."""
    return math.sqrt(dot(a, a))
