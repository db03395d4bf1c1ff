from typing import Any

import pytest

from peenflow.errors import InputError
from peenflow.jobs import Allocation, shortfalls

STAGES: list[dict[str, Any]] = [
    {"stage": "mesh", "predicted_wall_s": 60.0, "predicted_memory_B": 3 << 30},
    {"stage": "solve", "predicted_wall_s": 86400.0, "predicted_memory_B": 9 << 30},
]


def test_what_is_asked_below_the_prediction_is_told_with_what_to_ask():
    time, memory = shortfalls(Allocation(time="00:01:00", memory="8 GB"), STAGES)
    assert "asks for 00:01:00 and is predicted to take 1-00:01:00: ask for --time 1-12:02:00" in time
    assert "asks for 8192 MB of memory and is predicted to need 9216 MB: ask for --memory 14GB" in memory


def test_what_it_says_to_ask_for_is_enough():
    assert shortfalls(Allocation(time="1-12:02:00", memory="14GB"), STAGES) == []


def test_what_is_left_to_the_site_is_not_judged():
    assert shortfalls(Allocation(), STAGES) == []


@pytest.mark.parametrize("wrong", [Allocation(time="soon"), Allocation(memory="8")])
def test_what_cannot_be_read_is_wrong_input(wrong: Allocation):
    with pytest.raises(InputError, match="hpc"):
        shortfalls(wrong, STAGES)
