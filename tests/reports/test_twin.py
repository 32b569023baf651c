"""Twins: who is held against whom, how closely, and who is to blame."""

import re
from dataclasses import replace

import numpy as np
import pytest
from poinsot.reports import twin
from poinsot.reports.cell import Cell
from poinsot.reports.deviations import Deviation
from poinsot.reports.growth import growth
from poinsot.reports.judge import judge
from poinsot.reports.verdict import Status, ladder_of
from poinsot.scenarios import observables
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.registry import scenes
from poinsot.scenarios.scene import Scene
from poinsot.scenarios.trajectory import Trajectory

SCENE = scenes()["free_symmetric_top[oblate]"]
ALLOWED = 1e-12 + 1e-13 * growth(SCENE)


@pytest.fixture
def run(ahead):
    """A run of an engine, its ω larger by a part."""

    def make(engine, off=0.0, scene=SCENE, **changes):
        made = ahead(scene, 1e-3, engine=engine, **changes)
        scale = observables.omega().scale(scene, scene.truth(scene, made.t))
        omega = made.omega.copy()
        omega[70] += off * scale / np.sqrt(3)
        return replace(made, omega=omega)

    return make


def checked(*runs, scene=SCENE, **arguments):
    verdicts = twin.check([Cell.of(made, {scene.full_name: scene}) for made in runs], **arguments)
    return {v.engine: v for v in verdicts}


def test_what_is_allowed_is_rounding_and_its_growth():
    # A kick along the axis turns the body further by (kick)·T, in units of 1e-9 of the largest ω: 5 · 10.
    assert pytest.approx(1e-12 + 1e-13 * 50, rel=1e-2) == ALLOWED


@pytest.mark.parametrize(("off", "status"), [(0.0, "pass"), (0.98, "pass"), (1.02, "fail"), (1e6, "fail")])
def test_two_are_held_against_each_other(run, off, status):
    found = checked(run("alpha"), run("beta", off * ALLOWED))
    assert {v.status.value for v in found.values()} == {status}
    for verdict, other in ((found["alpha"], "beta"), (found["beta"], "alpha")):
        assert verdict.measured == pytest.approx(off * ALLOWED, rel=1e-3)
        assert verdict.allowed == pytest.approx(ALLOWED)
        assert (verdict.check, verdict.observable, verdict.unit) == ("twin", "state", "1")
        assert f"from its twin {other} own in {'omega' if off else ''}" in verdict.message
    assert found["beta"].at == (run("alpha").t[70] if off else 0.0)


@pytest.mark.parametrize("name", ["orientation", "position"])
def test_every_state_is_compared(run, name):
    alpha, beta = run("alpha"), run("beta")
    moved = {
        "orientation": {"quaternion": alpha.quaternion[:, :, [1, 0, 2, 3]]},
        "position": {"position": alpha.position * (1 + 1e-9)},
    }[name]
    assert f" in {name}, " in checked(replace(alpha, **moved), beta)["beta"].message


@pytest.mark.parametrize("wrong", ["alpha", "beta", "gamma"])
def test_of_three_only_the_wrong_one_fails(run, wrong):
    found = checked(*(run(name, 1e-9 if name == wrong else 0.0) for name in ("alpha", "beta", "gamma")))
    assert [name for name, v in found.items() if v.status is Status.FAIL] == [wrong]


def test_of_four_two_wrong_ones_do_not_outvote_the_others(run):
    off = {"alpha": 0.0, "beta": 0.0, "gamma": 1e-9, "delta": 2e-9}
    found = checked(*(run(name, x) for name, x in off.items()))
    assert {name for name, v in found.items() if v.status is Status.FAIL} >= {"gamma", "delta"}


def test_an_engine_is_no_twin_of_itself(run):
    assert checked(run("alpha", scheme="a"), run("alpha", 1e-3, scheme="b")) == {}
    assert checked(run("alpha")) == {}
    # Nor is it outvoted by its own two schemes.
    found = checked(run("alpha", scheme="a"), run("beta"), run("beta", scheme="b"))
    assert all("from its twin alpha" in v.message for name, v in found.items() if name == "beta")


@pytest.mark.parametrize("changes", [{"twin": ""}, {"twin": "another"}, {"dt": 2e-3, "steps": 5000}])
def test_only_the_same_scheme_at_the_same_step_is_a_twin(run, changes):
    other = run("beta", 1e-3)
    other = replace(other, provenance=replace(other.provenance, **changes))
    assert [v for v in judge([run("alpha"), other], known=()) if v.check == "twin"] == []


def test_schemes_without_a_twin_name_are_no_twins(run):
    pair = [run("alpha", twin=""), run("beta", 1e-3, twin="")]
    assert [v for v in judge(pair, known=()) if v.check == "twin"] == []


def test_a_suspect_is_not_held_against_the_others(run):
    suspects = {ladder_of(run("beta").provenance)}
    found = checked(run("alpha"), run("beta", 1e-9), suspects=suspects)
    assert found["alpha"].status is Status.PASS
    said = "no twin check: every engine with the same scheme fails checks of its own, or as is on record"
    assert found["alpha"].message == said
    assert found["beta"].status is Status.FAIL
    # Among three the sound ones are still held against each other.
    three = checked(run("alpha"), run("beta", 1e-9), run("gamma", 1e-9), suspects=suspects)
    assert three["alpha"].status is three["gamma"].status is Status.FAIL
    assert three["beta"].status is Status.PASS


def test_the_judge_suspects_who_fails_a_check_of_its_own(run):
    beta = run("beta", 1e-9)
    wrong = replace(beta, provenance=replace(beta.provenance, setup=beta.provenance.setup | {"dt": 2e-3}))
    failed = {(v.engine, v.check) for v in judge([run("alpha"), wrong], known=()) if v.status is Status.FAIL}
    assert failed == {("beta", "setup"), ("beta", "twin")}


