"""What the reports say of a run as a whole: order, worst statuses, one sentence."""

import copy

import pytest
from poinsot.reference.errors import InputError
from poinsot.reports.digest import Digest
from poinsot.reports.verdict import Status


@pytest.fixture
def groups(results):
    digest = Digest(results)
    return {(group.scene, group.column.label): group for group in digest.groups.values()}


def test_a_group_has_the_worst_status_of_its_cells_and_checks(groups):
    assert groups["heavy_top[fast]", "pybullet maximal"].status is Status.ERROR
    assert groups["heavy_top[moderate]", "pybullet reduced"].status is Status.FAIL
    assert groups["co2_chain[mixture]", "mujoco implicitfast"].status is Status.FIXED
    assert groups["free_symmetric_top[oblate]", "mujoco discrete"].status is Status.KNOWN
    assert groups["co2_chain[mixture]", "pybullet maximal"].status is Status.UNSUPPORTED
    assert groups["heavy_top[fast]", "drake radau"].status is Status.UNAVAILABLE
    assert groups["heavy_top[fast]", "mujoco RK4"].status is Status.PASS


def test_a_check_that_could_not_be_made_marks_a_pass_but_does_not_replace_it(groups):
    passed = groups["heavy_top[fast]", "pybullet reduced"]
    assert (passed.status, passed.partial) == (Status.PASS, True)
    assert not groups["heavy_top[moderate]", "pybullet reduced"].partial, "a failure is not a partial pass"
    assert not groups["heavy_top[fast]", "mujoco RK4"].partial


def test_one_bad_verdict_in_a_cell_said_to_pass_is_not_hidden(results):
    changed = copy.deepcopy(results)
    changed["cells"][3]["verdicts"][2]["status"] = "fail"
    assert next(iter(Digest(changed).groups.values())).status is Status.FAIL


def test_schemes_stand_engine_by_engine_however_the_cells_come(results):
    # The second engine comes in between, as where a scene is not run in every scheme.
    changed = {**results, "cells": sorted(results["cells"], key=lambda cell: cell["scheme"])}
    engines = [column.engine for column in Digest(changed).columns]
    assert engines == sorted(engines, key=engines.index), "an engine's schemes are torn apart"
    assert [column.place[1] for column in Digest(changed).columns if column.engine == "mujoco"] == [
        0,
        1,
        2,
        3,
        4,
    ]


def test_two_versions_of_an_engine_are_two_columns_told_apart(results):
    changed = copy.deepcopy(results)
    for cell in changed["cells"][: len(changed["cells"]) // 2]:
        cell["engine_version"] = cell["engine_version"] and "0.1"
    labels = [column.label for column in Digest(changed).columns]
    assert "mujoco 0.1 RK4" in labels
    assert "mujoco 4.0.0 RK4" in labels
    assert len(set(labels)) == len(labels)


def test_the_main_cell_is_at_the_scenes_own_step_or_where_most_was_asked(results):
    digest = Digest(results)
    assert {group.main["dt"] for group in digest.groups.values() if group.main["verdicts"]} >= {1e-3}
    scenes = {name: {**words, "dt": 2.4e-3} for name, words in results["scenes"].items()}
    rk4 = [g for g in Digest({**results, "scenes": scenes}).groups.values() if g.column.scheme == "RK4"]
    assert {group.main["dt"] for group in rk4} == {2.5e-3}


def test_a_scene_that_only_the_cells_know_is_not_left_out(results):
    bare = Digest({**results, "scenes": {}})
    assert set(bare.scenes) == set(results["scenes"])
    assert len(bare.groups) == len(Digest(results).groups)


def test_the_headline_counts_and_names_what_is_wrong_but_not_what_is_known(results):
    digest = Digest(results)
    assert not digest.conforms
    assert f"{digest.counts[Status.PASS]} of {len(results['cells'])} cells pass" in digest.headline
    for name in ("pybullet maximal on heavy_top[fast]", "mujoco implicitfast on co2_chain[mixture]"):
        assert name in digest.headline
    assert digest.headline.index("maximal") < digest.headline.index("reduced"), (
        "an error comes before a failure"
    )
    assert "drake is not installed" in digest.headline
    assert "discrete" not in digest.headline


def test_a_clean_run_conforms_in_so_many_words(remade):
    changed = remade()
    changed["cells"] = [cell for cell in changed["cells"] if cell["scheme"] == "RK4"]
    assert Digest(changed).headline == f"The run conforms: all {len(changed['cells'])} cells pass."
    assert Digest({**changed, "cells": []}).headline == "Nothing was run: there are no cells to judge."


def test_known_deviations_and_missing_features_conform(remade):
    changed = remade()
    changed["cells"] = [c for c in changed["cells"] if c["status"] in ("pass", "known", "unsupported")]
    assert Digest(changed).headline.startswith("The run conforms: 4")


def test_results_of_another_schema_are_refused(results):
    with pytest.raises(InputError, match=r"got schema 'poinsot.results/2', expected 'poinsot.results/1'"):
        Digest({**results, "schema": "poinsot.results/2"})


def test_the_allowance_used_most_leaves_orders_out(groups):
    share, check = groups["heavy_top[moderate]", "pybullet reduced"].closest
    assert (share, check) == (pytest.approx(7.0), "truth of orientation")
    # RK4's measured order, 4 with 0.2 allowed, would lead everywhere.
    assert all(group.closest[0] < 1 for group in groups.values() if group.status is Status.PASS)
