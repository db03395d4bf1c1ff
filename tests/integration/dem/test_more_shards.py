"""Another number of shards runs only the shards that are missing."""

import io

from rich.console import Console as Terminal

from peenflow.console import Console
from peenflow.dem import stage as dem
from peenflow.pipeline.clean import clean
from peenflow.pipeline.execute import settle
from peenflow.pipeline.freshness import assess
from peenflow.pipeline.stages import stage
from peenflow.scene import EngineChoice

LIGGGHTS = EngineChoice("liggghts", "the test says so", False)


def test_more_shards_keep_the_first_and_fewer_take_no_others(plate_stream, tmp_path):
    log = io.StringIO()
    console = Console(Terminal(file=io.StringIO()), log)

    def shots(shards: int) -> int:
        settle(assess(stage("dem"), dem.Inputs(plate_stream(), shards, LIGGGHTS), tmp_path), tmp_path, console)
        return dem.load(tmp_path).shots

    assert shots(1) == 1
    first = tmp_path / "dem" / "shard-000" / "contacts.h5"
    made = first.stat().st_mtime_ns
    assert shots(3) == 3
    assert first.stat().st_mtime_ns == made
    assert "1 of 3 shards were finished before and are kept" in log.getvalue()
    assert shots(2) == 2
    assert (tmp_path / "dem" / "shard-002").exists()
    settle(assess(stage("dem"), dem.Inputs(plate_stream(seed=2), 1, LIGGGHTS), tmp_path), tmp_path, console)
    assert first.stat().st_mtime_ns > made
    clean(tmp_path)
    assert not (tmp_path / "dem").exists()
