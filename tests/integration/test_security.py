"""A case directory from a stranger: nothing in it is run, and nothing outside it is read or written."""

import ast
import html
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import parts
import pytest
from command_line import ROOT, command, one_paragraph, peenflow

from peenflow import templates

CASE = """\
title = {title}
[shot]
size = "CW14"
[target]
material = "inconel718"
geometry = {{ kind = "plate", thickness = "5 mm" }}
patch = {{ length = "0.5 mm", width = "0.5 mm" }}
[impacts]
file = "shots.csv"
[accuracy]
preset = "draft"
mesh_size = "0.05 mm"
{more}
"""
TABLE = "t_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n0,0,0,0,0,0,-30\n"
NASTY = """'$(touch pwned)`touch pwned`; touch pwned | {{ 7*7 }} <script>alert(1)</script> ${HOME} & "x" %n'"""
PACKAGE = ROOT / "peenflow"
SOURCES = sorted(PACKAGE.rglob("*.py"))


def case_in(directory: Path, title: str = '"a plate"', more: str = "") -> Path:
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "case.toml").write_text(CASE.format(title=title, more=more))
    (directory / "shots.csv").write_text(TABLE)
    return directory


# ---- the sources -----------------------------------------------------------------------------------------------------

RUNNERS = {"eval", "exec", "compile", "__import__", "os.system", "os.popen", "subprocess.getoutput", "jinja2.Template"}
MODULES = {"pickle", "shelve", "marshal", "dill", "cloudpickle", "joblib", "yaml", "code", "runpy", "imp"}


def calls(tree: ast.Module) -> list[tuple[str, ast.Call]]:
    return [(ast.unparse(node.func), node) for node in ast.walk(tree) if isinstance(node, ast.Call)]


def test_no_source_runs_text_or_unpickles():
    for path in SOURCES:
        tree = ast.parse(path.read_text())
        imported = {alias.name.split(".")[0] for n in ast.walk(tree) if isinstance(n, ast.Import) for alias in n.names}
        imported |= {(n.module or "").split(".")[0] for n in ast.walk(tree) if isinstance(n, ast.ImportFrom)}
        assert not imported & MODULES, path
        for name, call in calls(tree):
            words = {word.arg: word.value for word in call.keywords}
            assert name not in RUNNERS, path
            assert "shell" not in words, path
            if "allow_pickle" in words:  # numpy's own default is False
                assert ast.unparse(words["allow_pickle"]) == "False", path


def test_processes_are_started_from_lists_and_python_without_the_current_directory():
    started = 0
    for path in SOURCES:
        for name, call in calls(ast.parse(path.read_text())):
            if name.startswith("subprocess.") and call.args:
                started += 1
                assert not isinstance(call.args[0], ast.Constant | ast.JoinedStr | ast.BinOp), path
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.List | ast.Tuple):
                parts = [ast.unparse(part) for part in node.elts]
                if parts[:1] == ["sys.executable"]:
                    assert parts[1] == "'-P'", path
    assert started >= 3


# ---- templates -------------------------------------------------------------------------------------------------------


def test_templates_come_from_the_package_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    for name in ("liggghts/deck.in.j2", "report/index.html.j2", "jobs/slurm.sh.j2"):
        (tmp_path / "templates" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "templates" / name).write_text("pwned")
    monkeypatch.chdir(tmp_path)
    for name in ("liggghts/deck.in.j2", "report/index.html.j2", "jobs/slurm.sh.j2"):
        loader = templates.environment().loader
        assert loader is not None
        _, file, _ = loader.get_source(templates.environment(), name)
        assert Path(file or "").is_relative_to(ROOT)


# ---- what lies beside the case ---------------------------------------------------------------------------------------

SHADOWED = ("numpy", "json", "h5py", "peenflow", "sitecustomize", "pyvista", "matplotlib", "numba", "typing_extensions")


def evil(directory: Path) -> Path:
    """Modules and settings that Python, numba and matplotlib look for in the current directory; a sign that one ran."""
    sign = directory / "pwned"
    for name in SHADOWED:
        (directory / f"{name}.py").write_text(f"open({str(sign)!r}, 'w')\n")
    (directory / "matplotlibrc").write_text("axes.facecolor: red\nfigure.dpi: 3\nbackend: module://json\n")
    return sign


def test_modules_in_the_case_directory_are_not_run(tmp_path: Path):
    """The program as it is installed, called in the stranger's directory, pictures drawn by its child processes."""
    case = case_in(tmp_path / "case")
    sign = evil(case)
    program = shutil.which("peenflow", path=str(Path(command()[0]).parent))
    if program is None:
        pytest.skip("peenflow is not installed beside this Python")
    ended = subprocess.run([program, "run", "."], capture_output=True, text=True, check=False, cwd=case)
    assert ended.returncode == 0, ended.stderr
    assert not sign.exists()
    picture = next((case / "results" / "report").glob("*.svg")).read_text()
    assert "#ff0000" not in picture


