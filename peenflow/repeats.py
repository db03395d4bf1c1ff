"""How often one place is hit: closed forms of the case alone."""

import math

from peenflow.case.model import BoltHoleGeometry, Case

HITS_PER_SHOT = 3.5  # dents of one shot in a hole: ricochets, measured in the deflector's scene
CROWDING = 5.0  # of the densest patch over the mean of the hole's wall, there


def dents_per_place(case: Case, shots: float, given: int, dent_radius: float, reach: float) -> float:
    """Expected dents over one place of the patch, of a single shot's case its hits.

    Args:
        case: a valid case.
        shots: thrown by all nozzles, all shards together.
        given: impacts in the case's table, 0 where there is none.
        dent_radius: predicted [m].
        reach: flight of the shots [m]: over it the nozzles' cones open.
    """
    if case.single_shot:
        return float(case.single_shot.hits)
    dent, patch, geometry = math.pi * dent_radius**2, case.target.patch, case.target.geometry
    if given and patch:
        return given * dent / (patch.length * (patch.width or patch.arc or patch.length))
    if isinstance(geometry, BoltHoleGeometry):
        return shots * HITS_PER_SHOT * CROWDING * dent / (math.pi * geometry.diameter * geometry.length)
    jets = (nozzle.diameter / 2 + reach * math.tan(nozzle.cone / 2) for nozzle in case.nozzle)
    return shots * dent / sum(math.pi * radius**2 for radius in jets)


def repeated_share(case: Case, dents: float) -> float:
    """Share of the dented area that was dented before, of all dents: 1 − (1 − e^(−N))/N for N dents at random.

    Of hits at one point it is (N − 1)/N.
    """
    if case.single_shot:
        return (dents - 1) / dents
    return 1 + math.expm1(-dents) / dents if dents > 0 else 0.0
