"""Finer results of the hard scenes, into tests/reference/stability.

usage: python tests/support/hard_scenes/record.py [GROUP…]
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))  # as pytest's `pythonpath` does for the tests

from hard_scenes.catalogue import GROUPS
from hard_scenes.holding import FINER
from hard_scenes.run import run
from hard_scenes.scene import finer


def record(group, only=()):
    """Run a group's scenes on finer meshes; what stands in the file for others is kept."""
    path = FINER / f"{group}.json"
    kept = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    kept = {name: kept[name] for name in GROUPS[group] if name in kept}
    for name, scene in GROUPS[group].items():
        if only and name not in only:
            continue
        found = run(finer(scene))
        print(f"{group}: {name}: {len(found.peeq)} elements, {found.seconds:.0f} s", flush=True)
        kept[name] = {
            "elements": len(found.peeq),
            "figures": {figure: float(f"{value:.5g}") for figure, value in found.figures.items()},
            "depth_m": [float(f"{value:.4g}") for value in found.depth],
            "stress_Pa": [float(f"{value:.4g}") for value in found.stress],
        }
        ordered = {name: kept[name] for name in GROUPS[group] if name in kept}
        FINER.mkdir(exist_ok=True)
        path.write_text(json.dumps(ordered, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    asked = sys.argv[1:]
    for group in [word for word in asked if word in GROUPS] or GROUPS:
        record(group, [word for word in asked if word not in GROUPS])
