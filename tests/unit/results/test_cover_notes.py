"""What the page says under coverage and roughness."""

import pytest

from peenflow.results.cover_notes import passing, sampling
from peenflow.results.coverage import Shooting
from peenflow.results.roughness import Roughness
from peenflow.results.units import display

MM = display(("MPa", "mm")).length


@pytest.mark.parametrize(("passes", "said"), [(1, "This run is one."), (4, "This run lays 4 of them")])
def test_a_pass_is_one_run_of_the_stream(passes, said):
    told = passing(Shooting(5e-3, passes, travels=True))
    assert "A pass is 5 ms of shooting" in told
    assert said in told


@pytest.mark.parametrize(
    ("length", "number", "said"),
    [
        (
            0.3e-3,
            1,
            "1 sampling length of 0.300 mm. ISO 4288 asks for 5 of 0.800 mm at this Ra; the evaluation area is",
        ),
        (
            0.8e-3,
            2,
            "2 sampling lengths of 0.800 mm. ISO 4288 asks for 5 of 0.800 mm at this Ra; the evaluation area holds",
        ),
        (0.8e-3, 6, "6 sampling lengths of 0.800 mm (ISO 4288)."),
    ],
)
def test_the_sampling_lengths_are_told_and_what_the_standard_asks_for(length, number, said):
    assert said in sampling(Roughness(1e-6, 5e-6, 1e-6, length, number, 0.8e-3), MM)
