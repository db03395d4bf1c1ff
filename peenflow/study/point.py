"""One setting of a study: which knob, what value, and how the case is told."""

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

Kind = Literal["base", "reference", "knob", "stream", "unsure"]
"""`stream`: a knob whose every value throws another stream, as another seed does: chance, not only accuracy."""


@dataclass(frozen=True, eq=False)
class Point:
    """A full run of the pipeline with its own settings."""

    knob: str  # "base", "reference", a knob of [accuracy], or what is not known well
    value: str  # as a person reads it
    settings: Mapping[str, str]  # key of the case file → value, over the case's own; "": without it
    kind: Kind

    @property
    def name(self) -> str:
        """Of the point, and of its directory."""
        plain = re.sub(r"[^\w.]+", "-", self.value)
        return self.knob if self.kind in ("base", "reference") else f"{self.knob}-{plain}"

    @property
    def overrides(self) -> list[str]:
        """As `--set` takes them."""
        return [f"{key}={value}" for key, value in self.settings.items()]

    def fingerprint(self, case_hash: str, sources: str) -> str:
        """Of all that its result depends on (hex)."""
        content = json.dumps([case_hash, sources, dict(self.settings)], sort_keys=True)
        return hashlib.sha256(content.encode()).hexdigest()
