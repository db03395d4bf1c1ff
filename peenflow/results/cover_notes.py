"""What is to be known of the patch's coverage and roughness before their figures are believed."""

import math

from peenflow.geometry import BoltHole
from peenflow.results.coverage import FULL, Shooting
from peenflow.results.evaluation import Evaluation, Peening
from peenflow.results.facts import number
from peenflow.results.roughness import STANDARD_NUMBER, Roughness
from peenflow.results.units import Unit


def notes(peening: Peening, found: Evaluation, length: Unit) -> list[str]:
    """Paragraphs under the figures."""
    told = [sampling(found.roughness, length)]
    if peening.shooting is not None and peening.shooting.travels:
        told.insert(0, passing(peening.shooting))
    if peening.densest:
        told.insert(0, chosen_by_its_hits(peening))
    return told


def passing(shooting: Shooting) -> str:
    """What a pass is."""
    here = "This run is one." if shooting.passes == 1 else f"This run lays {shooting.passes} of them over each other."
    return (
        f"A pass is {number(shooting.duration, 1e3)} ms of shooting from the start of the rod's travel, as simulated. "
        f"{here} With a rod that goes by and then stands still the patch is not hit at one rate throughout, so that "
        f"{100 * FULL:g} % are told in passes and not as a time."
    )


def chosen_by_its_hits(peening: Peening) -> str:
    """That the patch lies where it does because of the very hits it is judged by."""
    count = int(peening.impacts.on_patch.sum())
    told = (
        "The patch was put where this stream's own hits are densest (patch.at = “densest”). Part of that is chance: "
        "another stream leaves fewer dents at the same place, so that this coverage is too high and 98 % seem too near"
    )
    if count:
        told += (
            f". {count} hits scatter by ±{100 / math.sqrt(count):.0f} % by chance, by more where they come in clusters"
        )
    if peening.shooting is None:
        return f"{told}."
    return f"{told}. For a coverage free of the choice run another exposure.seed with patch.at = {_place(peening)}."


def _place(peening: Peening) -> str:
    """The patch's centre as `patch.at` states it."""
    surface, (along, across) = peening.surface, peening.centre()
    if isinstance(surface, BoltHole):
        return f'["{along * 1e3:.4g} mm", "{math.degrees(across / surface.radius):.4g} deg"]'
    return f'["{along * 1e3:.4g} mm", "{across * 1e3:.4g} mm"]'


def sampling(roughness: Roughness, length: Unit) -> str:
    """Over what Ra and Rz are."""
    number_of, each = roughness.sampling_lengths, length.text(roughness.sampling_length)
    told = f"Ra and Rz are means over profiles along axes 1 and 2, each of {number_of} sampling length"
    told += f" of {each}" if number_of == 1 else f"s of {each}"
    if number_of >= STANDARD_NUMBER:
        return f"{told} (ISO 4288)."
    told += f". ISO 4288 asks for {STANDARD_NUMBER} of {length.text(roughness.standard_length)} at this Ra"
    if roughness.sampling_length < roughness.standard_length:
        return f"{told}; the evaluation area is shorter than one of them, so that a gauge would read a larger Rz."
    return f"{told}; the evaluation area holds no more."
