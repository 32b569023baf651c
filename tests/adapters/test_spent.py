"""Time is told apart by part, counted once, and all of it."""

from time import perf_counter, process_time

import pytest
from poinsot.adapters import runner, spent
from poinsot.adapters.runner import Request


def work(seconds):
    """Keep the processor busy for so long."""
    end = process_time() + seconds
    while process_time() < end:
        pass


def test_each_part_has_its_own_time_and_the_rest_is_what_no_part_has():
    spent.forget()
    with spent.on("long"):
        work(0.03)
    with spent.on("short"):
        work(0.01)
    work(0.02)
    found = spent.so_far()
    assert found == pytest.approx({"long": 0.03, "short": 0.01, spent.REST: 0.02}, abs=2e-3)


def test_what_is_within_a_part_belongs_to_it_and_is_counted_once():
    spent.forget()
    with spent.on("outer"), spent.on("inner"):
        work(0.01)
    with spent.on("inner"):
        pass
    found = spent.so_far()
    assert found["outer"] == pytest.approx(0.01, abs=2e-3)
    assert found["inner"] < 1e-3


def test_a_part_ends_where_its_block_breaks_off():
    spent.forget()
    with pytest.raises(ValueError, match="broken"), spent.on("broken"):
        raise ValueError("broken")
    with spent.on("next"):
        work(0.01)
    assert spent.so_far()["next"] == pytest.approx(0.01, abs=2e-3)


def test_a_new_piece_of_work_begins_at_nothing():
    with spent.on("old"):
        work(0.01)
    spent.forget()
    assert sum(spent.so_far().values()) < 1e-3


def test_the_parts_of_a_cell_are_all_of_it(tmp_path):
    pytest.importorskip("mujoco")
    request = Request("stiff_spring", "mujoco", "Euler", 1e-5, repeats=2, asked=True)
    runner._logged(request, tmp_path)  # what is loaded once is not of the cell
    clock = perf_counter()
    _, _, found = runner._logged(request, tmp_path)
    whole = perf_counter() - clock
    parts = "loading", "building", "setup", "accelerations", "stepping", "repeat", "stable step", "logging"
    assert set(found) == {*parts, spent.REST}
    assert 0 < sum(found.values()) <= whole * 1.1
    # The second run steps, builds and looks as the first did: more than its steps alone, less than all.
    assert found["stepping"] < found["repeat"] < sum(found.values())
    assert found["stable step"] > found["building"], "a search for a limit is dozens of runs"
