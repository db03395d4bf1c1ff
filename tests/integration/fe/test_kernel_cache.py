"""Kernels just compiled and kernels from the cache give the same bits (with LLVM's `reassoc` they did not)."""

import os
import subprocess
import sys

import pytest

RUN = """
import hashlib
import numpy as np
from peenflow.calibrate.unit_cell import Numerics, Shot, cell_deck, quarter_cell
from peenflow.fe.solver import Solver
from peenflow.records.material import Material, RateHardening
metal = Material("m", 8200.0, 211e9, 0.29, 1241e6, 622e6, 0.6522, RateHardening(0.0134, 1.0), None)
shot, numerics = Shot(0.3556e-3, 7800.0, 0.3), Numerics(40e-6, 61e-6, 0.8, 1e-3, True)
solver = Solver(cell_deck(quarter_cell(shot, numerics), shot, np.array([0, 0, -62.5]), metal, numerics), 2)
for _ in range(5):
    solver.bundle()
print(hashlib.sha256(solver.state.u.tobytes() + solver.state.deviator.tobytes()).hexdigest())
"""


@pytest.mark.long
def test_compiling_and_loading_give_the_same_bits(tmp_path):
    environment = os.environ | {"XDG_CACHE_HOME": str(tmp_path), "NUMBA_NUM_THREADS": "2"}
    runs = [
        subprocess.run([sys.executable, "-c", RUN], env=environment, capture_output=True, text=True, check=True).stdout
        for _ in range(2)
    ]
    assert len(list((tmp_path / "peenflow" / "kernels").rglob("*.nbc"))) > 5  # the second run had a cache to load
    assert runs[0] == runs[1]
