"""The files a study leaves: study.csv, study.json, study.svg."""

import csv
import json
from functools import partial
from pathlib import Path

from peenflow.files import write_text_whole, written_whole
from peenflow.results import drawing
from peenflow.study.picture import picture
from peenflow.study.survey import Study, document


def leave(found: Study, out: Path) -> None:
    """Write them into `out`.

    Raises:
        RunError: the disk refuses.
    """
    columns = [each.flat() for each in found.rows]
    with written_whole(out / "study.csv") as partial_file, open(partial_file, "w", newline="") as file:
        writer = csv.DictWriter(file, list(columns[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: "nan" if value is None else value for key, value in row.items()} for row in columns)
    drawing.save(partial(picture, found), out / "study.svg")
    write_text_whole(out / "study.json", json.dumps(document(found), indent=1, allow_nan=False) + "\n")
