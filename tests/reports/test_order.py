"""Order and limit: what a ladder of steps must show, and what it must not let pass."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reports import order
from poinsot.reports.cell import Cell
from poinsot.reports.verdict import Status
from poinsot.scenarios.registry import scenes

SCENE = scenes()["free_symmetric_top[oblate]"]
KNOWN = {SCENE.full_name: SCENE}
STEPS = (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4)
STATES = [observable.name for observable in SCENE.observables if observable.kind == "state"]


def checked(runs, scene=SCENE):
    return order.check([Cell.of(run, {scene.full_name: scene}) for run in runs])


def orders(verdicts):
    return {v.observable: v for v in verdicts if v.check == "order"}


def limits(verdicts):
    return {v.observable.removesuffix(", limit"): v for v in verdicts if v.check == "truth"}


@given(st.floats(0.5, 6.0), st.floats(1e-3, 1e3), st.integers(3, 9))
def test_the_fit_of_a_power_is_its_exponent(power, constant, steps):
    dts = 0.1 / 2.0 ** np.arange(steps)
    found = order.fit(dts, constant * dts**power)
    assert found.order == pytest.approx(power, abs=1e-12)
    assert found.uncertainty < 1e-12
    assert found.steps == steps


def test_the_uncertainty_is_the_standard_error_of_the_slope():
    dts, rng = 0.1 / 2.0 ** np.arange(5), np.random.default_rng(0)
    fits = [order.fit(dts, dts * np.exp(0.1 * rng.normal(size=5))) for _ in range(4000)]
    spread = np.std([found.order for found in fits])
    # Both are estimates of one number; 4000 draws settle either to a few percent.
    assert np.sqrt(np.mean([found.uncertainty**2 for found in fits])) == pytest.approx(spread, rel=0.05)


@given(st.integers(1, 4), st.integers(5, 7), st.integers(0, 2**32 - 1))
def test_the_limit_of_any_error_of_that_order_is_exact(power, steps, seed):
    coefficients = np.random.default_rng(seed).uniform(-1, 1, size=(steps - 1, 3))
    dts = 0.1 / 2.0 ** np.arange(steps)
    values = [2.0 + sum(c * (dt / 0.1) ** (power + k) for k, c in enumerate(coefficients)) for dt in dts]
    limit, before = order.extrapolated(dts, values, power)
    # Weights of an extrapolation over halved steps add up to less than 10 in size.
    assert limit == pytest.approx(np.full(3, 2.0), abs=1e-13)
    assert np.abs(before - 2.0).max() > np.abs(limit - 2.0).max()


@pytest.mark.parametrize(("true", "declared"), [(1, 1), (2, 2), (4, 4)])
def test_a_scheme_of_its_declared_order_passes(ahead, true, declared):
    verdicts = checked([ahead(SCENE, dt, true, c=1e-3 / STEPS[0] ** true) for dt in STEPS])
    assert {v.status for v in verdicts} == {Status.PASS}
    assert sorted(orders(verdicts)) == sorted(limits(verdicts)) == sorted(STATES)
    for verdict in orders(verdicts).values():
        assert f"declared {declared}" in verdict.message
        assert verdict.measured == pytest.approx(0, abs=0.01)
        assert (verdict.allowed, verdict.dt) == (0.25, STEPS[-1])


@pytest.mark.parametrize(("true", "status"), [(1, "fail"), (2, "pass"), (3, "fail"), (4, "pass")])
def test_a_scheme_may_be_of_two_orders(ahead, true, status):
    runs = [ahead(SCENE, dt, true, c=1e-3 / STEPS[0] ** true) for dt in STEPS]
    runs = [replaced(run, order=2, twin="RK4 of body velocities") for run in runs]
    assert {v.status.value for v in orders(checked(runs)).values()} == {status}


def test_what_is_of_higher_order_may_lie_in_round_off_on_a_ladder_of_the_lower(ahead):
    runs = [ahead(SCENE, dt, 4, c=1e-12 / STEPS[0] ** 4) for dt in STEPS]
    for twin, status in (("RK4 of body velocities", Status.UNSUPPORTED), ("own", Status.FAIL)):
        found = orders(checked([replaced(run, order=2, twin=twin) for run in runs]))
        assert found["orientation"].status is status, found["orientation"].message


@pytest.mark.parametrize(("true", "declared"), [(1, 2), (2, 1), (4, 3), (1, 4)])
def test_a_scheme_of_another_order_fails_be_it_lower_or_higher(ahead, true, declared):
    constant = 1e-3 / STEPS[0] ** true
    verdicts = orders(checked([replaced(ahead(SCENE, dt, true, c=constant), order=declared) for dt in STEPS]))
    assert verdicts
    for verdict in verdicts.values():
        assert verdict.status is Status.FAIL
        assert verdict.measured == pytest.approx(abs(true - declared), abs=0.01)
        assert re.search(rf"fitted order ({true - 1}\.99|{true}\.0)\d* ± 0.00. over 5 steps", verdict.message)
        assert f"declared {declared}" in verdict.message


@pytest.mark.parametrize(("power", "status"), [(0.8, "pass"), (1.2, "pass"), (0.7, "fail"), (1.3, "fail")])
def test_a_quarter_of_an_order_is_granted(ahead, power, status):
    verdicts = orders(checked([replaced(ahead(SCENE, dt, power, c=1e-2), order=1) for dt in STEPS]))
    assert {v.status.value for v in verdicts.values()} == {status}


def replaced(run, **changes):
    return replace(run, provenance=replace(run.provenance, **changes))


@pytest.mark.parametrize("fewer", range(5))
def test_fewer_than_five_steps_are_no_ladder(ahead, fewer):
    assert checked([ahead(SCENE, dt) for dt in STEPS[:fewer]]) == []


def test_a_step_counts_once_however_often_it_was_run(ahead):
    runs = [ahead(SCENE, dt) for dt in STEPS]
    assert checked([runs[0]] * 5) == []
    assert checked([*runs, *runs]) == checked(runs)


def test_the_order_of_the_runs_does_not_matter(ahead):
    runs = [ahead(SCENE, dt) for dt in STEPS]
    assert checked(runs[::-1]) == checked(runs)


def test_steps_at_round_off_are_not_fitted(ahead):
    # Of order four with so small a constant that the last steps drown in noise of the size of round-off.
    rng = np.random.default_rng(2)
    runs = [noisy(ahead(SCENE, dt, 4, c=4.0), rng, 1e-14) for dt in STEPS]
    verdict = orders(checked(runs))["orientation"]
    assert verdict.status is Status.PASS
    assert "over 3 steps from 0.004 s to 0.001 s, declared 4" in verdict.message


def test_too_few_steps_clear_of_round_off_are_said_to_be_too_few(ahead):
    runs = [noisy(ahead(SCENE, dt, 4, c=0.3), np.random.default_rng(2), 1e-14) for dt in STEPS]
    verdict = orders(checked(runs))["orientation"]
    assert verdict.status is Status.FAIL
    assert verdict.message == "only 2 of 5 steps are clear of round-off, expected 3 or more"


def noisy(run, rng, size):
    quaternion = run.quaternion + size * rng.normal(size=run.quaternion.shape)
    return replace(run, quaternion=quaternion / np.linalg.norm(quaternion, axis=2, keepdims=True))


def test_noise_that_does_not_fall_with_the_step_is_no_order(ahead):
    rng = np.random.default_rng(2)
    verdicts = orders(checked([noisy(ahead(SCENE, dt, 1, c=0.0), rng, 1e-6) for dt in STEPS]))
    assert verdicts["orientation"].status is Status.FAIL
    assert verdicts["omega"].status is Status.PASS


def test_without_any_error_there_is_no_order(ahead):
    verdicts = orders(checked([ahead(SCENE, dt, c=0.0) for dt in STEPS]))
    assert verdicts
    for verdict in verdicts.values():
        assert verdict.status is Status.PASS
        assert verdict.message == "exact to round-off at all 5 steps: there is no order to measure"


def test_no_error_where_the_scheme_has_one_is_too_good(ahead):
    runs = [ahead(SCENE, dt, c=0.0, twin="semi-implicit Euler") for dt in STEPS]
    verdicts = orders(checked(runs))
    assert verdicts["orientation"].status is verdicts["omega"].status is Status.FAIL
    assert verdicts["position"].status is Status.PASS  # every scheme is exact in it: C is 0
    assert "although the scheme's own error is 0.36 rad at dt 0.004 s" in verdicts["orientation"].message


def test_where_a_schemes_own_motion_is_exact_being_exact_is_right(ahead):
    scene = scenes()["co2_chain[translation]"]
    runs = [ahead(scene, dt, c=0.0, twin="semi-implicit Euler") for dt in scene.ladders[1]]
    assert {v.status for v in checked(runs, scene)} == {Status.PASS}


@pytest.mark.parametrize("off", [1e-7, 1e-5])
def test_a_limit_that_is_not_the_truth_fails_behind_any_truncation(ahead, off):
    # The error at the finest step is 10⁴ to 10⁶ times larger: only the limit shows what is off.
    rng = np.random.default_rng(4)
    runs = [ahead(SCENE, dt, c=1.0) for dt in STEPS]
    shift = off * rng.normal(size=runs[0].omega.shape)
    verdicts = checked([replace(run, omega=run.omega + shift) for run in runs])
    assert limits(verdicts)["omega"].status is Status.FAIL
    assert limits(verdicts)["orientation"].status is Status.PASS
    assert {v.status for v in orders(verdicts).values()} == {Status.PASS}
    assert limits(verdicts)["omega"].measured == pytest.approx(
        np.linalg.norm(shift[:, 0], axis=1).max(), rel=0.2
    )


@pytest.mark.parametrize(
    ("declared", "times", "status"), [(4, 1.9, "pass"), (4, 2.1, "fail"), (1, 7.2, "pass"), (1, 7.4, "fail")]
)
def test_a_limit_is_granted_the_round_off_of_the_worst_step_as_it_weighs_it(ahead, declared, times, status):
    runs = [ahead(SCENE, dt, declared, c=0.0) for dt in STEPS]
    omega = next(observable for observable in SCENE.observables if observable.name == "omega")
    noise = max(Cell.of(run, KNOWN).round_off(omega) for run in runs)
    shift = np.array([times * noise, 0.0, 0.0])
    verdict = limits(checked([replace(run, omega=run.omega + shift) for run in runs]))["omega"]
    assert verdict.status.value == status


def test_a_limit_says_when_and_how_far_the_finest_step_was(ahead):
    runs = [ahead(SCENE, dt, c=1.0) for dt in STEPS]
    late = [replace(run, position=np.where(run.t[:, None, None] == 6.0, 9.9, run.position)) for run in runs]
    verdict = limits(checked(late))["position"]
    assert (verdict.status, verdict.at) == (Status.FAIL, 6.0)
    assert "at dt = 0 from the truth; the finest step alone is at 1." in verdict.message


def test_only_states_have_an_order(ahead):
    assert {v.observable.removesuffix(", limit") for v in checked([ahead(SCENE, dt) for dt in STEPS])} == set(
        STATES
    )


def test_a_limit_leaves_out_a_step_that_is_near_to_a_finer_one(ahead):
    steps = (0.01, 0.005, 0.0025, 0.001, 0.000625)
    few, crowded = (
        limits(checked([noisy(ahead(SCENE, dt, 4), np.random.default_rng(2), 1e-14) for dt in dts]))
        for dts in (steps, (*steps[:3], 0.00125, *steps[3:]))
    )
    for verdict in few.values():
        assert crowded[verdict.observable.removesuffix(", limit")].allowed == verdict.allowed


def test_of_steps_that_are_all_near_to_one_another_a_limit_takes_all(ahead):
    verdicts = limits(checked([ahead(SCENE, dt) for dt in (1e-3, 9.6e-4, 9.2e-4, 8.8e-4, 8.4e-4)]))
    assert all(verdict.status is Status.PASS for verdict in verdicts.values())


def test_steps_coarser_than_the_scenes_own_ladder_do_not_count(ahead):
    coarse = [noisy(ahead(SCENE, dt), np.random.default_rng(2), 0.1) for dt in (0.02, 0.01)]
    runs = [ahead(SCENE, dt) for dt in STEPS]
    assert checked([*coarse, *runs]) == checked(runs)
    (verdict,) = checked([*coarse, *runs[1:]])
    assert (verdict.check, verdict.status, verdict.dt) == ("order", Status.UNSUPPORTED, STEPS[-1])
    assert verdict.message == (
        "order not measured: 4 of 6 steps are within 0.004 s, up to which this scene tells it; 5 are needed"
    )


def test_a_scene_without_a_ladder_takes_any_steps(ahead):
    own = replace(SCENE, ladders={})
    assert {v.check for v in checked([ahead(own, 10 * dt) for dt in STEPS], own)} == {"order", "truth"}
