"""results.json: everything that was found, in plain values, and nothing that is not there."""

import itertools
import json
from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters.timing import Timing
from poinsot.reports import results, stored
from poinsot.reports.cell import Cell
from poinsot.reports.judge import judge
from poinsot.reports.results import CellRecord
from poinsot.reports.stored import ResultsError
from poinsot.reports.verdict import Status
from poinsot.scenarios.registry import scenes

SCENE = scenes()["free_symmetric_top[oblate]"]
DT = 1e-3
TIMING = Timing(10_000, 2_000, (0.7, 0.5, 0.6)).as_row()
RAN = CellRecord(
    SCENE.full_name, "alpha", "1.0", "own", "SE", 1, DT, 10_000, log="logs/a.mcap", settings={"a": "b"}
)
BROKE = replace(
    RAN, engine="beta", log=None, status=Status.ERROR, message="its process died (signal 11, SIGSEGV)"
)
ABSENT = CellRecord(
    SCENE.full_name, "gamma", "", "", "", 0, DT, 0, status=Status.UNAVAILABLE, message="gamma is not"
)


@pytest.fixture
def found(ahead):
    run = ahead(SCENE, DT)
    timings = {RAN.key: TIMING}
    cells = [Cell.of(run, {SCENE.full_name: SCENE})]
    rows = results.precision_rows(cells, timings)
    return results.results(
        [RAN, BROKE, ABSENT], judge([run], known=()), rows, scenes(), {"poinsot": "0.1"}, ["note"]
    )


def test_the_names_are_those_that_scripts_rely_on(found):
    assert {"schema", "environment", "cells", "work_precision"} <= set(found)
    assert found["schema"] == "poinsot.results/1"
    cell, verdict, row = found["cells"][0], found["cells"][0]["verdicts"][0], found["work_precision"][0]
    assert {"scene", "engine", "engine_version", "scheme", "twin", "dt", "status", "log", "verdicts"} <= set(
        cell
    )
    assert set(verdict) == {"check", "observable", "status", "measured", "allowed", "unit", "at", "message"}
    assert {
        "scene", "engine", "engine_version", "scheme", "dt", "steps", "observable", "error", "seconds_min",
        "seconds_median", "repeats",
    } <= set(row)  # fmt: skip


def test_a_row_tells_how_fast_that_was(found):
    row = found["work_precision"][0]
    assert row["steps_per_second"] == pytest.approx(row["steps"] / row["seconds_min"])
    assert row["steps_per_second"] == pytest.approx(1e6 / row["us_per_step"])
    assert row["real_time"] == pytest.approx(row["steps_per_second"] * row["dt"])
    assert row["error_per_us"] == pytest.approx(row["error"] / row["steps"] / row["us_per_step"])


def test_where_no_time_was_taken_or_no_error_is_finite_no_pace_is_told(found):
    row = found["work_precision"][0]
    untimed = results.with_time(row, dict.fromkeys(results.TIMES))
    assert untimed["steps_per_second"] is untimed["real_time"] is untimed["error_per_us"] is None
    assert results.with_time({**row, "error": None}, TIMING)["error_per_us"] is None


def test_memory_and_size_of_the_log_survive_a_second_report(found):
    weighed = {**found, "cells": [{**cell, "log_bytes": 5, "memory_bytes": 7} for cell in found["cells"]]}
    again = results.records_of(weighed)
    assert [(record.log_bytes, record.memory) for record in again] == [(5, 7)] * 3
    told = results.results(again, [], [], scenes(), {}, [])["cells"]
    assert [(cell["log_bytes"], cell["memory_bytes"]) for cell in told] == [(5, 7)] * 3


def test_results_of_before_they_were_kept_are_read(found):
    old = {**found, "cells": [dict(cell) for cell in found["cells"]]}
    for cell in old["cells"]:
        del cell["log_bytes"], cell["memory_bytes"]
    assert {record.memory for record in results.records_of(old)} == {None}


