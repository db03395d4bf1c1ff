import subprocess
import sys
import time

from peenflow.pipeline.meter import Cost, Meter

MEBIBYTE = 1024**2


def test_wall_and_processor_time():
    meter = Meter()
    end = time.process_time() + 0.2
    while time.process_time() < end:
        pass
    time.sleep(0.1)
    cost = meter.stop()
    assert cost.cpu_s >= 0.2
    assert cost.wall_s >= 0.3


def test_children_count():
    meter = Meter()
    code = "import time; a = bytearray(200 * 2**20); e = time.process_time() + 0.7\nwhile time.process_time() < e: pass"
    subprocess.run([sys.executable, "-c", code], check=True)
    cost = meter.stop()
    assert cost.cpu_s >= 0.7
    assert cost.peak_memory_B >= 200 * MEBIBYTE


def test_own_memory_counts_even_if_given_back():
    meter = Meter()
    bytearray(150 * MEBIBYTE)
    assert meter.stop().peak_memory_B >= 150 * MEBIBYTE


def test_an_interrupted_run_and_the_rest_add_up():
    assert Cost(1.0, 2.0, 30) + Cost(4.0, 5.0, 20) == Cost(5.0, 7.0, 30)


def test_what_compiling_took_is_told_apart(tmp_path, monkeypatch):
    """A kernel that is in no cache costs its stage time that the next run does not take."""
    from peenflow.jit import kernels_of

    (tmp_path / "kernel.py").write_text("def doubled(x):\n    return 2.0 * x\n")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    scope = {}
    exec(compile((tmp_path / "kernel.py").read_text(), str(tmp_path / "kernel.py"), "exec"), scope)
    doubled = kernels_of(tmp_path)(scope["doubled"])
    meter = Meter()
    doubled(1.0)
    first = meter.stop()
    meter = Meter()
    doubled(2.0)
    assert 0.01 < first.compile_s <= first.cpu_s
    assert meter.stop().compile_s == 0.0
