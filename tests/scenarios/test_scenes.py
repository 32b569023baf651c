"""Every scene that ships, held to what it says of itself: new ones are found here without being named."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from poinsot.adapters.declared import declared
from poinsot.reference import equations_of_motion, quaternions
from poinsot.scenarios import co2_chain
from poinsot.scenarios.blows import Blow, at_work
from poinsot.scenarios.features import DETAILS, FEATURES, NEVER_BUILT
from poinsot.scenarios.forces import forces_on
from poinsot.scenarios.registry import scenes
from scipy.integrate import solve_ivp

EVERY = pytest.mark.parametrize("scene", scenes().values(), ids=lambda scene: scene.full_name)
#: The reference's equations of motion know no contact and no burning: such scenes have tests of their own.
UNTOUCHED = pytest.mark.parametrize(
    "scene",
    [scene for scene in scenes().values() if not scene.contacts and not scene.burning],
    ids=lambda scene: scene.full_name,
)
CHANNELS = ("position", "quaternion", "velocity", "omega", "joint_position", "joint_velocity")
EPSILON = np.finfo(float).eps
#: Scenes whose every rate is that of a phase; others test theirs in files of their own.
BY_PHASE = [
    scene for scene in scenes().values() if scene.name in ("free_symmetric_top", "heavy_top", "co2_chain")
]


def integrated(scene, links, t):
    """The scene's motion at ``t`` from the equations of motion of its bodies, by an eighth-order scheme."""
    places, nq = (
        [at_q for _, joint, at_q, _ in scene.slices() if joint.kind in ("free", "ball")],
        len(scene.q0),
    )

    def rates(_, state, pushed):
        q, v = state[:nq].copy(), state[nq:]
        for at in places:
            q[at][-4:] /= np.linalg.norm(q[at][-4:])
        forces = pushed(*(part[0] for part in equations_of_motion.link_motion(links, q[None], v[None])[::2]))
        a = equations_of_motion.accelerations(links, q, v, scene.gravity, forces=forces)
        return np.concatenate([equations_of_motion.coordinate_rates(links, q, v), a])

    found = np.tile(np.concatenate([scene.q0, scene.v0]), (len(t), 1))
    start = found[0]
    blows = [force for force in scene.forces if isinstance(force, Blow)]
    edges = sorted({0.0, t[-1], *(e for blow in blows for e in (blow.start, blow.end) if e < t[-1])})
    for begin, end in pairwise(edges):  # an integrator must not step over what sets in
        pushed, here = forces_on(scene.bodies, at_work(scene.forces, begin)), (t > begin) & (t <= end)
        at = np.unique([*t[here], end])
        run = solve_ivp(rates, (begin, end), start, "DOP853", at, args=(pushed,), rtol=1e-12, atol=1e-13).y.T
        found[here], start = run[: here.sum()], run[-1]
    q, v = found[:, :nq], found[:, nq:]
    for at in places:
        q[:, at][:, -4:] /= np.linalg.norm(q[:, at][:, -4:], axis=1, keepdims=True)
    return (*equations_of_motion.link_motion(links, q, v), *scalars(scene, q, v))


def scalars(scene, q, v):
    where = [(at_q, at_v) for _, joint, at_q, at_v in scene.slices() if joint.kind in ("hinge", "slide")]
    return (
        np.hstack([q[:, :0], *(q[:, at_q] for at_q, _ in where)]),
        np.hstack([v[:, :0], *(v[:, at_v] for _, at_v in where)]),
    )


@UNTOUCHED
def test_the_truth_is_the_motion_of_the_bodies_described(scene, links_of):
    # Two different derivations: closed forms against Kane's equations integrated from q0 and v0.
    fastest = max(1.0, np.abs(scene.v0).max())
    t = np.linspace(0.0, min(scene.duration, 0.3, 20 / fastest), 7)
    truth, found = scene.truth(scene, t), integrated(scene, links_of(scene), t)
    for name, expected in zip(CHANNELS, found, strict=True):
        got = getattr(truth, name)
        if name == "quaternion":
            apart = quaternions.rotation_vector(quaternions.product(quaternions.conjugate(expected), got))
            assert np.abs(apart).max(initial=0.0) < 1e-9
        else:
            # The integrator's own error: 1e-12 a step, over a few hundred steps.
            assert np.abs(got - expected).max(initial=0.0) < 1e-9 * max(
                1.0, np.abs(expected).max(initial=0.0)
            )


