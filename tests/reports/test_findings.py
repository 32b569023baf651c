"""A sentence for everything that is not a pass: none lost, none said twice."""

import copy

from poinsot.reports.digest import Digest
from poinsot.reports.findings import findings
from poinsot.reports.verdict import Status
from poinsot.reports.wording import GLYPHS


def told(results, status):
    return [finding for finding in findings(Digest(results)) if finding.status is status]


def test_every_cell_and_verdict_that_is_not_a_pass_is_spoken_of(results):
    found = {
        (finding.status, group.scene, group.column.label)
        for finding in findings(Digest(results))
        for group in finding.groups
    }
    for cell in results["cells"]:
        for part in (cell, *cell["verdicts"]):
            if part["status"] != "pass":
                label = f"{cell['engine']} {cell['scheme']}"
                assert (Status(part["status"]), cell["scene"], label) in found


def test_equal_reasons_are_one_line_with_all_their_places(results):
    (missing,) = told(results, Status.UNAVAILABLE)
    assert missing.where == "drake (every scheme) on every scene"
    assert missing.sentence == "drake is not installed."
    chains = [finding for finding in told(results, Status.UNSUPPORTED) if "ball joint" in finding.sentence]
    assert len(chains) == 1
    assert chains[0].where == "pybullet maximal on co2_chain (every variant)"
    assert chains[0].about == ""


def test_all_scenes_but_a_few_are_named_by_the_few(results):
    changed = copy.deepcopy(results)
    for cell in changed["cells"]:
        if cell["scheme"] == "RK4" and not cell["scene"].startswith("heavy_top[f"):
            cell.update(status="error", message="out of memory", verdicts=[])
    (finding,) = [f for f in told(changed, Status.ERROR) if f.sentence == "out of memory"]
    assert finding.where == "mujoco RK4 on every scene but heavy_top[fast]"


def test_a_check_that_fails_at_many_steps_speaks_where_it_is_worst_and_names_the_others(results):
    changed = copy.deepcopy(results)
    cells = [c for c in changed["cells"] if c["scheme"] == "reduced" and c["scene"] == "heavy_top[moderate]"]
    cells[3]["verdicts"][0].update(measured=1e3, message="a thousand radians off")
    (finding,) = told(changed, Status.FAIL)
    assert finding.sentence == "a thousand radians off"
    assert finding.about == "truth of orientation", "it fails at every step"
    assert finding.numbers.startswith("at worst, dt 2.50e-04 s: measured 1.00e+03, allowed ")
    assert finding.numbers.endswith(" rad")
    cells[1]["verdicts"][0]["status"] = "pass"
    (finding,) = told(changed, Status.FAIL)
    assert finding.about == "truth of orientation, dt 2.00e-03, 5.00e-04, 2.50e-04, 1.25e-04 s"


def test_different_accidents_at_different_steps_are_all_told(results):
    changed = copy.deepcopy(results)
    first, second, *_ = (cell for cell in changed["cells"] if cell["scheme"] == "RKMK4")
    first.update(status="error", message="timed out after 60 s", verdicts=[])
    second.update(status="error", message="died of signal 11", verdicts=[])
    sentences = [finding.sentence for finding in told(changed, Status.ERROR)]
    assert {"timed out after 60 s", "died of signal 11"} <= set(sentences)


def test_a_cell_that_says_nothing_is_given_the_words_of_its_status(results):
    changed = copy.deepcopy(results)
    changed["cells"][0].update(status="error", message="", verdicts=[])
    assert Status.ERROR.sentence in [finding.sentence for finding in told(changed, Status.ERROR)]


def test_the_worst_comes_first_and_what_was_not_looked_at_last(results):
    statuses = [finding.status.value for finding in findings(Digest(results))]
    assert list(dict.fromkeys(statuses)) == ["error", "fail", "fixed", "known", "unavailable", "unsupported"]
    assert statuses == sorted(statuses, key=statuses.index), "a status comes up twice"


def test_statuses_can_be_told_apart_without_colour():
    assert set(GLYPHS) == set(Status)
    assert len(set(GLYPHS.values())) == len(Status)


def test_a_recorded_reason_is_said_once_with_every_check_that_it_speaks_of(results):
    changed = copy.deepcopy(results)
    for cell in changed["cells"]:
        if cell["scheme"] == "reduced" and cell["scene"] == "heavy_top[moderate]":
            for verdict in cell["verdicts"]:
                wrong = {"status": "known", "measured": 2.0, "allowed": 1.0}
                verdict.update(**wrong, message=f"{verdict['observable']} is off; known: it squints")
    (finding,) = [f for f in told(changed, Status.KNOWN) if f.sentence == "it squints"]
    assert finding.where == "pybullet reduced on heavy_top[moderate]"
    off = {
        (v["check"], v["observable"])
        for c in changed["cells"]
        for v in c["verdicts"]
        if "squints" in v["message"]
    }
    counts = finding.about.removeprefix("seen in ").split(", ")
    kinds = [check for check, _ in off]
    assert {tuple(part.split(" of ")) for part in counts} == {(str(kinds.count(k)), k) for k in kinds}
    assert len(set(kinds)) > 1
    assert " at worst, dt " in finding.numbers
