"""The command line as a user meets it: exit status, standard output and error, files."""

import json
import os
import re
import signal
import subprocess
import sys
import time
import typing
from pathlib import Path

import pytest
from command_line import ROOT, command, one_paragraph, peenflow

from peenflow.cli import app

PLATE = ROOT / "cases" / "plate"
COARSE = ("--set", "accuracy.mesh_size=0.1 mm", "--set", "target.patch.length=0.5 mm")


def mesh(out: Path, *more: str) -> subprocess.CompletedProcess[str]:
    return peenflow("run", PLATE, "--out", out, "--until", "mesh", *COARSE, *more)


def said(ended: subprocess.CompletedProcess[str]) -> str:
    """Standard error without the note of a measurement, which comes when it is due."""
    lines = ended.stderr.splitlines(keepends=True)
    return "".join(line for line in lines if not line.startswith("measuring this machine's speed"))


def test_a_stage_runs_once_and_status_says_so(tmp_path: Path):
    first = mesh(tmp_path)
    assert (first.returncode, said(first).splitlines()[0]) == (0, "mesh: started, first run")
    again = mesh(tmp_path)
    assert (again.returncode, said(again)) == (0, "mesh: up to date\n")
    told = peenflow("status", PLATE, "--out", tmp_path, *COARSE)
    assert told.returncode == 0
    assert told.stdout.splitlines()[1].split()[:2] == ["mesh", "done"]
    assert "mesh: done" in (tmp_path / "log.txt").read_text()
    assert json.loads((tmp_path / "case_effective.json").read_text())["knobs"]["mesh_size"] == 1e-4


def test_status_names_what_changed(tmp_path: Path):
    mesh(tmp_path)
    told = peenflow("status", PLATE, "--out", tmp_path, *COARSE, "--set", "accuracy.mesh_size=0.05 mm")
    assert "mesh       stale    mesh_size changed from 0.0001 to 5e-05" in told.stdout
    assert "dem        not run  mesh comes first" in told.stdout


def test_a_truncated_result_is_made_again(tmp_path: Path):
    mesh(tmp_path)
    (tmp_path / "target.h5").write_bytes((tmp_path / "target.h5").read_bytes()[:64])
    again = mesh(tmp_path)
    assert again.returncode == 0
    assert "mesh: started, target.h5 has 64 bytes instead of" in again.stderr


def test_from_runs_a_stage_that_is_up_to_date(tmp_path: Path):
    mesh(tmp_path)
    assert "mesh: started, asked for" in mesh(tmp_path, "--from", "mesh").stderr


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("run", PLATE, "--from", "nope"), "There is no stage 'nope'"),
        (("run", PLATE, "--set", "shot.diametre=1 mm"), "diameter"),
        (("run", PLATE, "--set", "accuracy.mesh_size=0.1"), "has no unit"),
        (("check", "nowhere"), "nowhere/case.toml does not exist"),
        (("solve", "nowhere"), "nowhere"),
        (("submit", PLATE, "--scheduler", "slurm", "--time", "soon"), "[hpc] time"),
        (("init", PLATE), "is there already"),
        (("init", "new", "--like", "nothing"), "bolt-hole"),
        (("clean", "nowhere"), "holds no results"),
        (("report", PLATE), "mesh is not run"),
    ],
)
def test_wrong_input_is_one_paragraph_and_2(arguments: tuple[object, ...], said: str, tmp_path: Path):
    out = () if arguments[0] in ("check", "init") else ("--out", tmp_path)
    ended = peenflow(*arguments, *out)
    assert ended.returncode == 2, ended.stderr
    assert one_paragraph(ended.stderr), ended.stderr
    assert said in ended.stderr
    assert ended.stdout == ""


@pytest.mark.parametrize("arguments", [("run",), ("run", PLATE, "--nope"), ("submit", PLATE), ("nope",)])
def test_usage_errors_are_2(arguments: tuple[object, ...]):
    ended = peenflow(*arguments)
    assert ended.returncode == 2
    assert "Traceback" not in ended.stderr


@pytest.mark.parametrize("place", [("--debug", "check", "nowhere"), ("check", "nowhere", "--debug")])
def test_debug_shows_the_traceback_wherever_it_stands(place: tuple[str, ...]):
    ended = peenflow(*place)
    assert ended.returncode == 2
    assert "Traceback" in ended.stderr


COMMANDS = [command.callback.__name__ for command in app.registered_commands if command.callback]


@pytest.mark.parametrize("name", COMMANDS)
def test_help_shows_what_stands_in_brackets(name: str):
    """A markup that takes them for its own would leave out defaults and names of tables."""
    callback = next(c.callback for c in app.registered_commands if c.callback and c.callback.__name__ == name)
    texts = [callback.__doc__ or ""]
    for annotation in typing.get_type_hints(callback, include_extras=True).values():
        texts += [part.help or "" for part in getattr(annotation, "__metadata__", ())]
    shown = peenflow(name, "--help").stdout
    for text in texts:
        for word in re.findall(r"\[[^\]]*\]", text):
            assert word in " ".join(shown.split()), shown


