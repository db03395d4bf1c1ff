"""The table of the stages names all that they leave."""

import re
from pathlib import Path

import peenflow
from peenflow.pipeline.stages import TABLES


def test_every_table_of_the_report_is_named():
    """One that is not would be neither checked nor removed."""
    sources = (Path(peenflow.__file__).parent / "results").glob("*.py")
    written = {name for path in sources for name in re.findall(r'write_csv\(workdir / "([^"]+)"', path.read_text())}
    assert written == set(TABLES)
