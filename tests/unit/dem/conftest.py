from collections.abc import Callable

import pytest
import streams

from peenflow.dem.engine import Stream


@pytest.fixture
def hole_stream() -> Callable[..., Stream]:
    """The paper's scene; keywords replace fields of the stream."""
    return streams.hole_stream
