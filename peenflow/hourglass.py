"""What share of the internal energy hourglass control will hold, before anything is computed; and how much it may."""

from peenflow.dent import predict
from peenflow.records.material import Material
from peenflow.scene import ShotProperties

TOLERABLE = 0.1  # of the internal energy, beyond which the user is told
USUAL = 0.05  # coefficient of hourglass stiffness for which the fit counts stiffness in λ + 2G over pressure

# Fitted to 29 single hits of the stability suite: speeds of 20 to 300 m/s, six materials, (λ + 2G)/p of 30 to 800, a/R
# of 0.2 to 0.9, 2 to 8 elements in a, coefficients of 0.004 to 0.05; each is met within 23 %.
FACTOR, STIFFNESS, SIZE, ELEMENTS = 0.0935, 0.763, 1.53, 1.60
MOST = 0.417  # where elements are so stiff that they no longer hourglass


def share(mesh_size: float, coefficient: float, speed: float, shot: ShotProperties, material: Material) -> float:
    """Hourglass over internal energy of a normal hit with `speed` [m/s] on elements of `mesh_size` [m].

    x/(1 + x/MOST), x = FACTOR·(κ/0.05·(λ + 2G)/p)^0.763·(a/R)^1.53·(h/a)^1.60 with the dent's radius a and pressure p
    in closed form (`dent.predict`).

    Args:
        mesh_size: of the elements under the dent [m].
        coefficient: κ of hourglass stiffness.
        speed: along the normal [m/s].
        shot: rigid.
        material: of the target.
    """
    dent = predict(speed, shot, material)
    stiffness = coefficient / USUAL * material.p_modulus / dent.pressure
    flat = dent.radius / (0.5 * shot.diameter)
    x = FACTOR * stiffness**STIFFNESS * flat**SIZE * (mesh_size / dent.radius) ** ELEMENTS
    return x / (1 + x / MOST)


def told(held: float, mesh_size: str) -> list[str]:
    """What to tell of a run in which hourglass control held that share: a sentence, or none.

    Args:
        held: share of the internal energy at the end of the impacts.
        mesh_size: the key in the case that sets the elements' size.
    """
    if held <= TOLERABLE:
        return []
    return [
        f"Hourglass control holds {100 * held:.2g} % of the internal energy, more than {100 * TOLERABLE:.2g} %: the "
        f"mesh is coarse for these dents. Lower {mesh_size} (the share goes with the power {ELEMENTS:.2g} of it)."
    ]