@EVERY
def test_the_truth_keeps_every_invariant_to_round_off(scene):
    truth = scene.truth(scene, scene.sample_times())
    for observable in scene.observables:
        if observable.kind == "invariant":
            drift = observable.distance(scene, truth, truth).max()
            # The truth is good to some tens of roundings of its phases, and sums a few products.
            assert drift < 300 * EPSILON * observable.scale(scene, truth), observable.name


@EVERY
def test_the_truth_is_at_no_distance_from_itself(scene):
    truth = scene.truth(scene, scene.sample_times())
    for observable in scene.observables:
        if observable.kind != "invariant":
            apart = observable.distance(scene, truth, truth).max()
            assert apart <= 4 * EPSILON * observable.scale(scene, truth), observable.name


@pytest.mark.parametrize("scene", BY_PHASE, ids=lambda scene: scene.full_name)
def test_each_rate_is_the_slope_of_the_truths_own_phase(scene):
    # Against a motion held still at its start, whose phase does not turn: what is left is the truth's own.
    T, fastest = 100 * scene.duration, np.abs(scene.v0).max()
    for observable in scene.observables:
        if observable.kind == "rate":
            exact = observable.scale(scene, None)
            t = np.linspace(0.0, T, int(10 * T * (exact + fastest) / (2 * np.pi)))
            slope = observable.difference(scene, (motion := scene.truth(scene, t)), still(motion))[0, 0]
            # A ripple a·sin(Ωt) shifts the slope of a straight line by at most 12a/(ΩT²); a is less than
            # half a turn, or the phase would not be followed, and Ω here no slower than the rate itself.
            assert abs(abs(slope) - exact) < 12 * np.pi / (exact * T**2), observable.name


def still(motion):
    n = len(motion.t)
    arrays = {name: np.repeat(getattr(motion, name)[:1], n, axis=0) for name in CHANNELS}
    return replace(motion, **arrays)


@EVERY
def test_whatever_an_engine_hands_out_is_looked_at(scene):
    # Each number off by itself, by a part in a million of the largest of its kind, shows in some observable.
    rng = np.random.default_rng(1)
    truth = scene.truth(scene, scene.sample_times())
    for name in (*CHANNELS, "reaction"):
        array = getattr(truth, name)
        size = 1e-6 * (np.abs(array).max(initial=0.0) or 1.0)
        for body in range(array.shape[1]):
            wrong = array.copy()
            wrong[:, body] += size * rng.normal(size=wrong[:, body].shape)
            if name == "quaternion":
                wrong /= np.linalg.norm(wrong, axis=2, keepdims=True)
            seen = [o for o in scene.observables if moved(scene, truth, replace(truth, **{name: wrong}), o)]
            assert seen, f"{name} of {body}"


def moved(scene, truth, wrong, observable):
    before, after = (observable.distance(scene, m, truth).max() for m in (truth, wrong))
    return after - before > 1e-9 * (observable.scale(scene, truth) or 1.0)


@EVERY
def test_ladders_are_whole_steps_far_enough_apart(scene):
    # Most halve; some go by thirds, which keep a blow in the middle of a step, some by less, to stay clear of
    # round-off or to end sooner. Only first-order schemes have contact.
    # Engines as they come are looked at at one step: what they do does not go away with it.
    assert scene.defaults or ({1} if scene.contacts or scene.burning else {1, 4}) <= set(scene.ladders)
    for steps in scene.ladders.values():
        assert len(steps) >= 5
        ratios = np.array(steps[:-1]) / steps[1:]
        assert ((ratios >= 4 / 3 - 1e-12) & (ratios <= 3 + 1e-12)).all()
        assert steps[0] / steps[-1] >= 6
        assert [scene.whole_step(dt) for dt in steps] == list(steps)
    assert scene.whole_step(scene.dt) == scene.dt