def test_every_cell_is_there_with_its_own_verdicts(found):
    ran, broke, absent = found["cells"]
    assert (ran["status"], ran["log"], len(ran["verdicts"])) == ("unsupported", "logs/a.mcap", 4)
    assert (broke["status"], broke["log"], broke["verdicts"]) == ("error", None, [])
    assert broke["message"] == "its process died (signal 11, SIGSEGV)"
    assert absent["status"] == "unavailable"
    assert set(found["scenes"]) == {SCENE.full_name}


def test_error_against_time_has_a_row_for_each_state_and_rate(found, ahead):
    rows = {row["observable"]: row for row in found["work_precision"]}
    assert list(rows) == ["orientation", "omega", "position", "Omega_b"]
    cell = Cell.of(ahead(SCENE, DT), {SCENE.full_name: SCENE})
    assert rows["omega"]["error"] == cell.error(SCENE.observables[1]) > 0
    assert {row["seconds_min"] for row in rows.values()} == {0.5}
    untimed = results.precision_rows([cell], {})
    assert {(row["seconds_min"], row["repeats"]) for row in untimed} == {(None, 0)}


def test_a_timing_belongs_to_its_own_step(ahead):
    cell = Cell.of(ahead(SCENE, 2e-3), {SCENE.full_name: SCENE})
    timings = {RAN.key: TIMING}
    assert results.precision_rows([cell], timings)[0]["seconds_min"] is None


def test_a_file_gives_back_what_was_written(found, tmp_path):
    path = tmp_path / "results.json"
    stored.write(path, found)
    assert results.read(path) == json.loads(json.dumps(found))
    assert results.records_of(results.read(path)) == [RAN, BROKE, ABSENT]
    assert results.timings_of(results.read(path)) == {RAN.key: TIMING}
    before = path.read_bytes()
    stored.write(path, results.read(path))
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    "text", ["", "{", "[]", "{}", '{"schema": "poinsot.results/2"}', '"poinsot.results/1"']
)
def test_a_file_that_holds_no_results_is_refused(tmp_path, text):
    path = tmp_path / "results.json"
    path.write_text(text)
    with pytest.raises(ResultsError, match=r"^results\.json: .*expected"):
        results.read(path)


def test_numbers_that_json_does_not_know_are_left_to_the_sentence(ahead, tmp_path):
    run = ahead(SCENE, DT)
    run = replace(run, provenance=replace(run.provenance, setup={}))
    cell = Cell.of(replace(run, omega=np.full_like(run.omega, np.nan)), {SCENE.full_name: SCENE})
    rows = results.precision_rows([cell], {})
    assert [row["error"] for row in rows if row["observable"] == "omega"] == [None]
    found = results.results([RAN], judge([run], known=()), rows, scenes(), {}, [])
    measured = {v["check"]: v["measured"] for v in found["cells"][0]["verdicts"] if v["check"] != "invariant"}
    assert set(measured.values()) == {None}
    stored.write(tmp_path / "results.json", found)


def test_a_cell_is_as_good_as_its_worst_verdict():
    for better, worse in itertools.pairwise(reversed(results.GRAVITY)):
        assert results.worst([better, worse, better]) is worse
    assert set(results.GRAVITY) == set(Status)
    assert results.worst([]) is Status.PASS


@pytest.mark.parametrize(
    ("statuses", "stale", "code"),
    [
        (["pass", "known", "unsupported", "unavailable"], [], 0),
        (["pass", "fail"], [], 1),
        (["pass", "fixed"], [], 1),
        (["pass"], ["an entry that matches nothing"], 1),
        (["fail", "error"], [], 3),
        ([], [], 0),
    ],
)
def test_a_run_ends_with_the_code_of_its_gravest_cell(statuses, stale, code):
    cells = [{"status": status} for status in statuses]
    assert results.exit_code({"cells": cells, "stale_deviations": stale}) == code


def test_what_conforms_is_what_ends_with_nought():
    for status in Status:
        code = results.exit_code({"cells": [{"status": status.value}], "stale_deviations": []})
        assert (code == 0) is status.conforms
        assert status.sentence.endswith(".")
