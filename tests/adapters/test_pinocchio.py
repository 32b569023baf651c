"""Pinocchio: each trap is opened on the engine itself, and closed by the adapter."""

import json

import numpy as np
import pinocchio as pin
import pytest
from poinsot.adapters.engine import EngineError
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.reference import equations_of_motion
from poinsot.reports.setup import counted
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.parts import BUILT
from scipy.spatial.transform import Rotation

SCHEMES = {scheme.name: scheme for scheme in Pinocchio.schemes}
EVERY_SCHEME = pytest.mark.parametrize("scheme", SCHEMES)
STILL = (0.0, 0.0, 0.0)
SEEDS = range(12)


def built(scene, scheme="semi-implicit Euler", dt=1e-3):
    engine = Pinocchio()
    engine.build(scene, SCHEMES[scheme], dt)
    return engine


def bits(state):
    return [part.tobytes() for part in state]


@pytest.fixture
def top(scene_of):
    """A free body with a full tensor, turning and flying through no gravity."""
    tensor = ((0.012, 0.001, 0.0), (0.001, 0.01, 0.002), (0.0, 0.002, 0.018))
    body = Body("top", 1.0, tensor, (Joint("free", "free"),))
    return scene_of([body], [0.1, 0.2, 0.3, 0.5, 0.5, 0.5, 0.5], [1.0, -2.0, 0.5, 1.0, 2.0, 5.0], STILL)


# What runs away


def test_pinocchio_itself_passes_nan_in_silence(top):
    engine = built(top)
    q, v = np.full(7, np.nan), np.full(6, np.nan)
    assert np.isnan(pin.aba(engine._model, engine._data, q, v, np.zeros(6))).all()
    assert np.isnan(pin.integrate(engine._model, q, v)).all()


@EVERY_SCHEME
def test_what_runs_away_is_an_error(scene_of, scheme):
    joint = Joint("slide", "slide", (1.0, 0.0, 0.0), 1e12)
    scene = scene_of([Body("mass", 1.0, diagonal(1, 1, 1), (joint,))], [1.0], [0.5])
    engine = built(scene, scheme, dt=1e-2)
    with np.errstate(all="ignore"):
        engine.step(200)
    with pytest.raises(EngineError, match=r"left the finite numbers within 200 steps of 0\.01 s"):
        engine.state()


# Where everything is


@pytest.mark.parametrize("seed", SEEDS)
def test_the_state_is_that_after_the_step(random_tree, links_of, seed):
    scene = random_tree(seed)
    engine = built(scene, "RKMK4")
    engine.step(100)
    q, v = engine._position[engine._q], engine._velocity[engine._v]
    position, quaternion, velocity, omega = equations_of_motion.link_motion(links_of(engine._scene), q, v)
    state = engine.state()
    # A few roundings of numbers of size 1 to 10 along five links.
    np.testing.assert_allclose(state.position, position, atol=2e-14)
    np.testing.assert_allclose(state.velocity, velocity, atol=1e-13)
    np.testing.assert_allclose(state.omega, omega, atol=1e-13)
    turn = Rotation.from_quat(state.quaternion).inv() * Rotation.from_quat(quaternion)
    np.testing.assert_allclose(turn.magnitude(), 0, atol=1e-14)


@EVERY_SCHEME
@pytest.mark.parametrize("seed", [0, 1])
def test_looking_does_not_disturb_the_motion_and_batches_do_not_change_it(random_tree, scheme, seed):
    scene = random_tree(seed)
    watched, unwatched = built(scene, scheme), built(scene, scheme)
    for _ in range(50):
        watched.step(1)
        watched.state()
        watched.acceleration(np.array(scene.q0), np.array(scene.v0))
    unwatched.step(50)
    assert bits(watched.state()) == bits(unwatched.state())


def test_states_are_copies(random_tree):
    engine = built(random_tree(1))
    before = engine.state()
    kept = bits(before)
    engine.step(10)
    engine.state()
    assert bits(before) == kept


def test_building_again_starts_afresh(top):
    engine = built(top)
    first = bits(engine.state())
    engine.step(10)
    engine.build(top, SCHEMES["RKMK4"], 1e-3)
    assert bits(engine.state()) == first


