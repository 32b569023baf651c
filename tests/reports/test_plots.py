"""Figures as data: every number in its place, and nothing dropped without a word."""

import base64
import copy
import json
from dataclasses import replace

import numpy as np
import plotly.graph_objects
import pytest
from poinsot.reports.digest import Digest
from poinsot.reports.plots import FAR, TRUTH_POINTS, Motion, cost_figure, motion_figures

SCENE = "free_symmetric_top[oblate]"


def figure(results, scene=SCENE):
    rows = [row for row in results["work_precision"] if row["scene"] == scene]
    return cost_figure(rows, Digest(results).columns)


def view(results, observable="orientation [rad]", against="run time"):
    """What a reader sees of one observable against one axis, put together as the page does it."""
    found = figure(results)
    (nth,) = [n for n, axis in enumerate(found["axes"]) if axis["label"] == against]
    (of,) = [each for each in found["observables"] if each["label"] == observable]
    key = found["axes"][nth]["key"]
    data = [_seen(line, key, errors) for line, errors in zip(found["lines"], of["errors"], strict=True)]
    data = [line for line in data if line["x"]]
    return {"data": data, "front": of["fronts"][nth], "note": of["notes"][nth]}


def _seen(line, key, errors):
    rows = zip(line["x"][key], errors, line["told"], strict=True)
    x, y, told = zip(*[row for row in rows if None not in row[:2]] or [[()] * 3], strict=True)
    return {**line["trace"], "x": x, "y": y, "customdata": told}


def unpacked(curve):
    data = np.frombuffer(base64.b64decode(curve["data"]), dtype="<u2").reshape(-1, curve["n"])
    columns = list(data / 65535)
    for k in curve["even"]:
        columns.insert(k, np.linspace(0.0, 1.0, curve["n"]))
    low, high = np.array(curve["low"])[:, None], np.array(curve["high"])[:, None]
    return (low + np.array(columns) * (high - low)).T


def test_each_scheme_is_one_line_over_its_steps_with_its_configuration_on_hover(results):
    lines = {line["name"]: line for line in view(results)["data"]}
    assert len(lines) == 10
    rk4 = lines["mujoco RK4"]
    rows = [
        row
        for row in results["work_precision"]
        if (row["scene"], row["scheme"], row["observable"]) == (SCENE, "RK4", "orientation")
    ]
    rows.sort(key=lambda row: row["dt"])
    np.testing.assert_allclose(rk4["x"], [row["seconds_min"] for row in rows], rtol=1e-5)
    np.testing.assert_allclose(rk4["y"], [row["error"] for row in rows], rtol=1e-5)
    (line,) = (line for line in figure(results)["lines"] if line["trace"]["name"] == "mujoco RK4")
    np.testing.assert_allclose(line["least"], [row["seconds_min"] for row in rows], rtol=1e-5)
    told = [(float(dt), steps) for dt, steps, _ in rk4["customdata"]]
    assert told == [(row["dt"], row["steps"]) for row in rows]
    assert rk4["customdata"][0][2].split("<br>")[0].endswith("10 repeats")
    assert rk4["customdata"][0][2].endswith("× real time")
    assert "mujoco 4.0.0, RK4" in [line["who"] for line in figure(results)["lines"]]


def test_plotly_itself_accepts_every_line(results):
    found = figure(results)
    for of in found["observables"]:
        for axis in found["axes"]:
            data = view(results, of["label"], axis["label"])["data"]
            assert len(plotly.graph_objects.Figure(data=data).data) == len(data) > 0


def test_no_point_lies_below_the_front_and_the_front_falls(results):
    found = view(results)
    points = [point for line in found["data"] for point in zip(line["x"], line["y"], strict=True)]
    front = list(zip(found["front"]["x"], found["front"]["y"], strict=True))
    assert set(front) <= set(points)
    assert sorted(front) == sorted(front, key=lambda point: -point[1]) == front
    for x, y in points:
        assert any(best_x <= x and best_y <= y for best_x, best_y in front)
    assert view(results, against="step")["front"] is None


