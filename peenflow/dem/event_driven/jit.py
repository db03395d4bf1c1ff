"""The decorators of this package's kernels. No `fastmath`: event times and their order must repeat bit for bit."""

from pathlib import Path

from peenflow.jit import kernels_of

kernel = kernels_of(Path(__file__).parent)
inner = kernels_of(Path(__file__).parent, no_cpython_wrapper=True, no_cfunc_wrapper=True)  # called by kernels alone
