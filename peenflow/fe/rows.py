"""Nodes in a row, read and written as vectors: what LLVM does not find by itself in so short a loop.

A row of nodes is x y z x y z … in memory and x x … y y … z z … in a gathered field. From one to the other is a load,
three shuffles and three stores of whole vectors, here spelled out in LLVM's own instructions (numba's `intrinsic`).
What each does stands in its docstring as a loop.
"""

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

LANES = 16


def _vector(context: Any, builder: Any, array: tuple[Any, Any], start: Any, count: int) -> tuple[Any, int]:
    """`count` numbers of a contiguous array (its value and type) from number `start` on: pointer and alignment."""
    value, kind = array
    data = context.make_array(kind)(context, builder, value).data
    whole = ir.VectorType(context.get_value_type(kind.dtype), count)
    return builder.bitcast(builder.gep(data, [start]), whole.as_pointer()), kind.dtype.bitwidth // 8


def _picked(builder: Any, first: Any, second: Any, numbers: list[int]) -> Any:
    """Those numbers of two vectors laid end to end."""
    return builder.shuffle_vector(first, second, ir.Constant(ir.VectorType(ir.IntType(32), len(numbers)), numbers))


@intrinsic
def read_row(typing: Any, flat: Any, start: Any, out: Any, at: Any) -> Any:
    """out[at + 8·LANES·c + j] ← flat[start + 3 j + c], c < 3, j < LANES."""
    del typing, start, at

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        source, first, target, to = arguments
        place, size = _vector(context, builder, (source, signature.args[0]), first, 3 * LANES)
        row = builder.load(place, align=size)
        for c in range(3):
            to_c = builder.add(to, ir.Constant(to.type, 8 * LANES * c))
            place, size = _vector(context, builder, (target, signature.args[2]), to_c, LANES)
            component = _picked(builder, row, row, [3 * j + c for j in range(LANES)])
            builder.store(component, place, align=size)
        return context.get_dummy_value()

    return types.void(flat, types.int64, out, types.int64), code


@intrinsic
def subtract_row(typing: Any, out: Any, at: Any, flat: Any, start: Any) -> Any:
    """flat[start + 3 j + c] −= out[at + 8·LANES·c + j], c < 3, j < LANES."""
    del typing, at, start

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        source, of, target, first = arguments
        components = []
        for c in range(3):
            of_c = builder.add(of, ir.Constant(of.type, 8 * LANES * c))
            place, size = _vector(context, builder, (source, signature.args[0]), of_c, LANES)
            components.append(builder.load(place, align=size))
        every = list(range(2 * LANES))
        x, y, z = components
        xy, zz = _picked(builder, x, y, every), _picked(builder, z, z, every)
        row = _picked(builder, xy, zz, [j + c * LANES for j in range(LANES) for c in range(3)])
        place, size = _vector(context, builder, (target, signature.args[2]), first, 3 * LANES)
        builder.store(builder.fsub(builder.load(place, align=size), row), place, align=size)
        return context.get_dummy_value()

    return types.void(out, types.int64, flat, types.int64), code
