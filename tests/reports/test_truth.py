"""At a finite step: as far from the truth as the scheme itself, and no further."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from poinsot.reports import truth
from poinsot.reports.cell import Cell
from poinsot.reports.verdict import Status
from poinsot.scenarios.registry import scenes

FREE, CHAIN = scenes()["free_symmetric_top[oblate]"], scenes()["co2_chain[mixture]"]
#: A clock that is fast by this part.
FAST = 1e-3


def cell(run, scene):
    return Cell.of(run, {scene.full_name: scene})


def checked(run, scene):
    return {v.observable: v for v in truth.check(cell(run, scene))}


@pytest.fixture
def granting(ahead):
    """A scene that grants the scheme ``own`` so much of the error that it makes at 1 ms, and that run."""

    def make(share):
        run = ahead(FREE, 1e-3, c=FAST / 1e-3)
        made = cell(run, FREE)
        errors = [share * made.error(observable) / 1e-3 for observable in FREE.observables]
        return run, replace(FREE, errors={"own": tuple(errors)})

    return make


def test_the_recorded_error_is_granted_once_and_a_half(granting):
    for share, expected in ((0.67, {Status.PASS}), (0.66, {Status.FAIL})):
        run, scene = granting(share)
        verdicts = checked(run, scene)
        moving = {"orientation", "omega", "position", "Omega_b"}
        assert {verdicts[name].status for name in moving} == expected
        conserved = {"energy", "angular momentum", "momentum", "quaternion norm"}
        assert {v.observable for v in verdicts.values() if v.check == "truth"} == moving
        assert {v.observable for v in verdicts.values() if v.check == "invariant"} == conserved


def test_a_verdict_says_what_was_measured_allowed_and_when(granting):
    run, scene = granting(1.0)
    orientation, rate = (checked(run, scene)[name] for name in ("orientation", "Omega_b"))
    made = cell(run, scene)
    assert orientation.measured == pytest.approx(made.error(scene.observables[0]))
    assert orientation.allowed == pytest.approx(1.5 * orientation.measured, rel=1e-6)
    assert (orientation.unit, orientation.dt, orientation.at) == ("rad", 1e-3, 10.0)
    # A rate is a number of the whole run: there is no time at which it is worst.
    assert (rate.unit, rate.at) == ("rad/s", None)
    assert rate.measured == pytest.approx(FAST * rate_of(scene), rel=1e-9)
    assert "1.5 × " in orientation.message
    assert "·dt^1, the scheme's own error as recorded, and round-off are allowed" in orientation.message


def rate_of(scene):
    return next(o for o in scene.observables if o.name == "Omega_b").scale(scene, None)


def test_where_nothing_is_recorded_nothing_is_judged_and_that_is_said(ahead):
    run = ahead(FREE, 1e-3)
    assert set(checked(run, FREE)) == {o.name for o in FREE.observables if o.always}
    assert truth.without_constant(cell(run, FREE)) == [o.name for o in FREE.observables if not o.always]


def test_a_constant_does_not_hold_at_steps_coarser_than_its_ladder(ahead):
    for dt, judged in ((4e-3, True), (8e-3, False), (6.25e-5, True)):
        run = ahead(FREE, dt, twin="semi-implicit Euler")
        assert ("orientation" in checked(run, FREE)) is judged
        assert (truth.own_error(cell(run, FREE), FREE.observables[0]) is not None) is judged


def test_where_only_round_off_was_seen_only_round_off_is_allowed(ahead):
    run = ahead(FREE, 1e-3, c=0.0, twin="RKMK4", order=4)
    jittered = replace(run, position=run.position + 1e-16)
    assert checked(jittered, FREE)["position"].status is Status.PASS
    moved = replace(run, position=run.position + 1e-9)
    assert checked(moved, FREE)["position"].status is Status.FAIL


def own_motion(scene, dt, twin="semi-implicit Euler"):
    return scene.scheme_motion(scene, twin, dt, scene.sample_times())


def test_a_schemes_own_motion_passes_and_nothing_else_does(ahead):
    dt = 1e-3
    run = ahead(CHAIN, dt, c=0.0, twin="semi-implicit Euler")
    own = own_motion(CHAIN, dt)
    right = checked(replace(own, t=run.t, provenance=run.provenance), CHAIN)
    assert {v.status for v in right.values()} == {Status.PASS}
    assert {"position, scheme's own", "velocity, scheme's own"} <= set(right)
    # Half the error is no better: it is not that scheme's.
    between = replace(
        run, position=(run.position + own.position) / 2, velocity=(run.velocity + own.velocity) / 2
    )
    wrong = checked(between, CHAIN)
    assert wrong["position"].status is Status.PASS
    assert wrong["position, scheme's own"].status is wrong["velocity, scheme's own"].status is Status.FAIL
    assert "only round-off is allowed" in wrong["position, scheme's own"].message


def test_a_predicted_error_is_granted_as_it_is(ahead):
    dt = 1e-3
    run = ahead(CHAIN, dt, c=0.0, twin="semi-implicit Euler")
    own = own_motion(CHAIN, dt)
    beyond = {
        name: getattr(run, name) + 1.001 * (getattr(own, name) - getattr(run, name))
        for name in ("position", "velocity")
    }
    verdicts = checked(replace(run, **beyond), CHAIN)
    assert verdicts["position"].status is verdicts["velocity"].status is Status.FAIL
    assert "predicted in closed form" in verdicts["position"].message


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_distance_that_is_no_number_fails(ahead, value):
    run = ahead(FREE, 1e-3, twin="semi-implicit Euler")
    omega = run.omega.copy()
    omega[3, 0, 0] = value
    with np.errstate(invalid="ignore"):
        assert checked(replace(run, omega=omega), FREE)["omega"].status is Status.FAIL


def test_a_straight_flight_is_rounded_to_the_same_side_step_after_step():
    x, v, N = np.float64(0.6), np.float64(1.5 * 5e-4), 800
    for _ in range(N):
        x += v
    drift = abs(float(x - (Fraction(0.6) + N * Fraction(1.5 * 5e-4))))
    assert 3 * np.sqrt(N) * 2.2e-16 < drift < N / 2 * 2.2e-16


def test_round_off_grows_with_the_steps_and_with_a_kick(ahead):
    few, many = (cell(ahead(FREE, dt), FREE) for dt in (4e-3, 4e-3 / 100))
    orientation, _, position = FREE.observables[:3]
    # The walk of a hundred times as many steps goes ten times as far, an even drift a hundred times.
    for made, steps in ((few, 2500), (many, 250_000)):
        expected = 2.2e-16 * (3 * np.sqrt(steps) * 50 + steps / 2)
        assert made.round_off(orientation) == pytest.approx(expected, rel=0.02)
    assert few.round_off(position) / few.round_off(orientation) == pytest.approx(np.sqrt(14), rel=1e-9)
