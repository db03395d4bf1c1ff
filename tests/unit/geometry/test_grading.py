import numpy as np
import pytest

from peenflow.geometry.grading import layers


@pytest.mark.parametrize("depth", [0.2, 0.21, 0.23, 0.3, 0.75, 1.6, 5.0])
def test_sums_to_the_depth_and_never_grows_faster_than_asked(depth: float) -> None:
    found = layers(0.01, 0.18, depth, 1.25)
    assert found.sum() == pytest.approx(depth, rel=1e-12)
    ratio = found[1:] / found[:-1]
    assert ratio.max() <= 1.25 * (1 + 1e-9)
    assert ratio.min() >= 1 - 1e-9
    assert found[0] <= 0.01 * (1 + 1e-9)


def test_is_uniform_down_to_the_fine_depth_rounded_up() -> None:
    found = layers(0.01, 0.175, 0.75, 1.25)
    assert np.allclose(found[:18], 0.01, rtol=1e-9)
    assert found[18] > 0.011
    assert np.allclose(found[19:] / found[18:-1], found[18] / 0.01)


def test_uses_as_few_layers_as_the_growth_allows() -> None:
    count = len(layers(0.01, 0.18, 0.75, 1.25)) - 18
    assert 0.01 * np.sum(1.25 ** np.arange(1, count)) < 0.75 - 0.18 <= 0.01 * np.sum(1.25 ** np.arange(1, count + 1))


def test_a_patch_as_deep_as_its_fine_zone_has_equal_layers() -> None:
    assert np.allclose(layers(0.01, 0.3, 0.12, 1.25), 0.01)
    assert len(layers(0.01, 0.3, 0.125, 1.25)) == 13


@pytest.mark.parametrize("wrong", [(0, 1, 1, 1.2), (0.1, -1, 1, 1.2), (0.1, 1, 0, 1.2), (0.1, 1, 1, 1.0)])
def test_refuses_what_makes_no_layers(wrong: tuple[float, float, float, float]) -> None:
    with pytest.raises(ValueError, match="no layers"):
        layers(*wrong)
