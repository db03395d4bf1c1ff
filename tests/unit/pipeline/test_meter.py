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
