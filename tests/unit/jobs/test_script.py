import os
import shlex
import subprocess
from pathlib import Path

import pytest

from peenflow.errors import InputError
from peenflow.jobs import Allocation, Job, Scheduler, render

FULL = Allocation(account="ab12", partition="long", time="90 min", memory="8 GB", modules=("gcc/12",), cpus=4)
NASTY = ("a b", "it's", "$(touch /tmp/never)", "`id`", '"', "x;y", "ü*?", "--set", 'shot.diameter="0.43 mm"')


def job(*command: str, out: str = "/scratch/re sults", title: str = "A hole") -> Job:
    return Job(title, command or ("true",), Path(out))


@pytest.fixture(params=list(Scheduler))
def scheduler(request: pytest.FixtureRequest) -> Scheduler:
    return request.param


def directives(text: str) -> list[str]:
    return [line.split(maxsplit=1)[1] for line in text.splitlines() if line.startswith(("#SBATCH", "#PBS"))]


def test_slurm_asks_for_what_the_case_wants():
    assert directives(render(job(), FULL, Scheduler.SLURM)) == [
        "--job-name=peen-a-hole",
        "--account=ab12",
        "--partition=long",
        "--time=01:30:00",
        "--mem=8192M",
        "--nodes=1",
        "--ntasks=1",
        "--cpus-per-task=4",
        '--output="/scratch/re sults/jobs/job.log"',
        "--open-mode=append",
        "--requeue",
        "--signal=B:TERM@60",
    ]


def test_pbs_asks_for_what_the_case_wants():
    assert directives(render(job(), FULL, Scheduler.PBS)) == [
        "-N peen-a-hole",
        "-A ab12",
        "-q long",
        "-l walltime=01:30:00",
        "-l select=1:ncpus=4:mem=8192mb",
        "-j oe",
        "-r y",
    ]


def test_what_is_not_asked_for_is_left_to_the_site(scheduler: Scheduler):
    text = render(job(), Allocation(), scheduler)
    assert not any(word in text for word in ("account", "-A", "partition", "-q ", "time", "mem", "module"))


def test_bash_reads_it_and_every_value_arrives_as_it_was(scheduler: Scheduler, tmp_path: Path):
    arguments = tmp_path / "arguments"
    (tmp_path / "jobs").mkdir()
    show = ("/usr/bin/python3", "-c", "import sys; open(sys.argv[1], 'w').write(repr(sys.argv[2:]))", str(arguments))
    modules = tmp_path / "modules"
    define = f'module() {{ printf "%s\\n" "$@" >> {shlex.quote(str(modules))}; }}; export -f module; bash "$0"'
    script = tmp_path / "job.sh"
    allocation = Allocation(modules=("gcc/12.2+x", "mpi"))
    script.write_text(render(job(*show, *NASTY, out=str(tmp_path)), allocation, scheduler))
    subprocess.run(["bash", "-n", str(script)], check=True)
    subprocess.run(["bash", "-c", define, str(script)], check=True, env=os.environ)
    assert arguments.read_text() == repr(list(NASTY))
    assert modules.read_text().splitlines() == ["load", "gcc/12.2+x", "load", "mpi"]


@pytest.mark.parametrize(
    "module",
    ["./evil", "/tmp/evil", "../evil", "a/../b", "--help", "-f", "gcc/12 $(id)", "a;b", "a\nb", "", "a//b", "~x"],
)
def test_a_module_is_a_name_and_no_file_or_option(module: str, scheduler: Scheduler):
    """`module load ./file` would run that file."""
    with pytest.raises(InputError, match="no module's name"):
        render(job(), Allocation(modules=(module,)), scheduler)


def test_threads_are_those_of_the_allocation(tmp_path: Path):
    (tmp_path / "jobs").mkdir()
    for scheduler, variable in ((Scheduler.SLURM, "SLURM_CPUS_PER_TASK"), (Scheduler.PBS, "NCPUS")):
        script = tmp_path / "job.sh"
        told = tmp_path / scheduler.value
        command = ("sh", "-c", 'echo "$OMP_NUM_THREADS $NUMBA_NUM_THREADS" >"$0"', str(told))
        script.write_text(render(job(*command, out=str(tmp_path)), Allocation(cpus=3), scheduler))
        subprocess.run(["bash", str(script)], check=True, env=os.environ | {variable: "7"})
        assert told.read_text() == "7 7\n"
        subprocess.run(["bash", str(script)], check=True)
        assert told.read_text() == "3 3\n"


@pytest.mark.parametrize(
    "wrong",
    [
        {"account": "a\n#SBATCH --uid=0"},
        {"account": "a b"},
        {"account": ""},
        {"partition": "$(id)"},
        {"time": "soon"},
        {"time": "12"},
        {"time": "1:00:00\n"},
        {"memory": "8"},
        {"memory": "8 GB\n#PBS -u root"},
    ],
)
def test_values_that_no_directive_may_hold_are_refused(scheduler: Scheduler, wrong: dict[str, str]):
    with pytest.raises(InputError, match=rf"\[hpc\] {next(iter(wrong))}"):
        render(job(), Allocation(**wrong), scheduler)


@pytest.mark.parametrize("out", ['/a"b', "/a\nb", "/a\\b"])
def test_directories_that_no_directive_may_hold_are_refused(scheduler: Scheduler, out: str):
    with pytest.raises(InputError, match="--out"):
        render(job(out=out), Allocation(), scheduler)


def test_slurm_does_not_expand_a_percent_sign_of_the_directory():
    assert '--output="/a%%j/jobs/job.log"' in render(job(out="/a%j"), Allocation(), Scheduler.SLURM)


@pytest.mark.parametrize(
    ("title", "name"),
    [("", "peen"), ("x\n#SBATCH --uid=0", "peen-x-sbatch-u"), ("Loch – 7,5 mm", "peen-loch-7-5-m"), ("a  ", "peen-a")],
)
def test_any_title_makes_a_job_name(title: str, name: str):
    assert f"--job-name={name}\n" in render(job(title=title), Allocation(), Scheduler.SLURM)


@pytest.mark.parametrize(
    ("given", "clock"),
    [("12:00:00", "12:00:00"), ("1-12:00:30", "36:00:30"), ("2 h", "02:00:00"), ("3 day", "72:00:00")],
)
def test_times_in_either_form(given: str, clock: str):
    assert f"--time={clock}\n" in render(job(), Allocation(time=given), Scheduler.SLURM)
