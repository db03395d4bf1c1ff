"""Off costs nothing: the kernel with an effect switched off beside one from whose source the effect was removed."""

import ast
import inspect
import textwrap
import time

import numba
import numpy as np
import pytest

from peenflow.fe import internal_forces
from peenflow.fe.internal_forces import STRAIN_RATE, TRIAL, WORK_ROWS, radial_return
from peenflow.fe.johnson_cook import Law, Rate, Thermal
from peenflow.fe.rows import LANES

LAW = Law(8200.0, 82e9, 167e9, 5800.0, 1241e6, 622e6, 0.6522)
RATE, THERMAL = Rate(0.0134, 1.0), Thermal(1.3, 293.15, 1570.0, 0.9 / (8200 * 435))
SWEEPS, ROUNDS = 200, 600  # short ones and many: the quickest of them ran undisturbed
NOISE = 0.05  # of the quickest of the rounds


class Without(ast.NodeTransformer):
    """The source without the parameters `names`, the branches that ask for them, and the factor of the rate."""

    def __init__(self, *names: str) -> None:
        self.names = names

    def visit_FunctionDef(self, node):
        node.args.args = [argument for argument in node.args.args if argument.arg not in self.names]
        node.decorator_list = []
        return self.generic_visit(node)

    def visit_IfExp(self, node):
        return self.visit(node.body) if self._asks(node.test) else self.generic_visit(node)

    def visit_If(self, node):
        return None if self._asks(node.test) else self.generic_visit(node)

    def visit_BinOp(self, node):
        is_rate = isinstance(node.right, ast.Call) and ast.unparse(node.right.func) == "rate_factor"
        return self.visit(node.left) if is_rate and "rate" in self.names else self.generic_visit(node)

    def _asks(self, test):
        return isinstance(test, ast.Compare) and isinstance(test.left, ast.Name) and test.left.id in self.names


def without(*names):
    """`radial_return` compiled anew, from its source without the effects `names`: all in the same way."""
    function = radial_return.py_func
    tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
    stripped = ast.unparse(ast.fix_missing_locations(Without(*names).visit(tree)))
    assert not any(name in stripped.split("):", 1)[0] for name in names)
    scope = dict(vars(internal_forces))
    exec(compile(stripped, "radial_return", "exec"), scope)
    return numba.njit(error_model="numpy", fastmath=radial_return.targetoptions["fastmath"])(scope["radial_return"])


def swept(kernel, constants):
    """A call that returns how long `SWEEPS` blocks take [s], all lanes yielding."""
    count = SWEEPS

    @numba.njit
    def sweeps(work, template, peeq, temperature, law, rest):
        for _ in range(count):
            work[:] = template
            peeq[:] = 0.01
            temperature[:] = 300.0
            kernel(work, peeq, temperature, law, *rest)

    template = np.zeros(WORK_ROWS * LANES)
    template[TRIAL * LANES : (TRIAL + 1) * LANES] = np.linspace(1.6e9, 2.0e9, LANES)
    template[STRAIN_RATE * LANES : (STRAIN_RATE + 1) * LANES] = 1e5
    work, peeq, temperature = np.empty_like(template), np.empty(LANES), np.empty(LANES)

    def timed():
        start = time.perf_counter()
        sweeps(work, template, peeq, temperature, LAW, constants)
        return time.perf_counter() - start

    timed()
    return timed


@pytest.mark.parametrize(
    ("off", "constants", "rest"),
    [
        (("rate",), (None, THERMAL), (THERMAL,)),
        (("thermal",), (RATE, None), (RATE,)),
        (("rate", "thermal"), (None, None), ()),
    ],
)
def bench_an_effect_off_is_an_effect_removed(benchmark, off, constants, rest):
    switched, removed = swept(without(), constants), swept(without(*off), rest)
    times = []

    def both():  # in turns, so that both see the same machine
        times.append((switched(), removed()))

    benchmark.pedantic(both, rounds=ROUNDS)
    quickest = np.min(times, axis=0)
    benchmark.extra_info["off_over_removed"] = float(quickest[0] / quickest[1])
    assert quickest[0] == pytest.approx(quickest[1], rel=NOISE)


def bench_an_effect_on_costs(benchmark):
    """What switching both on costs the return, for comparison."""
    off, on = swept(radial_return, (None, None)), swept(radial_return, (RATE, THERMAL))
    times = []
    benchmark.pedantic(lambda: times.append((off(), on())), rounds=ROUNDS)
    benchmark.extra_info["on_over_off"] = float(np.divide(*np.min(times, axis=0)[::-1]))
