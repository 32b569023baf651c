"""What a run says of itself beside its verdicts."""

from dataclasses import replace

import pytest
from poinsot.adapters import runner
from poinsot.adapters.timing import Timing
from poinsot.scenarios.registry import select

from poinsot import listing, main_job
from poinsot.cost import Cost
from poinsot.plan import Extent, not_to_time, plan

SCENE = "stiff_spring"
STEADY = Timing(100, 100, (1.0, 1.1, 1.2), beat=1e-3)
LOOSE = replace(STEADY, seconds=(1.0, 2.0, 2.0), beat=2e-3)


@pytest.mark.parametrize(
    ("timings", "cores", "said"),
    [
        ([], 2, []),
        ([STEADY], 2, ["no cell's middle repeat took over 20% longer"]),
        (
            [STEADY, LOOSE],
            2,
            ["of 2 cells, 1 spread by more than 20%, repeated or not: stiff_spring in alpha own at dt 1"],
        ),
        ([STEADY, LOOSE.of(500)], 2, ["no cell's middle repeat took over 20% longer"]),
        ([LOOSE] * 12, 2, ["at dt 9 s and 2 more."]),
        ([replace(STEADY, pinned=False)], 2, ["took over 20%", "keeps no process on one core"]),
        ([STEADY], 1, ["took over 20%", "there is one core"]),
    ],
)
def test_how_far_timings_can_be_trusted_is_said(monkeypatch, timings, cores, said):
    monkeypatch.setattr(runner, "cores", lambda: cores)
    found = main_job._quality({(SCENE, "alpha", "own", dt): timing for dt, timing in enumerate(timings)})
    assert len(found) == len(said)
    assert all(words in sentence for words, sentence in zip(said, found, strict=True))


def test_what_makes_timings_loose_is_told_at_the_end_of_a_run(monkeypatch, tmp_path):
    monkeypatch.setattr(runner, "cores", lambda: 1)
    notes = main_job._quality({(SCENE, "alpha", "own", 1.0): STEADY})
    found = {"cells": [], "stale_deviations": [], "notes": notes}
    _, loose, _ = listing.outcome(found, tmp_path).splitlines()
    assert "there is one core" in loose


def test_a_run_that_times_says_which_variants_it_does_not(tmp_path):
    pytest.importorskip("pinocchio")
    names = ["free_symmetric_top[oblate]", "free_symmetric_top[prolate]"]
    laid = plan(select(names), ["pinocchio"], ["RKMK4"], [], Extent.QUICK)
    found = main_job.run(laid, tmp_path, "poinsot run", 1, 60.0, True, lambda *told: None)
    assert {row["scene"] for row in found["work_precision"] if row["seconds_min"]} == {names[0]}
    assert [note for note in found["notes"] if "were not timed" in note] == not_to_time(laid)


SLOW = replace(STEADY, seconds=(1.3, 1.3, 1.3))


def key(nth, scene="free_symmetric_top[oblate]"):
    return scene, "alpha", "own", float(nth)


def test_cells_whose_steps_take_longer_than_those_of_their_ladder_are_told_apart():
    ladder = dict(enumerate([STEADY, SLOW, STEADY]))
    assert list(main_job._slow({key(nth): timing for nth, timing in ladder.items()})) == [key(1)]
    # What a call takes by itself is no part of a step, and steps with contact differ.
    asked = {**ladder, 1: replace(SLOW, call=0.3, timed=100)}
    assert not main_job._slow({key(nth): timing for nth, timing in asked.items()})
    assert not main_job._slow({key(nth, "rolling[hoop]"): timing for nth, timing in ladder.items()})
    (*_, said) = main_job._quality({key(nth): timing for nth, timing in ladder.items()})
    assert "in 1 of 3 cells a step took over 20% longer" in said
    assert "timed again or not: free_symmetric_top[oblate] in alpha own at dt 1 s" in said


@pytest.mark.parametrize(
    ("again", "kept"), [(STEADY, STEADY), (replace(SLOW, seconds=(2.0,)), SLOW), ("no", SLOW)]
)
def test_a_cell_that_was_slow_as_a_whole_is_timed_once_more_and_the_quicker_kept(monkeypatch, again, kept):
    pytest.importorskip("pinocchio")
    laid = plan(select(["free_symmetric_top[oblate]"]), ["pinocchio"], ["RKMK4"], [], Extent.WHOLE)
    records = [replace(record, log="logs/a.mcap") for record in laid.records]
    asked, first = [], laid.records[2].key

    def time(requests, time_limit, progress=lambda request: None):
        asked.append(len(requests))
        slow = SLOW if len(asked) == 1 else again
        return {request: slow if request == laid.requests[first] else STEADY for request in requests}

    monkeypatch.setattr(runner, "time", time)
    found = main_job._timed(laid, records, 60.0, lambda *told: None, Cost(1, None))
    assert asked == [len(records), 1]
    assert found == {record.key: kept if record.key == first else STEADY for record in records}