# ---- titles and names ------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def nasty(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A case with a nasty title in a directory with a nasty name, run to its end."""
    case = case_in(tmp_path_factory.mktemp("nasty") / "a $(touch pwned);`touch pwned` & 'x' {{7*7}} %n", NASTY)
    ended = peenflow("run", case)
    assert ended.returncode == 0, ended.stderr
    assert not list(case.parent.rglob("pwned"))
    assert not (ROOT / "pwned").exists()
    return case


def test_a_title_is_text_on_the_page(nasty: Path):
    page = (nasty / "results" / "report" / "index.html").read_text()
    assert "<script>" not in page
    assert html.escape("<script>alert(1)</script>", quote=False) in page
    assert "{{ 7*7 }}" in page


def test_a_title_is_text_in_the_deck(nasty: Path):
    solved = peenflow("solve", nasty / "results" / "fe", "--out", nasty / "again")
    assert solved.returncode == 0, solved.stderr


@pytest.mark.parametrize("scheduler", ["slurm", "pbs"])
def test_a_title_and_a_directory_are_words_in_a_job_script(tmp_path: Path, scheduler: str):
    case = case_in(tmp_path / "a $(touch pwned);`touch pwned` & 'x' %j", NASTY)
    ended = peenflow("submit", case, "--scheduler", scheduler, "--dry-run", "--set", "title=$(touch pwned)\\'")
    assert ended.returncode == 0, ended.stderr
    script = case / "results" / "jobs" / f"{scheduler}.sh"
    for line in script.read_text().splitlines():
        assert not line.startswith(("touch", "$(")), line
    fake = tmp_path / "bin"
    fake.mkdir()
    lines = [line for line in script.read_text().splitlines() if not line.startswith("exec >>")]
    body = "\n".join(
        line.replace("exec ", "printf '%s\\n' ", 1) if line.startswith("exec /") else line for line in lines
    )
    shown = subprocess.run(["bash", "-c", body], capture_output=True, text=True, check=True, cwd=tmp_path)
    assert str(case) in shown.stdout.splitlines()
    assert not list(tmp_path.rglob("pwned"))


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("account", '"x\\n#SBATCH --wrap=id"'),
        ("account", '"a b"'),
        ("partition", '"$(id)"'),
        ("time", '"1:00:00; id"'),
        ("memory", '"8 GB\\nid"'),
        ("modules", '["./evil"]'),
        ("modules", '["-f"]'),
    ],
)
def test_a_value_for_the_scheduler_is_refused_unless_harmless(tmp_path: Path, key: str, value: str):
    case = case_in(tmp_path / "case", more=f"[hpc]\n{key} = {value}")
    ended = peenflow("submit", case, "--scheduler", "slurm", "--dry-run")
    assert ended.returncode == 2, ended.stdout
    assert one_paragraph(ended.stderr)
    assert not (case / "results" / "jobs" / "slurm.sh").exists()


def test_liggghts_gets_no_text_from_the_case(tmp_path: Path):
    """It would run `shell rm …`: its deck holds numbers, and words of the template."""
    case = tmp_path / "case $(touch pwned) ; shell touch pwned"
    shutil.copytree(ROOT / "cases" / "plate", case, ignore=shutil.ignore_patterns("results"))
    file = case / "case.toml"
    file.write_text(file.read_text().replace("A plate under one nozzle", "x & shell touch pwned # ${now} $(step)"))
    fast = ("accuracy.preset=draft", "exposure.duration=0.1 ms", "dem.restitution=0.5", "effects.deflector_motion=off")
    ended = peenflow("run", case, "--until", "dem", *(part for word in fast for part in ("--set", word)))
    assert ended.returncode == 0, ended.stderr
    for deck in case.rglob("*.in"):
        assert "pwned" not in deck.read_text()
    assert not [path for path in tmp_path.rglob("*") if path.name == "pwned"]


# ---- paths -----------------------------------------------------------------------------------------------------------


def snapshot(directory: Path) -> dict[str, bytes]:
    return {str(path): path.read_bytes() for path in sorted(directory.rglob("*")) if path.is_file()}


@pytest.mark.parametrize(
    ("asked", "link"),
    [
        ("run", "results"),
        ("run", "results/log.txt"),
        ("report", "results/report"),
        ("clean", "results/mesh"),
        ("status", "results/.peenflow"),
        ("submit", "results/dem/x"),
        ("study", "study"),
    ],
)
def test_a_link_out_of_the_case_is_not_followed(tmp_path: Path, asked: str, link: str):
    """It would have run empty a folder, add to a start-up file, or write where the stranger wants."""
    case, victim = case_in(tmp_path / "case"), tmp_path / "home"
    victim.mkdir()
    (victim / "precious.csv").write_text("mine")
    (victim / ".peenflow").mkdir()
    aim = victim / "precious.csv" if link.endswith((".txt", "x")) else victim
    (case / link).parent.mkdir(parents=True, exist_ok=True)
    (case / link).symlink_to(aim)
    before = snapshot(victim)
    more = ("--scheduler", "slurm", "--dry-run") if asked == "submit" else ()
    ended = peenflow(asked, case, *more)
    assert ended.returncode == 2, ended.stderr
    assert one_paragraph(ended.stderr), ended.stderr
    assert "leads out of" in ended.stderr or "is a link out of" in ended.stderr
    assert snapshot(victim) == before


