from itertools import pairwise

import pytest
from matplotlib.figure import Figure

from peenflow.results.drawing import LABEL_HEIGHT, mark


@pytest.mark.parametrize("stress", [(-157, -158, 0), (-794, -926, 0), (0, 0, 0)])
def test_labels_of_figures_stand_apart_each_below_its_point(stress):
    axes = Figure().subplots()
    axes.set_ylim(-1600, 300)
    mark(axes, [((0.01 * i, y), f"{y} MPa") for i, y in enumerate(stress)])
    places = sorted(text.xyann[1] for text in axes.texts)
    assert len(places) == len(axes.lines) == 3
    assert min(above - below for below, above in pairwise(places)) > 0.99 * LABEL_HEIGHT
    for text in axes.texts:
        assert text.xyann[1] < (text.xy[1] + 1600) / 1900