def test_quaternions_a_little_off_unit_length_are_taken_as_turns(scene_of):
    # Scenes are granted 1e-9; a rotation matrix made of such a quaternion would be no rotation.
    slack = 1 + 9e-10
    body = Body(
        "b", 1.0, diagonal(1, 1, 1), (Joint("ball", "ball"),), quaternion=(0.6 * slack, 0, 0, 0.8 * slack)
    )
    engine = built(scene_of([body], [0, 0.6 * slack, 0, 0.8 * slack], [1, 2, 3]))
    place = engine._model.jointPlacements[1].rotation
    np.testing.assert_allclose(place.T @ place, np.eye(3), atol=3e-16)
    assert np.linalg.norm(engine._position) == pytest.approx(1, abs=3e-16)


# What is moved


def branched(order):
    """A torso with two arms of two links each, joints added in the given order."""
    model, ids = pin.Model(), {"world": 0}
    parents = {
        "torso": "world",
        "left": "torso",
        "right": "torso",
        "left hand": "left",
        "right hand": "right",
    }
    inertia = pin.Inertia(1.0, np.array([0.1, 0.2, 0.3]), np.eye(3))
    for name in order:
        ids[name] = model.addJoint(ids[parents[name]], pin.JointModelRY(), pin.SE3.Identity(), name)
        model.appendBodyToJoint(ids[name], inertia, pin.SE3.Identity())
    return model


BREADTH_FIRST = ("torso", "left", "right", "left hand", "right hand")
DEPTH_FIRST = ("torso", "left", "left hand", "right", "right hand")


@pytest.mark.parametrize(("order", "right"), [(BREADTH_FIRST, False), (DEPTH_FIRST, True)])
def test_pinocchio_itself_has_a_wrong_mass_matrix_where_joints_are_not_depth_first(order, right):
    model = branched(order)
    data, q, rest = model.createData(), np.linspace(0.1, 0.5, 5), np.zeros(5)
    by_columns = np.array([pin.rnea(model, data, q, rest, e) for e in np.eye(5)]).T
    by_columns -= pin.rnea(model, data, q, rest, rest)[:, None]
    found = np.triu(pin.crba(model, data, q))
    assert np.allclose(found, np.triu(by_columns), atol=1e-12) is right


@pytest.mark.parametrize("seed", SEEDS)
def test_the_mass_matrix_is_right_however_the_bodies_are_listed(random_tree, links_of, seed):
    scene = random_tree(seed)
    engine = built(scene)
    M = np.triu(pin.crba(engine._model, engine._data, engine._position))
    M = (M + np.triu(M, 1).T)[np.ix_(engine._v, engine._v)]
    expected = equations_of_motion.mass_matrix(links_of(engine._scene), engine._scene.q0)
    np.testing.assert_allclose(M, expected, atol=1e-13 * np.abs(expected).max())


@pytest.mark.parametrize("seed", SEEDS)
def test_accelerations_are_those_of_the_equations_of_motion(random_tree, links_of, seed):
    scene, rng = random_tree(seed), np.random.default_rng(seed)
    engine, links = built(scene), links_of(scene)
    q, v = np.array(scene.q0), rng.normal(size=len(scene.v0))
    expected = equations_of_motion.accelerations(links, q, v, scene.gravity)
    # Solving with the mass matrix multiplies rounding by its condition.
    allowed = 4 * np.finfo(float).eps * np.linalg.cond(equations_of_motion.mass_matrix(links, q))
    assert np.abs(engine.acceleration(q, v) - expected).max() <= allowed * np.abs(expected).max()


def test_pinocchio_itself_does_not_fly_straight_with_a_free_flyer(top):
    model = pin.Model()
    joint = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "free")
    model.appendBodyToJoint(
        joint, pin.Inertia(1.0, np.zeros(3), top.bodies[0].inertia_array), pin.SE3.Identity()
    )
    model.gravity.linear[:] = 0
    data, q, turn = model.createData(), np.array(top.q0), Rotation.from_quat(top.q0[3:])
    v = np.concatenate([turn.inv().apply(top.v0[:3]), top.v0[3:]])
    for _ in range(1000):
        v = v + pin.aba(model, data, q, v, np.zeros(6)) * 1e-3
        q = pin.integrate(model, q, v * 1e-3)
    assert np.linalg.norm(Rotation.from_quat(q[3:]).apply(v[:3]) - top.v0[:3]) > 1e-3


