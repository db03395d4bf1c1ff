"""Whether two cases are the same: what a study was made of, and for which cases it counts."""

import hashlib
import json
from pathlib import Path

from peenflow.case.model import Case

WORDS = {"title", "hpc"}  # change no number


def case_hash(case: Case, directory: Path, accuracy: bool) -> str:
    """Of the case, the files it names and, if asked, its [accuracy] (hex).

    Without `accuracy` two cases that differ in how exactly they are to be answered are one.
    """
    content = case.model_dump(mode="json", by_alias=True, exclude=WORDS | (set() if accuracy else {"accuracy"}))
    digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode())
    for named in (case.impacts, case.contacts):
        if named is not None:
            digest.update((directory / named.file).read_bytes())
    return digest.hexdigest()


def sources_hash() -> str:
    """Of the code that all stages run (hex)."""
    from peenflow.pipeline.sources import source_hash  # the pipeline resolves cases, which may ask for a study's choice
    from peenflow.pipeline.stages import STAGES

    parts = [source_hash(stage.package, stage.templates) for stage in STAGES]
    return hashlib.sha256("".join(parts).encode()).hexdigest()