def test_of_two_that_differ_only_the_one_whose_samples_do_not_follow_fails(run):
    sound = ladder_of(run("alpha").provenance)
    found = checked(run("alpha"), run("beta", 1e-9), follows=lambda ladder: ladder == sound)
    assert found["alpha"].status is Status.PASS
    assert found["alpha"].message.endswith("only this one's samples follow from one another")
    assert found["beta"].status is Status.FAIL
    assert found["beta"].message.endswith("; its samples follow from one another, these do not")


@pytest.mark.parametrize("sound", [True, False])
def test_where_both_or_neither_of_two_follow_both_fail_and_one_is_meant(run, sound):
    found = checked(run("alpha"), run("beta", 1e-9), follows=lambda ladder: sound)
    for verdict in found.values():
        assert verdict.status is Status.FAIL
        assert verdict.message.endswith("; one of the two is wrong: nothing here tells which")


def test_two_that_agree_do_not_outvote_the_one_whose_samples_follow(run):
    runs = [run("alpha"), run("beta", 1e-9), run("gamma", 1e-9)]
    sound = ladder_of(runs[0].provenance)
    found = checked(*runs, follows=lambda ladder: ladder == sound)
    assert {name for name, v in found.items() if v.status is Status.FAIL} == {"beta", "gamma"}


def test_where_twins_agree_or_suspects_alone_differ_nobodys_samples_are_asked_for(run):
    def follows(ladder):
        raise AssertionError

    assert {v.status for v in checked(run("alpha"), run("beta"), follows=follows).values()} == {Status.PASS}
    suspects = {ladder_of(run("beta").provenance)}
    assert checked(run("alpha"), run("beta", 1e-9), suspects=suspects, follows=follows)
    assert checked(run("alpha"), run("beta", 1e-9), known=[KNOWN], suspects=suspects, follows=follows)


def test_the_judge_acquits_the_engine_whose_samples_follow(run):
    pytest.importorskip("pinocchio")
    from poinsot.adapters.pinocchio_ import Pinocchio
    from poinsot.adapters.simulate import simulate

    right, _ = simulate(SCENE, Pinocchio, Pinocchio.schemes[0], SCENE.dt)
    later = replace(right.provenance, engine="beta")
    wrong = replace(right, omega=right.omega * (1 + 1e-9), provenance=later)
    found = {v.engine: v.status for v in judge([right, wrong], known=()) if v.check == "twin"}
    assert found == {"pinocchio": Status.PASS, "beta": Status.FAIL}


def test_what_is_no_number_is_not_near(run):
    alpha, beta = run("alpha"), run("beta")
    omega = beta.omega.copy()
    omega[70] = np.nan
    found = checked(alpha, replace(beta, omega=omega))
    assert {v.status for v in found.values()} == {Status.FAIL}
    assert {v.at for v in found.values()} == {alpha.t[70]}


KNOWN = Deviation(SCENE.full_name, "beta", "own", ">=1,<2", "twin", "state", 2e-9, "it rounds")


@pytest.mark.parametrize(
    ("off", "change", "status"),
    [
        (1e-9, {}, "known"),
        (3e-9, {}, "fail"),  # beyond the bound
        (1e-9, {"versions": ">=2"}, "fail"),
        (1e-9, {"engine": "gamma"}, "fail"),
        (1e-9, {"dt": 1e-4}, "fail"),
        (1e-9, {"check": "truth"}, "fail"),
    ],
)
def test_what_is_known_of_its_only_twin_is_not_held_against_an_engine(run, off, change, status):
    found = judge([run("alpha"), run("beta", off)], known=[replace(KNOWN, **change)])
    found = {v.engine: v.status.value for v in found if v.check == "twin"}
    assert found == {"alpha": status, "beta": status}


def test_a_known_deviation_of_a_twin_is_named(run):
    alpha, _ = judge([run("alpha"), run("beta", 1e-9)], known=[KNOWN])[-2:]
    assert alpha.engine == "alpha"
    assert alpha.message.endswith("known of beta own: it rounds")


def chaotic(sensitivity):
    """A mass that swings as sin(sensitivity · v0 · t): a kick of 1e-9 grows by so much."""

    def truth(scene, t):
        x = np.sin(sensitivity * scene.v0[0] * t)[:, None]
        at, none = np.zeros((len(t), 1, 3)), np.zeros((len(t), 1, 3))
        at[:, 0, :1] = x
        return Trajectory(t, at, np.tile([0.0, 0.0, 0.0, 1.0], (len(t), 1, 1)), none, none, x, 0 * x)

    body = Body("mass", 1.0, diagonal(1.0, 1.0, 1.0), (Joint("x", "slide", (1.0, 0.0, 0.0)),))
    return Scene("chaos", "", "", (body,), (0.0,), (1.0,), 1.0, 1000, truth, (observables.position(),))


def test_where_rounding_alone_separates_twins_there_is_no_check(run, ahead):
    for sensitivity, status in ((1e5, "fail"), (1e7, "pass")):
        scene = chaotic(sensitivity)
        pair = [ahead(scene, 1e-3, c=c, engine=engine) for engine, c in (("alpha", 0.0), ("beta", 1e-9))]
        found = checked(*pair, scene=scene)
        assert {v.status.value for v in found.values()} == {status}
    said = r"no twin check: a kick grows 9\.\d+e\+06-fold, more than 1e\+06; rounding alone separates twins"
    assert re.fullmatch(said, found["alpha"].message)
    assert found["alpha"].measured is None
