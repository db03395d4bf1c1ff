"""The guide's tables of keys against the model: all of them, none else, with the unit each takes."""

import re
import typing
from pathlib import Path

import pytest
from pydantic import BaseModel, BeforeValidator

from peenflow.case import model
from peenflow.cli import app

GUIDE = Path(__file__).parents[2] / "docs" / "guide"
SECTIONS: dict[str, tuple[type[BaseModel], ...]] = {
    "case": (model.Case,),
    "shot": (model.Shot,),
    "shot.size_spread": (model.SizeSpread,),
    "shot.constants": (model.Constants,),
    "target": (model.TargetSection,),
    "target.geometry": (model.PlateGeometry, model.BoltHoleGeometry, model.FilletGeometry, model.StepGeometry),
    "target.patch": (model.PatchSize,),
    "target.johnson_cook": (model.JohnsonCookConstants,),
    "target.kinematic_hardening": (model.KinematicHardeningConstants,),
    "nozzle": (model.Nozzle,),
    "nozzle.speed_spread": (model.SpeedSpread,),
    "deflector": (model.Deflector,),
    "deflector.travel": (model.Travel,),
    "dem": (model.Dem,),
    "air": (model.AirSection,),
    "exposure": (model.Exposure,),
    "impacts": (model.ImpactsFile,),
    "impacts.columns": (model.ImpactColumns,),
    "contacts": (model.ContactsFile,),
    "contacts.columns": (model.ContactColumns,),
    "single_shot": (model.SingleShot,),
    "accuracy": (model.Accuracy,),
    "effects": (model.Effects,),
    "report": (model.Report,),
    "hpc": (model.Hpc,),
}
DIMENSIONS = {"Length": "m", "Speed": "m/s", "Duration": "s", "Rate": "1/s", "MassRate": "kg/s", "Angle": "rad"}
DIMENSIONS |= {"Pressure": "Pa", "Density": "kg/m^3", "Temperature": "K", "HeatCapacity": "J/(kg K)", "Share": "%"}
DIMENSIONS |= {"Viscosity": "Pa s"}
UNITS = {typing.get_args(getattr(model.units, name))[1]: unit for name, unit in DIMENSIONS.items()}


def rows(section: str) -> dict[str, str]:
    """Key → unit, of the section's table."""
    text = (GUIDE / "getting-started.md").read_text()
    body = text.split(f"\n## {section}\n")[1].split("\n## ")[0]
    return dict(re.findall(r"^\| `(\w+)` \| ([^|]*?) ?\|", body, re.MULTILINE))


def unit(annotation: object, metadata: typing.Iterable[object] = ()) -> str | None:
    """The SI unit a field reads, None for a plain value."""
    for mark in metadata:
        if isinstance(mark, BeforeValidator) and mark in UNITS:
            return UNITS[mark]
    for inner in typing.get_args(annotation):
        found = unit(inner, getattr(inner, "__metadata__", ()))
        if found:
            return found
    return None


def test_every_table_of_the_case_has_its_section():
    tables = {each for each in vars(model).values() if isinstance(each, type) and issubclass(each, model.Section)}
    assert tables - {model.Section} == {each for several in SECTIONS.values() for each in several}
    assert [*SECTIONS] == re.findall(r"^## (\S+)$", (GUIDE / "getting-started.md").read_text(), re.MULTILINE)


@pytest.mark.parametrize("section", SECTIONS)
def test_a_section_has_every_key_with_its_unit(section):
    said = rows(section)
    fields = {field.alias or key: field for each in SECTIONS[section] for key, field in each.model_fields.items()}
    assert set(said) == set(fields)
    for key, field in fields.items():
        expected = unit(field.annotation, field.metadata)
        if expected:
            assert said[key] == expected, key
        elif key != "at":  # text, read as one or the other when the part is known
            assert said[key] in ("–", ""), key


def test_guides_name_only_commands_there_are():
    commands = {command.callback.__name__ for command in app.registered_commands}
    for page in (*GUIDE.glob("*.md"), GUIDE.parents[1] / "README.md"):
        code = re.findall(r"```.*?```|`[^`]+`", page.read_text(), re.DOTALL)
        named = {verb for piece in code for verb in re.findall(r"(?:^|`)peenflow ([a-z]+)", piece, re.MULTILINE)}
        assert named, page.name
        assert named <= commands, page.name