def test_schemes_of_an_engine_share_its_colour_and_differ_in_sign_and_dash(results):
    lines = view(results)["data"]
    looks = {(line["meta"], line["marker"]["symbol"], line["line"]["dash"]) for line in lines}
    assert len(looks) == len(lines)
    assert len({line["meta"] for line in lines}) == 3


def test_a_run_that_was_not_timed_is_drawn_against_the_step(remade):
    untimed = figure(remade(timed=False))
    assert not untimed["timed"]
    assert [axis["label"] for axis in untimed["axes"]] == ["step"]
    assert "not timed" in untimed["lines"][0]["told"][0][2]


def test_what_has_no_place_on_logarithmic_axes_is_named(results):
    changed = copy.deepcopy(results)
    rows = [r for r in changed["work_precision"] if (r["scene"], r["observable"]) == (SCENE, "orientation")]
    rows[0]["error"], rows[1]["error"], rows[2]["seconds_min"] = 0.0, None, None
    found = view(changed)
    assert "error exactly 0: mujoco Euler (dt 2.00e-03 s)" in found["note"]
    assert "error not finite: mujoco Euler (dt 1.00e-03 s)" in found["note"]
    assert "not timed: mujoco Euler (dt 5.00e-04 s)" in found["note"]
    assert len(found["data"][0]["x"]) == 2
    against_step = view(changed, against="step")
    assert len(against_step["data"][0]["x"]) == 3
    assert "not timed" not in against_step["note"], "the step needs no time"
    json.dumps(figure(changed), allow_nan=False)


def test_a_time_taken_at_another_step_is_told_as_that(results):
    changed = copy.deepcopy(results)
    rows = [r for r in changed["work_precision"] if (r["scene"], r["observable"]) == (SCENE, "orientation")]
    rows[0] |= {"scaled": True, "timed_steps": 250}
    told = {dt: time for dt, _, time in view(changed)["data"][0]["customdata"]}
    assert [dt for dt, time in told.items() if "scaled" in time] == ["2.00e-03"]
    assert "<br>scaled from 250 steps of another dt<br>" in told["2.00e-03"]


def test_a_step_that_came_to_no_motion_is_named_as_that_whether_timed_or_not(results):
    changed = copy.deepcopy(results)
    rows = [r for r in changed["work_precision"] if (r["scene"], r["observable"]) == (SCENE, "orientation")]
    for row, seconds in zip(rows, (None, 1.0), strict=False):
        row |= {"error": None, "message": "its process died", "seconds_median": seconds}
    said = "no motion: mujoco Euler (dt 2.00e-03 s), mujoco Euler (dt 1.00e-03 s)"
    assert said in view(changed)["note"]
    assert said in view(changed, against="step")["note"]


def test_each_error_stands_at_its_own_time_where_observables_were_timed_apart(results):
    changed = copy.deepcopy(results)
    rows = [r for r in changed["work_precision"] if (r["scene"], r["observable"]) == (SCENE, "orientation")]
    for row in rows:
        row["seconds_min"] *= 10
    for observable, factor in (("orientation [rad]", 10), ("omega [rad/s]", 1)):
        for now, before in zip(
            view(changed, observable)["data"], view(results, observable)["data"], strict=True
        ):
            np.testing.assert_allclose(now["x"], factor * np.array(before["x"]), rtol=1e-5)
            assert now["y"] == before["y"]


def test_what_observables_share_is_said_once(results):
    text = json.dumps(figure(results))
    for line in figure(results)["lines"]:
        assert text.count(f'"{line["who"]}"') == 1
    assert text.count(" repeats") == sum(len(line["told"]) for line in figure(results)["lines"])


def test_a_scene_without_rows_has_no_figure(results):
    assert figure(results, "tides") is None


