"""From the gradient of velocity to strain rate and rotation of a step."""

from peenflow.fe.jit import inlined, number


@inlined
def midstep_gradient(g, dt):
    """∂v/∂x in the configuration half a step ago, from g = ∂v/∂x in today's: L = g + Δt/2 g·g + O(Δt²).

    Strain measured half-way has no spurious stretch under rotation (Hughes & Winget 1980).
    """
    h = number(0.5, dt) * dt
    gx, gy, gz = g
    return (
        (
            gx[0] + h * (gx[0] * gx[0] + gx[1] * gy[0] + gx[2] * gz[0]),
            gx[1] + h * (gx[0] * gx[1] + gx[1] * gy[1] + gx[2] * gz[1]),
            gx[2] + h * (gx[0] * gx[2] + gx[1] * gy[2] + gx[2] * gz[2]),
        ),
        (
            gy[0] + h * (gy[0] * gx[0] + gy[1] * gy[0] + gy[2] * gz[0]),
            gy[1] + h * (gy[0] * gx[1] + gy[1] * gy[1] + gy[2] * gz[1]),
            gy[2] + h * (gy[0] * gx[2] + gy[1] * gy[2] + gy[2] * gz[2]),
        ),
        (
            gz[0] + h * (gz[0] * gx[0] + gz[1] * gy[0] + gz[2] * gz[0]),
            gz[1] + h * (gz[0] * gx[1] + gz[1] * gy[1] + gz[2] * gz[1]),
            gz[2] + h * (gz[0] * gx[2] + gz[1] * gy[2] + gz[2] * gz[2]),
        ),
    )


@inlined
def strain_rate(L):
    """D = (L + Lᵀ)/2 as (xx, yy, zz, xy, yz, zx)."""
    half = number(0.5, L[0][0])
    return (
        L[0][0],
        L[1][1],
        L[2][2],
        half * (L[0][1] + L[1][0]),
        half * (L[1][2] + L[2][1]),
        half * (L[2][0] + L[0][2]),
    )


@inlined
def rotation(L, dt):
    """Rotation of the step: (I − W Δt/2)⁻¹ (I + W Δt/2), W = (L − Lᵀ)/2, in Cayley's closed form."""
    one, half, quarter = number(1.0, dt), number(0.5, dt), number(0.25, dt)
    a, b, c = half * dt * (L[2][1] - L[1][2]), half * dt * (L[0][2] - L[2][0]), half * dt * (L[1][0] - L[0][1])
    f = one / (one + quarter * (a * a + b * b + c * c))
    h = half * f
    return (
        (one - h * (b * b + c * c), h * a * b - f * c, h * a * c + f * b),
        (h * a * b + f * c, one - h * (a * a + c * c), h * b * c - f * a),
        (h * a * c - f * b, h * b * c + f * a, one - h * (a * a + b * b)),
    )


@inlined
def rotated(r, s):
    """R·s·Rᵀ for a symmetric s."""
    t = (
        (
            r[0][0] * s[0] + r[0][1] * s[3] + r[0][2] * s[5],
            r[0][0] * s[3] + r[0][1] * s[1] + r[0][2] * s[4],
            r[0][0] * s[5] + r[0][1] * s[4] + r[0][2] * s[2],
        ),
        (
            r[1][0] * s[0] + r[1][1] * s[3] + r[1][2] * s[5],
            r[1][0] * s[3] + r[1][1] * s[1] + r[1][2] * s[4],
            r[1][0] * s[5] + r[1][1] * s[4] + r[1][2] * s[2],
        ),
        (
            r[2][0] * s[0] + r[2][1] * s[3] + r[2][2] * s[5],
            r[2][0] * s[3] + r[2][1] * s[1] + r[2][2] * s[4],
            r[2][0] * s[5] + r[2][1] * s[4] + r[2][2] * s[2],
        ),
    )
    return (
        t[0][0] * r[0][0] + t[0][1] * r[0][1] + t[0][2] * r[0][2],
        t[1][0] * r[1][0] + t[1][1] * r[1][1] + t[1][2] * r[1][2],
        t[2][0] * r[2][0] + t[2][1] * r[2][1] + t[2][2] * r[2][2],
        t[0][0] * r[1][0] + t[0][1] * r[1][1] + t[0][2] * r[1][2],
        t[1][0] * r[2][0] + t[1][1] * r[2][1] + t[1][2] * r[2][2],
        t[2][0] * r[0][0] + t[2][1] * r[0][1] + t[2][2] * r[0][2],
    )
