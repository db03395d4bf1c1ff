"""Three-vectors and tensors as tuples of numbers, for formulas inside lane loops.

Tensors are ((xx, xy, xz), (yx, yy, yz), (zx, zy, zz)); symmetric ones (xx, yy, zz, xy, yz, zx).
"""

from peenflow.fe.jit import inlined, number


@inlined
def add(a, b):
    """a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@inlined
def subtracted(a, b):
    """a − b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@inlined
def scaled(s, a):
    """s a."""
    return s * a[0], s * a[1], s * a[2]


@inlined
def dot(a, b):
    """a · b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inlined
def cross(a, b):
    """a × b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@inlined
def add_outer(t, a, b):
    """t + a ⊗ b."""
    return (
        (t[0][0] + a[0] * b[0], t[0][1] + a[0] * b[1], t[0][2] + a[0] * b[2]),
        (t[1][0] + a[1] * b[0], t[1][1] + a[1] * b[1], t[1][2] + a[1] * b[2]),
        (t[2][0] + a[2] * b[0], t[2][1] + a[2] * b[1], t[2][2] + a[2] * b[2]),
    )


@inlined
def outer(a, b):
    """a ⊗ b."""
    return scaled(a[0], b), scaled(a[1], b), scaled(a[2], b)


@inlined
def apply_symmetric(s, a):
    """s · a for a symmetric s."""
    return (
        s[0] * a[0] + s[3] * a[1] + s[5] * a[2],
        s[3] * a[0] + s[1] * a[1] + s[4] * a[2],
        s[5] * a[0] + s[4] * a[1] + s[2] * a[2],
    )


@inlined
def scaled_tensor(s, t):
    """s t."""
    return scaled(s, t[0]), scaled(s, t[1]), scaled(s, t[2])


@inlined
def double_dot(a, b):
    """a : b of symmetric tensors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + number(2.0, a[0]) * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