def test_pictures_hold_the_truth_densely_and_the_runs_at_their_samples(results, moved):
    (motion,) = moved((SCENE,))
    tip, _, wave = motion_figures(motion, Digest(results).columns)
    assert (tip["title"], tip["axes"], tip["equal"]) == ("Tip of the symmetry axis e3", ["x", "y", "z"], True)
    assert not wave["equal"]
    truth, *runs = tip["curves"]
    assert (truth["name"], truth["n"], truth["engine"]) == ("truth", TRUTH_POINTS, -1)
    exact = motion.scene.truth(motion.scene, np.linspace(0, 10, TRUTH_POINTS))
    expected = np.column_stack([exact.t, motion.scene.pictures[0].points(motion.scene, exact)])
    # Half of a 65535th of the range.
    np.testing.assert_allclose(unpacked(truth), expected, atol=10 / 65535)
    np.testing.assert_allclose(unpacked(truth)[:, 1:], expected[:, 1:], atol=1e-5)
    assert [run["name"] for run in runs][:2] == ["mujoco Euler", "mujoco implicit"]
    assert truth["even"] == runs[0]["even"] == [0], "times are told by their ends"
    samples = unpacked(runs[0])[:, 0]
    np.testing.assert_allclose(samples * 50, np.rint(samples * 50), atol=1e-2)
    corners = [expected[:, 1:].min(axis=0), expected[:, 1:].max(axis=0)]
    np.testing.assert_allclose(tip["box"], corners, atol=1e-5)


def test_a_run_that_explodes_is_cut_off_where_it_leaves_and_says_so(results, moved):
    (motion,) = moved((SCENE,))
    _, cone, _ = motion_figures(motion, Digest(results).columns)
    (lost,) = [curve for curve in cone["curves"] if "maximal" in curve["name"]]
    assert lost["name"].startswith("pybullet maximal, leaves at 4.0")
    points = unpacked(lost)
    assert points[-1, 0] < 4.1
    assert np.abs(points[:, 1:3]).max() <= FAR * 2.01


def test_one_curve_of_low_order_one_of_high_order_and_what_stands_apart_are_shown_at_first(results, moved):
    (motion,) = moved((SCENE,))
    _, cone, _ = motion_figures(motion, Digest(results).columns)
    shown = [curve["name"] for curve in cone["curves"] if curve["shown"]]
    assert shown[:2] == ["truth", "mujoco Euler"]
    assert any(name.startswith("pybullet maximal, leaves at 4.0") for name in shown)
    calm = Motion(motion.scene, tuple(run for run in motion.runs if run.provenance.scheme != "maximal"))
    for picture in motion_figures(calm, Digest(results).columns):
        shown = [curve["name"] for curve in picture["curves"] if curve["shown"]]
        assert shown == ["truth", "mujoco Euler", "pinocchio RKMK4"]


def test_a_box_that_ends_in_round_off_ends_at_zero(results, moved):
    (motion,) = moved((SCENE,))

    def almost(of, t):
        exact = motion.scene.truth(of, t)
        return replace(exact, omega=np.where(exact.omega < 0.2, 1.1e-16, exact.omega))

    _, cone, _ = motion_figures(Motion(replace(motion.scene, truth=almost)), Digest(results).columns)
    assert cone["box"][0] == [0.0, 0.0, 5.0]


@pytest.mark.parametrize("height", [0.0, 3.0])
def test_a_motion_that_rests_can_be_drawn(results, moved, height):
    def still(motion):
        return replace(motion, omega=np.full_like(motion.omega, height))

    (motion,) = moved((SCENE,))
    scene = replace(motion.scene, truth=lambda of, t: still(motion.scene.truth(of, t)))
    resting = Motion(scene, tuple(still(run) for run in motion.runs))
    _, cone, _ = motion_figures(resting, Digest(results).columns)
    json.dumps(cone, allow_nan=False)
    assert cone["box"] == [[height] * 3] * 2
    for curve in cone["curves"]:
        assert "leaves" not in curve["name"]
        np.testing.assert_array_equal(unpacked(curve)[:, 1:], height)
