from peenflow import machine
from peenflow.bearable import burdens


def stages(wall: float, memory: float) -> list[dict[str, object]]:
    small = {"stage": "mesh", "predicted_wall_s": 1.0, "predicted_memory_B": 1}
    return [small, {"stage": "solve", "predicted_wall_s": wall, "predicted_memory_B": round(memory)}]


def test_what_this_machine_bears_in_a_day_is_no_burden():
    assert burdens(stages(86_000.0, 0.9 * machine.memory())) == []


def test_more_memory_than_the_machine_has_is_told():
    (told,) = burdens(stages(1.0, 1.1 * machine.memory()))
    assert told.startswith("the run is predicted to need ")
    assert "accuracy.mesh_size" in told


def test_more_time_than_a_day_is_told():
    (told,) = burdens(stages(340 * 86_400.0, 1.0))
    assert "predicted to take 340 days" in told
    assert "accuracy.budget" in told