@EVERY_SCHEME
def test_a_free_body_flies_straight(top, scheme):
    engine = built(top, scheme)
    engine.step(1000)
    state = engine.state()
    # A thousand roundings of a metre.
    np.testing.assert_allclose(state.velocity[0], top.v0[:3], atol=1e-14)
    np.testing.assert_allclose(state.position[0], np.add(top.q0[:3], top.v0[:3]), atol=1e-12)


def test_a_free_joint_is_one_of_translation_and_ball_composed(top):
    # Two joints in a row, nothing between them, are the composite joint of the same two.
    model, joint = pin.Model(), pin.JointModelComposite(2)
    joint.addJoint(pin.JointModelTranslation())
    joint.addJoint(pin.JointModelSpherical())
    number = model.addJoint(0, joint, pin.SE3.Identity(), "free")
    inertia = pin.Inertia(1.0, np.zeros(3), top.bodies[0].inertia_array)
    model.appendBodyToJoint(number, inertia, pin.SE3.Identity())
    model.gravity.linear[:] = 0
    data, q, v = model.createData(), np.array(top.q0), np.array(top.v0)
    engine = built(top)
    engine.step(500)
    for _ in range(500):
        v += pin.aba(model, data, q, v, np.zeros(6)) * 1e-3
        q = pin.integrate(model, q, v * 1e-3)
    np.testing.assert_allclose(engine._position, q, atol=1e-13)
    np.testing.assert_allclose(engine._velocity, v, atol=1e-13)


@pytest.mark.parametrize("parent", [None, "base"])
def test_welded_bodies_are_moved_and_seen(scene_of, links_of, parent):
    base = Body("base", 1.0, diagonal(0.1, 0.2, 0.25), (Joint("hinge", "hinge", (0.6, 0.0, 0.8)),))
    place = {
        "position": (0.3, 0.1, 0.2),
        "quaternion": (0.0, 0.6, 0.0, 0.8),
        "center_of_mass": (0.1, 0.0, 0.0),
    }
    welded = Body("welded", 2.0, diagonal(0.3, 0.2, 0.1), (), parent=parent, **place)
    tip = Body(
        "tip", 0.5, diagonal(0.1, 0.1, 0.1), (Joint("ball", "ball"),), parent="welded", position=(0, 0, 1.0)
    )
    scene = scene_of([base, welded, tip], [0.4, 0, 0, 0, 1], [1.0, 2.0, 3.0, 4.0])
    engine = built(scene)
    expected = equations_of_motion.accelerations(links_of(scene), scene.q0, scene.v0, scene.gravity)
    np.testing.assert_allclose(
        engine.acceleration(np.array(scene.q0), np.array(scene.v0)), expected, rtol=1e-13, atol=1e-13
    )
    position, _, velocity, omega = equations_of_motion.link_motion(links_of(scene), scene.q0, scene.v0)
    state = engine.state()
    np.testing.assert_allclose(state.position, position, atol=1e-15)
    np.testing.assert_allclose(state.velocity, velocity, atol=2e-15)
    np.testing.assert_allclose(state.omega, omega, atol=2e-15)
    assert engine.readback().values["body/welded/mass"] == 2.0


@EVERY_SCHEME
@pytest.mark.parametrize("seed", [0, 1])
def test_each_scheme_has_its_declared_order_in_attitude(random_tree, scheme, seed):
    scene = random_tree(seed)
    exact = built(scene, "RKMK4", 2e-4)
    exact.step(1000)
    errors = []
    for dt, steps in ((4e-3, 50), (2e-3, 100)):
        engine = built(scene, scheme, dt)
        engine.step(steps)
        there = Rotation.from_quat(exact.state().quaternion)
        errors.append(
            np.linalg.norm((Rotation.from_quat(engine.state().quaternion).inv() * there).magnitude())
        )
    assert np.log2(errors[0] / errors[1]) == pytest.approx(SCHEMES[scheme].order, abs=0.2)


# What is said of it