def test_a_results_directory_named_on_the_command_line_may_be_anywhere(tmp_path: Path):
    case = case_in(tmp_path / "case")
    (tmp_path / "scratch").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "scratch")
    assert peenflow("run", case, "--until", "mesh", "--out", tmp_path / "link").returncode == 0
    assert (tmp_path / "scratch" / "target.h5").is_file()


@pytest.mark.parametrize("name", ["../outside.csv", "/etc/passwd", "link.csv", "folder/../../outside.csv"])
def test_a_table_outside_the_case_is_not_read(tmp_path: Path, name: str):
    case = case_in(tmp_path / "case")
    (tmp_path / "outside.csv").write_text(TABLE)
    (case / "folder").mkdir()
    (case / "link.csv").symlink_to("../outside.csv")
    file = case / "case.toml"
    file.write_text(file.read_text().replace("shots.csv", name))
    ended = peenflow("check", case)
    assert ended.returncode == 2
    assert "leads out of the case directory" in ended.stderr
    assert one_paragraph(ended.stderr)


def with_cad(directory: Path, name: str) -> Path:
    case = case_in(directory)
    file = case / "case.toml"
    text = file.read_text().replace(
        'kind = "plate", thickness = "5 mm"', f'kind = "step", file = "{name}", faces = [1]'
    )
    file.write_text(text.replace('width = "0.5 mm"', 'width = "0.5 mm", at = ["0 mm", "5 mm", "5 mm"]'))
    (case / "shots.csv").write_text(TABLE.replace("0,0,0,0,0,0,-30", "0,0,5e-3,5e-3,30,0,0"))
    return case


@pytest.mark.parametrize(
    ("asked", "name"),
    [
        ("check", "../part.step"),
        ("run", "../part.step"),
        ("check", "/etc/passwd"),
        ("check", "link.step"),
        ("check", "folder/../../part.step"),
    ],
)
def test_a_cad_file_outside_the_case_is_not_read(tmp_path: Path, asked: str, name: str):
    case = with_cad(tmp_path / "case", name)
    parts.block(tmp_path / "part.step")
    (case / "folder").mkdir()
    (case / "link.step").symlink_to("../part.step")
    ended = peenflow(asked, case)
    assert ended.returncode == 2
    assert one_paragraph(ended.stderr), ended.stderr
    assert "target.geometry.file" in ended.stderr
    assert "leads out of the case directory" in ended.stderr
    assert not (case / "results").exists()


def test_the_same_cad_file_in_the_case_is_read(tmp_path: Path):
    case = with_cad(tmp_path / "case", "part.step")
    parts.block(case / "part.step")
    ended = peenflow("check", case)
    assert ended.returncode == 0, ended.stderr


def test_init_does_not_copy_what_links_lead_to(tmp_path: Path):
    case = case_in(tmp_path / "case")
    (case / "secret").symlink_to("/etc/passwd")
    assert peenflow("init", tmp_path / "new", "--like", case).returncode == 0
    assert sorted(path.name for path in (tmp_path / "new").iterdir()) == ["case.toml", "shots.csv"]


# ---- pickles ---------------------------------------------------------------------------------------------------------


class Pwn:
    def __init__(self, sign: Path) -> None:
        self.sign = sign

    def __reduce__(self) -> tuple[object, tuple[str]]:
        return os.mkdir, (str(self.sign),)


def test_a_pickle_for_a_checkpoint_is_not_opened(tmp_path: Path):
    case, sign, out = case_in(tmp_path / "case"), tmp_path / "pwned", tmp_path / "out"
    first = peenflow("run", case, "--out", out, "--until", "translate")
    assert first.returncode == 0, first.stderr
    with open(out / "fe" / "checkpoint.npz", "wb") as file:
        np.savez(file, **{name: np.array([Pwn(sign)], dtype=object) for name in ("identity", "scalars", "u")})
    ended = peenflow("run", case, "--out", out, "--until", "solve")
    assert ended.returncode == 0, ended.stderr
    assert not sign.exists()


# ---- terminals -------------------------------------------------------------------------------------------------------


def test_an_escape_in_a_name_is_shown_and_not_obeyed(tmp_path: Path):
    case = tmp_path / "\x1b[2J\x1b]0;pwned\x07"
    ended = peenflow("check", case)
    assert ended.returncode == 2
    assert "\x1b" not in ended.stderr
    assert "\\x1b[2J" in ended.stderr
