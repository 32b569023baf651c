"""What a run says that it took."""

import json
from time import process_time, sleep

import pytest
from poinsot.adapters.runner import Outcome, Request

from poinsot.cost import FILE, Cost


def test_a_phase_tells_waiting_from_work():
    cost = Cost(workers=2)
    with cost.phase("waiting"):
        sleep(0.1)
    end = process_time() + 0.1
    with cost.phase("working"):
        while process_time() < end:
            pass
    waited, worked = cost.phases["waiting"], cost.phases["working"]
    assert waited["seconds"] >= 0.1 > 0.05 > waited["cpu_seconds"]
    assert worked["cpu_seconds"] == pytest.approx(0.1, abs=0.02)


def test_every_cell_and_scene_is_written(tmp_path):
    cost = Cost(workers=2)
    asked = Request("top[fast]", "own", "Euler", 1e-3, 2), Request('"quoted"', "own", "Euler", 1e-3)
    cost.outcomes = [
        Outcome(asked[0], "a.mcap", spent={"stepping": 1.23456789}),
        Outcome(asked[1], error="died"),
    ]
    cost.judging = {"top[fast]": {"checks": 0.5}, '"quoted"': {"checks": 0.25}}
    cost.write(tmp_path)
    found = json.loads((tmp_path / FILE).read_text(encoding="utf-8"))
    assert [cell["spent"] for cell in found["cells"]] == [{"stepping": 1.234568}, {}]
    assert found["cells"][0]["repeats"] == 2
    assert found["judging"] == cost.judging


def test_a_run_of_nothing_is_written_too(tmp_path):
    Cost(workers=1).write(tmp_path)
    assert json.loads((tmp_path / FILE).read_text(encoding="utf-8"))["cells"] == []