@pytest.mark.parametrize("seed", SEEDS)
def test_readback_is_the_scene(random_tree, seed):
    scene = random_tree(seed)
    setup = built(scene, dt=2e-3).readback()
    assert setup.probed == ()
    said = dict(setup.values)
    for body in scene.bodies:
        assert said.pop(f"body/{body.name}/mass") == body.mass
        np.testing.assert_array_equal(said.pop(f"body/{body.name}/center_of_mass"), body.center_of_mass)
        np.testing.assert_array_equal(said.pop(f"body/{body.name}/inertia"), body.inertia)
    for joint in scene.scalar_joints:
        assert said.pop(f"joint/{joint.name}/stiffness") == joint.stiffness
        assert said.pop(f"joint/{joint.name}/damping") == joint.damping
    assert said.pop("gravity").tolist() == list(scene.gravity)
    asked = {name: said.pop(name) for name in list(said) if name.startswith(BUILT)}
    assert asked == counted(scene, asked)
    assert said == {"dt": 2e-3, "velocity_limit": np.inf, "linear_damping": 0.0, "angular_damping": 0.0}


def test_a_wrong_model_shows_in_the_readback(scene_of):
    joint = Joint("hinge", "hinge", (0.0, 1.0, 0.0), 2.0, 3.0)
    scene = scene_of([Body("b", 1.0, diagonal(1, 1, 1), (joint,))], [0.0], [0.0])
    engine = built(scene)
    engine._model.gravity.linear[2] = -9.80
    engine._pull[0, 0], engine._drag[0, 0] = -2.1, -3.1
    said = engine.readback().values
    assert said["gravity"][2] == -9.80
    assert (said["joint/hinge/stiffness"], said["joint/hinge/damping"]) == (2.1, 3.1)


@pytest.mark.parametrize(
    "wrong",
    [
        pin.Inertia(1.001, np.zeros(3), np.eye(3)),
        pin.Inertia(1.0, np.array([0, 0, 1e-3]), np.eye(3)),
        pin.Inertia(1.0, np.zeros(3), np.diag([1, 1, 1.001])),
    ],
)
def test_a_body_that_is_not_what_its_joint_moves_is_an_error(scene_of, wrong):
    body = Body("b", 1.0, diagonal(1, 1, 1), (Joint("ball", "ball"),))
    engine = built(scene_of([body], [0, 0, 0, 1], STILL))
    engine._model.inertias[1] = wrong
    with pytest.raises(EngineError, match="moves other masses with joint 1"):
        engine.readback()


@pytest.mark.parametrize("seed", SEEDS)
def test_the_text_is_the_model_to_the_last_bit(random_tree, seed):
    scene = random_tree(seed)
    engine = built(scene, dt=1 / 3000)
    name, text = engine.model_text()
    assert name == "model.json"
    said = json.loads(text)
    model, springs = model_from(said)
    data, tau = model.createData(), np.zeros(model.nv)
    for v, q, stiffness, damping in springs:
        tau[v] = -stiffness * engine._position[q] - damping * engine._velocity[v]
    a = pin.aba(model, data, engine._position, engine._velocity, tau)
    centred = engine._scene
    found = built(centred, dt=1 / 3000).acceleration(np.array(centred.q0), np.array(centred.v0))
    assert said["dt"] == 1 / 3000
    # Exact but for the order in which spring and damper are added.
    np.testing.assert_allclose(a[engine._v], found, rtol=1e-12, atol=1e-12)
    for mine, theirs in zip(model.inertias, engine._model.inertias, strict=True):
        assert mine == theirs
    for mine, theirs in zip(model.jointPlacements, engine._model.jointPlacements, strict=True):
        assert mine == theirs


def model_from(said):
    """A model made of the text alone."""
    model, springs = pin.Model(), []
    model.gravity.linear[:] = said["gravity"]
    for joint in said["joints"]:
        kind = getattr(pin, joint["type"])
        made = kind(*joint["axis"]) if "axis" in joint else kind()
        i = model.addJoint(model.getJointId(joint["parent"]), made, place_of(joint), joint["name"])
        if "stiffness" in joint:
            springs.append((model.idx_vs[i], model.idx_qs[i], joint["stiffness"], joint["damping"]))
    for body in said["bodies"]:
        inertia = pin.Inertia(body["mass"], np.array(body["center_of_mass"]), np.array(body["inertia"]))
        model.appendBodyToJoint(model.getJointId(body["joint"]), inertia, place_of(body))
    return model, springs


def place_of(part):
    return pin.SE3(np.array(part["rotation"]), np.array(part["translation"]))


def test_closing_lets_go_and_may_be_repeated(top):
    engine = built(top)
    engine.close()
    engine.close()
    assert not hasattr(engine, "_model")
