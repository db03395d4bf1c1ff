"""Which settings nothing beats in both error and time."""

from collections.abc import Sequence


def front(errors: Sequence[float], costs: Sequence[float]) -> list[int]:
    """Indices of the points that no other beats in error without costing more, by rising cost.

    Of points that are equal in both, the first stands for all.
    """
    order = sorted(range(len(errors)), key=lambda i: (costs[i], errors[i], i))
    found: list[int] = []
    for index in order:
        if not found or errors[index] < errors[found[-1]]:
            found.append(index)
    return found