def test_help_and_version():
    assert "Run what is not up to date" in peenflow("--help").stdout
    assert peenflow("--version").stdout.startswith("peenflow ")


def test_check_prints_one_json_document_and_writes_nothing(tmp_path: Path):
    peenflow("init", tmp_path / "case", "--like", "patch")
    before = sorted(tmp_path.rglob("*"))
    found = json.loads(peenflow("check", tmp_path / "case", "--json").stdout)
    assert {"effects", "stages", "fe", "dem", "warnings"} <= found.keys()
    assert sorted(tmp_path.rglob("*")) == before


def test_check_lists_every_effect_with_its_numbers():
    """The bolt hole: gravity and drag are nothing there; over 2 m light glass loses most of its speed."""
    found = json.loads(peenflow("check", "cases/bolt-hole", "--json").stdout)
    effects = found["effects"]
    assert len(effects) == 13
    assert all(made.keys() == {"state", "estimate", "threshold", "why", "cost"} for made in effects.values())
    assert all(0 <= made["estimate"] <= 1 for name, made in effects.items() if not name.endswith("_spread"))
    assert [effects[name]["state"] for name in ("gravity", "air_drag")] == ["auto: off"] * 2
    assert [effects[name]["state"] for name in ("deflector_motion", "shot_collisions")] == ["auto: on"] * 2
    assert {"shot_elasticity", "shot_yielding", "carrier_air"} <= found["not_modelled"].keys()
    far = [f"nozzle.0.position={['0 mm', '0 mm', '2 m']}", "shot.diameter=0.2 mm", "shot.material=glass"]
    glass = json.loads(peenflow("check", PLATE, "--json", *(part for s in far for part in ("--set", s))).stdout)
    assert glass["effects"]["air_drag"]["state"] == "auto: on"
    assert glass["effects"]["air_drag"]["estimate"] > 0.5


def test_init_makes_a_case_that_passes_check(tmp_path: Path):
    made = peenflow("init", tmp_path / "new")
    assert made.returncode == 0
    checked = peenflow("check", tmp_path / "new")
    assert checked.returncode == 0, checked.stderr
    assert "rate_hardening" in checked.stdout


def test_a_second_run_is_refused_and_told_the_first(tmp_path: Path):
    hold = "import sys; from pathlib import Path; from peenflow.pipeline.lock import locked\n"
    hold += "with locked(Path(sys.argv[1])): print('held', flush=True); sys.stdin.read()"
    arguments = [sys.executable, "-c", hold, str(tmp_path)]
    with subprocess.Popen(arguments, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=ROOT) as first:
        assert first.stdout is not None
        assert first.stdout.readline() == "held\n"
        refused = mesh(tmp_path)
        first.kill()
    assert refused.returncode == 1
    assert one_paragraph(said(refused))
    assert f"process {first.pid}" in refused.stderr
    assert mesh(tmp_path).returncode == 0


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_stopped_run_goes_on(tmp_path: Path, number: signal.Signals, status: int):
    """A mesh fine enough to take a second is stopped while it is made."""
    slow = ("--set", "accuracy.mesh_size=0.01 mm")
    arguments = command("run", PLATE, "--out", tmp_path, "--until", "mesh", *slow)
    with subprocess.Popen(arguments, stderr=subprocess.PIPE, text=True, cwd=ROOT) as process:
        assert process.stderr is not None
        assert any(line.startswith("mesh: started") for line in iter(process.stderr.readline, ""))
        process.send_signal(number)
        _, said = process.communicate(timeout=60)
    assert process.returncode == status, said
    assert said.splitlines()[-1].startswith("Error: Stopped by")
    told = peenflow("status", PLATE, "--out", tmp_path, *slow)
    assert told.stdout.splitlines()[1].split()[:2] == ["mesh", "failed"]
    assert "mesh: started, did not finish: stopped by" in mesh_again(tmp_path, slow).stderr


def mesh_again(out: Path, settings: tuple[str, ...]) -> subprocess.CompletedProcess[str]:
    return peenflow("run", PLATE, "--out", out, "--until", "mesh", *settings)


def test_results_of_another_case_are_refused_and_untouched(tmp_path: Path):
    mesh(tmp_path / "out")
    peenflow("init", tmp_path / "new")
    before = (tmp_path / "out" / "target.h5").read_bytes()
    out = ("--out", tmp_path / "out")
    submit = ("submit", tmp_path / "new", "--scheduler", "slurm", "--dry-run")
    for asked in (("run", tmp_path / "new", "--until", "mesh"), ("status", tmp_path / "new"), submit):
        refused = peenflow(*asked, *out)
        assert refused.returncode == 2, asked
        assert one_paragraph(said(refused))
        assert f"another case, {PLATE}" in refused.stderr
    assert (tmp_path / "out" / "target.h5").read_bytes() == before
    assert said(mesh(tmp_path / "out")) == "mesh: up to date\n"
    assert peenflow("clean", PLATE, *out).returncode == 0
    assert peenflow("run", tmp_path / "new", "--until", "mesh", *COARSE, *out).returncode == 0


