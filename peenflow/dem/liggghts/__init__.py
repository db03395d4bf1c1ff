"""LIGGGHTS as the engine: deck, process, log, dump, and what its dump needs undone."""

from peenflow.dem.liggghts.engine import Liggghts

__all__ = ["Liggghts"]
