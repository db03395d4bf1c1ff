"""The reference data of tests/reference, as columns and named figures."""

import csv
from pathlib import Path

import numpy as np

REFERENCE = Path(__file__).parents[1] / "reference"


def columns(path):
    """The columns (k,) of a CSV file by name; a path without a root is taken from tests/reference."""
    with open(REFERENCE / path) as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def figures(path):
    """The figures of a file `quantity,value`."""
    with open(REFERENCE / path) as file:
        return {row["quantity"]: float(row["value"]) for row in csv.DictReader(file)}


def rms(difference):
    return float(np.sqrt(np.mean(np.square(difference))))