def test_clean_removes_results_and_nothing_else(tmp_path: Path):
    mesh(tmp_path / "out")
    (tmp_path / "out" / "mine.txt").write_text("")
    assert peenflow("clean", PLATE, "--out", tmp_path / "out").returncode == 0
    assert [p.name for p in (tmp_path / "out").iterdir()] == ["mine.txt"]


def test_submit_shows_a_script_that_runs_the_case(tmp_path: Path):
    out = tmp_path / "re sults"
    shown = peenflow("submit", PLATE, "--scheduler", "slurm", "--out", out, "--dry-run", *COARSE, "--cpus", "3")
    assert shown.returncode == 0
    script = (out / "jobs" / "slurm.sh").read_text()
    assert script in shown.stdout
    assert "#SBATCH --cpus-per-task=3\n" in script
    again = (
        f"-m peenflow run {PLATE} --out '{out}' --set 'accuracy.mesh_size=0.1 mm' --set 'target.patch.length=0.5 mm'"
    )
    assert script.endswith(f"{again}\n")


def test_submit_writes_no_script_of_a_case_that_check_refuses(tmp_path: Path):
    endless = ("--set", "accuracy.mesh_size=0.01 um")
    checked = peenflow("check", PLATE, *endless)
    refused = peenflow("submit", PLATE, "--scheduler", "slurm", "--out", tmp_path / "out", "--dry-run", *endless)
    assert (refused.returncode, refused.stderr) == (2, checked.stderr)
    assert not (tmp_path / "out").exists()


def test_submit_warns_of_less_than_is_predicted(tmp_path: Path):
    asked = ("--time", "00:00:01", "--memory", "1 MB")
    shown = peenflow("submit", PLATE, "--scheduler", "slurm", "--out", tmp_path, "--dry-run", *COARSE, *asked)
    assert shown.returncode == 0
    warnings = [line for line in shown.stderr.splitlines() if line.startswith("Warning: the job asks for")]
    assert ["--time" in line for line in warnings] == [True, False]
    assert ["--memory" in line for line in warnings] == [False, True]
    enough = ("--time", "1-00:00:00", "--memory", "4 GB")
    shown = peenflow("submit", PLATE, "--scheduler", "slurm", "--out", tmp_path, "--dry-run", *COARSE, *enough)
    assert "the job asks" not in shown.stderr


def test_check_warns_of_what_this_machine_cannot_bear():
    huge = ("--set", "accuracy.mesh_size=0.5 um", "--set", "exposure.duration=10 s")
    warnings = json.loads(peenflow("check", PLATE, "--json", *huge).stdout)["warnings"]
    assert any("GB of memory, and this machine has" in warning for warning in warnings)
    assert any("predicted to take" in warning and "days" in warning for warning in warnings)


def test_submit_without_the_scheduler_is_wrong_input(tmp_path: Path):
    ended = peenflow("submit", PLATE, "--scheduler", "pbs", "--out", tmp_path, PATH="/nowhere")
    assert ended.returncode == 2
    assert "qsub is not on this machine" in ended.stderr


def test_a_reader_that_goes_away_is_no_internal_error():
    piped = f"{sys.executable} -m peenflow check {PLATE} --json | head -c 1"
    ended = subprocess.run(["bash", "-c", piped], capture_output=True, text=True, check=False, cwd=ROOT)
    assert "Error" not in ended.stderr
    assert "Traceback" not in ended.stderr


@pytest.mark.parametrize("arguments", [("--help",), ("check", PLATE), ("status", PLATE)])
def test_what_only_looks_imports_nothing_slow(arguments: tuple[object, ...]):
    """They take their time, and a machine that only looks need not be able to mesh or draw."""
    code = "import sys; from peenflow.cli import main\ntry: main()\nexcept SystemExit: pass\n"
    code += "print([m for m in ('numba', 'gmsh', 'vtk', 'vtkmodules', 'pyvista') if m in sys.modules])"
    ended = subprocess.run(
        [sys.executable, "-c", code, *map(str, arguments)], capture_output=True, text=True, check=True, cwd=ROOT
    )
    assert ended.stdout.splitlines()[-1] == "[]", ended.stderr


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_before_any_stage_is_no_accident(tmp_path: Path, number: signal.Signals, status: int):
    """It comes while the case is read: the named pipe it is read from keeps it waiting."""
    os.mkfifo(tmp_path / "case.toml")
    arguments = command("run", tmp_path)
    with (
        subprocess.Popen(arguments, stderr=subprocess.PIPE, text=True, cwd=ROOT) as process,
        open(tmp_path / "case.toml", "w"),  # opens once the other side reads
    ):
        time.sleep(0.1)
        process.send_signal(number)
        _, said = process.communicate(timeout=60)
    assert process.returncode == status
    assert one_paragraph(said), said
