"""Two runs side by side: what got worse, whose error is another, and what no difference is made of."""

import copy

import pytest
from poinsot.reports.comparison import as_text, compared


@pytest.fixture
def runs(remade):
    old = remade()
    return old, copy.deepcopy(old)


def a_verdict(results, status="pass"):
    return next(
        (cell, verdict)
        for cell in results["cells"]
        for verdict in cell["verdicts"]
        if verdict["status"] == status
    )


def test_a_run_is_the_same_as_itself(runs):
    found = compared(*runs)
    assert found.same
    assert (found.errors, found.better, found.versions, found.times) == ((), (), (), ())
    assert as_text(found).startswith("The runs agree.")


def test_a_verdict_that_turns_is_worse_one_way_and_better_the_other(runs):
    old, new = runs
    cell, verdict = a_verdict(new)
    verdict["status"] = "fail"
    (said,) = compared(old, new).worse
    assert f"{verdict['check']} of {verdict['observable']}: pass" in said
    assert cell["scene"] in said
    assert not compared(old, new).same
    assert len(compared(new, old).better) == 1
    assert compared(new, old).same


def test_a_check_that_is_no_longer_made_is_worse_and_a_new_one_only_where_it_fails(runs):
    old, new = runs
    cell, verdict = a_verdict(new)
    cell["verdicts"].remove(verdict)
    assert "no longer checked" in compared(old, new).worse[0]
    assert compared(new, old).same
    verdict["status"] = "fail"
    cell, _ = a_verdict(old)
    cell["verdicts"].append(verdict | {"observable": "another"})
    assert any("not checked → fail" in said for said in compared(new, old).worse)


def test_a_cell_that_is_missing_and_one_that_broke(runs):
    old, new = runs
    gone = new["cells"].pop(0)
    found = compared(old, new)
    assert gone["scene"] in found.gone[0]
    assert not found.same
    assert compared(new, old).added == found.gone
    new["cells"][0] |= {"status": "error", "verdicts": [], "message": "its process died (signal 11)"}
    assert any("→ error its process died" in said for said in compared(old, new).worse)


@pytest.mark.parametrize(("factor", "told"), [(1.005, False), (1.02, True), (0.97, True)])
def test_an_error_that_is_another_is_told_even_where_every_check_passes(runs, factor, told):
    old, new = runs
    row = next(row for row in new["work_precision"] if row["error"])
    row["error"] *= factor
    found = compared(old, new)
    assert bool(found.errors) is told
    assert found.same is not told
    assert not told or f"error of {row['observable']}" in found.errors[0]


def of_order(results, power):
    """The rows of one ladder, whose error now falls with that power of the step."""
    first = next(
        row for row in results["work_precision"] if row["error"] and row["observable"] == "orientation"
    )
    names = ("scene", "engine", "scheme", "observable")
    rows = [row for row in results["work_precision"] if all(row[name] == first[name] for name in names)]
    for row in rows:
        row["error"], row["round_off"] = row["dt"] ** power, 0.0
    return rows


@pytest.mark.parametrize(("power", "told"), [(4, True), (1, True), (2.2, False)])
def test_an_order_that_is_another_is_told(runs, power, told):
    old, new = runs
    rows = of_order(old, 2)
    assert len(rows) >= 3
    of_order(new, power)
    found = compared(old, new)
    assert bool(found.orders) is told
    assert not found.same
    if told:
        (said,) = found.orders
        assert said.endswith(f"order of orientation 2.00 → {power:.2f}")
        assert rows[0]["scheme"] in said


def test_too_few_steps_tell_no_order(runs):
    old, new = runs
    of_order(old, 2)
    for row in of_order(new, 4)[2:]:
        row["error"] = None
    assert compared(old, new).orders == ()


def test_a_check_that_could_not_be_made_is_no_loss(runs):
    old, new = runs
    cell, verdict = a_verdict(old)
    cell["verdicts"].append(verdict | {"observable": "another", "status": "unsupported"})
    assert compared(old, new).same


def test_round_off_is_no_difference(runs):
    old, new = runs
    row = next(row for row in new["work_precision"] if row["error"])
    row["round_off"] = row["error"]
    row["error"] *= 1.9
    assert compared(old, new).same


def test_versions_that_differ_are_told_and_when_a_run_was_made_is_not(runs):
    old, new = runs
    new["environment"] = dict(old["environment"]) | {"mujoco": "9.9", "started": "later", "seconds": 1.0}
    old["environment"] = dict(old["environment"]) | {"mujoco": "9.8"}
    assert compared(old, new).versions == ("mujoco 9.8 → 9.9",)


def test_times_are_told_on_one_machine_only(runs):
    old, new = runs
    for row in new["work_precision"]:
        if row["seconds_min"]:
            row["seconds_min"] *= 1.3
    assert all("1.30 × as long" in said for said in compared(old, new).times)
    assert compared(old, new).times
    assert compared(old, new).same
    new["environment"] = dict(new["environment"]) | {"cpu": "another"}
    found = compared(old, new)
    assert found.times == ()
    assert found.notes == ("Run times: the runs were made on different machines.",)