@EVERY
def test_every_scheme_that_can_run_a_scene_is_judged_at_a_finite_step(scene):
    t = scene.sample_times()
    for scheme in (scheme for engine in declared() for scheme in engine.schemes):
        if scene.features & scheme.lacks.keys():
            continue
        dt = min(scene.ladder(scheme.order, scheme.twin))
        own = scene.scheme_motion and scene.scheme_motion(scene, scheme.twin, dt, t)
        assert own is not None or scheme.twin in scene.errors, f"{scheme.name}: no error is known"


@EVERY
def test_observables_have_names_of_their_own(scene):
    names = [observable.name for observable in scene.observables]
    assert len(set(names)) == len(names)
    assert any(observable.kind == "state" for observable in scene.observables)


@EVERY
def test_what_is_built_and_what_is_left_out_are_everything_there_is(scene):
    built = {FEATURES[name] for name in scene.features}
    assert built.isdisjoint(scene.left_out)
    touched = {"collision shapes", "contact solver"} if scene.contacts else set()
    touched |= {"ground"} if any(contact.second is None for contact in scene.contacts) else set()
    assert touched.isdisjoint(scene.left_out)
    within = {FEATURES[part] for part, whole in DETAILS.items() if whole not in scene.features}
    assert within.isdisjoint(scene.left_out)
    assert built | touched | within | set(scene.left_out) == {*FEATURES.values(), *NEVER_BUILT}


@pytest.mark.parametrize(
    ("name", "features"),
    [
        ("free_symmetric_top[oblate]", {"free"}),
        ("heavy_top[fast]", {"ball", "gravity"}),
        ("co2_chain[mixture]", {"slide", "tree", "spring"}),
    ],
)
def test_a_scene_needs_no_more_than_it_has(name, features):
    assert scenes()[name].features == features


@pytest.mark.parametrize(
    ("twin", "order"), [*((twin, 4 if twin == "RKMK4" else 1) for twin in co2_chain.SCHEMES)]
)
def test_the_motion_of_a_scheme_on_the_chain_is_of_its_order(twin, order):
    scene, t = scenes()["co2_chain[mixture]"], np.array([0.0, 1.0])
    steps = scene.ladder(order, twin)[-2:]
    truth, coarse, fine = scene.truth(scene, t), *(scene.scheme_motion(scene, twin, dt, t) for dt in steps)
    for name in ("position", "velocity", "joint_position", "joint_velocity"):
        far, near = (
            np.linalg.norm(getattr(m, name) - getattr(truth, name), axis=-1).ravel() for m in (coarse, fine)
        )
        assert far[0] < 1e-14
        # The next term of the error is one order of the step below.
        assert far[-1] / near[-1] == pytest.approx(2**order, rel=0.1)


def test_the_motion_of_an_unknown_scheme_is_not_known():
    scene = scenes()["co2_chain[mixture]"]
    assert scene.scheme_motion(scene, "leapfrog", 1e-3, scene.sample_times()) is None


def test_a_chain_steps_as_semi_implicit_euler_by_hand():
    scene = scenes()["co2_chain[mixture]"]
    m, k, dt = np.array([16.0, 12.0, 16.0]), 1600.0, 1e-2
    x, v = np.cumsum(scene.q0), np.cumsum(scene.v0)
    for _ in range(5):
        left, right = k * (x[1] - x[0]), k * (x[2] - x[1])
        v = v + dt * np.array([left, right - left, -right]) / m
        x = x + dt * v
    found = scene.scheme_motion(scene, "semi-implicit Euler", dt, np.array([5 * dt]))
    assert found.position[0, :, 0] == pytest.approx(x + np.arange(3), abs=1e-14)
    assert found.velocity[0, :, 0] == pytest.approx(v, abs=1e-14)
    assert found.joint_position[0] == pytest.approx([x[0], x[1] - x[0], x[2] - x[1]], abs=1e-14)
