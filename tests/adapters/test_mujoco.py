"""MuJoCo: each trap is opened on the engine itself, and closed by the adapter."""

import subprocess
import sys
import warnings
from dataclasses import replace

import mujoco
import numpy as np
import pytest
from poinsot.adapters.engine import EngineError
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.reference import equations_of_motion
from poinsot.reports.setup import counted
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.contact import Contact, Plane, Rim, Sphere
from poinsot.scenarios.parts import BUILT
from scipy.spatial.transform import Rotation

SCHEMES = {scheme.name: scheme for scheme in MuJoCo.schemes}
SINCE_3_13 = pytest.mark.skipif("discrete" not in SCHEMES, reason="MuJoCo has it since 3.13")
LESS_IMPLICIT = pytest.mark.parametrize("scheme", [s for s in ("implicitfast", "discrete") if s in SCHEMES])
EVERY_SCHEME = pytest.mark.parametrize("scheme", SCHEMES)
STILL = (0.0, 0.0, 0.0)
SEEDS = range(12)


def built(scene, scheme="Euler", dt=1e-3):
    engine = MuJoCo()
    engine.build(scene, SCHEMES[scheme], dt)
    return engine


def raw_hinge(com, turn=(1.0, 0.0, 0.0, 0.0), moments=(0.01, 0.02, 0.025), **inertia):
    """A body on a hinge about y, as a user of MuJoCo writes it."""
    spec = mujoco.MjSpec()
    body = spec.worldbody.add_body(
        mass=1.0, ipos=com, explicitinertial=True, **(inertia or {"inertia": moments, "iquat": turn})
    )
    body.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0])
    return spec.compile()


def bits(state):
    return [part.tobytes() for part in state]


@pytest.fixture
def top(scene_of):
    """A free body with a full tensor, turning and falling."""
    tensor = ((0.012, 0.001, 0.0), (0.001, 0.01, 0.002), (0.0, 0.002, 0.018))
    body = Body("top", 1.0, tensor, (Joint("free", "free"),), center_of_mass=(0.02, -0.01, 0.03))
    return scene_of([body], [0.1, 0.2, 0.3, 0.5, 0.5, 0.5, 0.5], [1.0, -2.0, 0.5, 1.0, 2.0, 5.0])


@pytest.fixture
def spring(scene_of):
    """One kilogram on a spring and a damper."""

    def make(stiffness, damping=0.0):
        joint = Joint("slide", "slide", (1.0, 0.0, 0.0), stiffness, damping)
        return scene_of([Body("mass", 1.0, diagonal(1, 1, 1), (joint,))], [1.0], [0.5], gravity=STILL)

    return make


# What runs away


def test_mujoco_itself_resets_what_runs_away(spring):
    engine = built(spring(1e6), dt=1e-2)
    engine._model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    engine.step(200)
    assert engine._data.time < 198 * 1e-2
    assert np.isfinite(engine._data.qpos).all()


@EVERY_SCHEME
def test_what_runs_away_is_an_error_and_stays_away(spring, scheme):
    if scheme == "discrete":
        pytest.skip("takes springs at the end of the step: nothing runs away")
    engine = built(spring(1e6), scheme, dt=1e-2)
    engine.step(200)
    with pytest.raises(EngineError, match=r"MuJoCo warned within 200 steps of 0.01 s: mjWARN_BADQ"):
        engine.state()
    assert not np.all(np.abs(engine._data.qpos) < 1e9)


def test_a_reset_behind_our_back_is_seen_by_the_clock(top):
    engine = built(top)
    engine.step(50)
    mujoco.mj_resetData(engine._model, engine._data)
    with pytest.raises(EngineError, match=r"reset itself: its clock shows 0\.0 s after 50 steps"):
        engine.state()


def test_a_last_step_into_infinity_is_an_error(top):
    engine = built(top)
    engine._data.qvel[3] = np.inf
    with pytest.raises(EngineError, match="left the finite numbers"):
        engine.state()


RUNAWAY = """
import mujoco
spec = mujoco.MjSpec()
body = spec.worldbody.add_body(mass=1, inertia=[1, 1, 1], ipos=[0, 0, 0], explicitinertial=True)
joint = body.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE)
{listen}
model = spec.compile()
data = mujoco.MjData(model)
data.qvel[0] = 1e12
mujoco.mj_step(model, data)
"""
LISTEN = """
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.scenarios.registry import scenes
engine = MuJoCo()
engine.build(scenes()["free_symmetric_top[oblate]"], engine.schemes[0], 1e-3)
"""


@pytest.mark.parametrize(("listen", "left"), [("", ["MUJOCO_LOG.TXT"]), (LISTEN, [])])
def test_no_log_is_left_in_the_working_directory(tmp_path, listen, left):
    run = subprocess.run(
        [sys.executable, "-c", RUNAWAY.format(listen=listen)], cwd=tmp_path, capture_output=True, check=True
    )
    assert [path.name for path in tmp_path.iterdir()] == left
    assert run.stdout == b""


def test_a_handler_of_the_users_own_is_left_alone(top):
    heard = []
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(heard.append)
    try:
        engine = built(top)
        engine._data.qvel[0] = 1e12
        engine.step(1)
        assert "huge value in QVEL" in heard[0]
    finally:
        mujoco.set_mju_user_warning(before)


# Where everything is


def test_mujoco_leaves_the_kinematics_of_the_state_before(top):
    engine = built(top)
    engine.step(1)
    stale = engine._data.xipos[1].copy()
    mujoco.mj_forward(engine._model, engine._data)
    assert np.linalg.norm(engine._data.xipos[1] - stale) > 1e-4


@pytest.mark.parametrize("seed", SEEDS)
def test_the_state_is_that_after_the_step(random_tree, links_of, seed):
    scene = random_tree(seed)
    engine = built(scene, "RK4")
    engine.step(100)
    q, v = engine._data.qpos[engine._q], engine._data.qvel[engine._v]
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
    for _ in range(100):
        watched.step(1)
        watched.state()
        watched.acceleration(np.array(scene.q0), np.array(scene.v0))
    unwatched.step(100)
    assert bits(watched.state()) == bits(unwatched.state())


def test_states_are_copies(top):
    engine = built(top)
    before = engine.state()
    kept = bits(before)
    engine.step(10)
    engine.state()
    assert bits(before) == kept


def test_building_again_starts_afresh(top):
    engine = built(top)
    first = bits(engine.state())
    engine.step(10)
    engine.build(top, SCHEMES["RK4"], 1e-3)
    assert bits(engine.state()) == first


# What is moved


@pytest.mark.parametrize("seed", SEEDS)
def test_accelerations_are_those_of_the_equations_of_motion(random_tree, links_of, seed):
    scene, rng = random_tree(seed), np.random.default_rng(seed)
    engine, links = built(scene), links_of(scene)
    q, v = np.array(scene.q0), rng.normal(size=len(scene.v0))
    expected = equations_of_motion.accelerations(links, q, v, scene.gravity)
    # Solving with the mass matrix multiplies rounding by its condition.
    allowed = 4 * np.finfo(float).eps * np.linalg.cond(equations_of_motion.mass_matrix(links, q))
    assert np.abs(engine.acceleration(q, v) - expected).max() <= allowed * np.abs(expected).max()


@SINCE_3_13
def test_under_discrete_qacc_is_not_the_acceleration(spring):
    scene = spring(400.0, 3.0)
    engine = built(scene, "discrete", dt=1e-2)
    mujoco.mj_forward(engine._model, engine._data)
    true = -400.0 * 1.0 - 3.0 * 0.5
    assert abs(engine._data.qacc[0] - true) > 1
    assert engine.acceleration(np.array(scene.q0), np.array(scene.v0))[0] == true


def test_mujoco_itself_drops_a_centre_of_mass_off_by_less_than_a_micrometre():
    for offset, seen in ((9e-7, False), (1.1e-6, True)):
        model = raw_hinge([offset, 0, 0])
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        assert model.body_ipos[1, 0] == offset
        assert bool(data.qacc[0]) is seen


@pytest.mark.parametrize("kind", ["hinge", "ball", "free"])
@pytest.mark.parametrize("offset", [9e-7, 1e-9])
def test_small_offsets_count(scene_of, links_of, kind, offset):
    joint = Joint("joint", kind, (0.0, 1.0, 0.0))
    # Of a size at which the offset matters: 1e-6 m across.
    body = Body("body", 1.0, diagonal(1e-12, 2e-12, 2.5e-12), (joint,), center_of_mass=(offset, 0.0, 0.0))
    q, v = {"hinge": ([0], [0]), "ball": ([0, 0, 0, 1], STILL)}.get(kind, ([0] * 6 + [1], [0.0] * 6))
    v = np.array(v, float) + 3.0
    scene = scene_of([body], q, v)
    engine = built(scene)
    expected = equations_of_motion.accelerations(links_of(scene), q, v, scene.gravity)
    # Of a free body, 4e6 rad/s² that gravity gives cancel down to 7: rounding becomes 1.4e-10.
    np.testing.assert_allclose(engine.acceleration(np.array(q), v), expected, rtol=1e-9, atol=4e-15)
    assert engine.readback().values["body/body/center_of_mass"][0] == offset


def test_mujoco_itself_drops_a_turn_of_the_inertia_below_a_microradian():
    model = raw_hinge([0, 0, 0], turn=[1, 0, 5e-7, 0])
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    assert (data.ximat[1] == data.xmat[1]).all()


@pytest.mark.parametrize("product", [1e-3, 1e-7, 1e-12])
@pytest.mark.parametrize("scale", [1.0, 1e-9])
def test_small_products_of_inertia_count(scene_of, links_of, product, scale):
    tensor = scale * np.array([[3, product, 0], [product, 2.5, product], [0, product, 2]])
    body = Body("body", 1.0, tuple(map(tuple, tensor.tolist())), (Joint("ball", "ball"),))
    scene = scene_of([body], [0, 0, 0, 1], [0, 0, 7.0], gravity=STILL)
    engine = built(scene)
    found = engine.readback().values["body/body/inertia"]
    np.testing.assert_allclose(found, tensor, atol=1e-15 * scale)
    # About a principal axis but for the products, which alone make the body wobble.
    expected = equations_of_motion.accelerations(links_of(scene), scene.q0, scene.v0)
    got = engine.acceleration(np.array(scene.q0), np.array(scene.v0))
    np.testing.assert_allclose(got, expected, atol=1e-13)


def test_mujoco_itself_refuses_a_plate_by_rounding():
    with pytest.raises(ValueError, match="A \\+ B >= C"):
        raw_hinge([0, 0, 0], moments=(0.1, 0.7, 0.8))


@pytest.mark.parametrize("turn", [[0, 0, 0, 1], [0.1, 0.2, 0.3, 0.9]])
def test_plates_are_built(scene_of, turn):
    axes = Rotation.from_quat(turn).as_matrix()
    tensor = axes @ np.diag([0.1, 0.7, 0.8]) @ axes.T
    tensor = (tensor + tensor.T) / 2
    body = Body("plate", 1.0, tuple(map(tuple, tensor.tolist())), (Joint("ball", "ball"),))
    engine = built(scene_of([body], [0, 0, 0, 1], [1, 2, 3]))
    # Two units in the last place: one for the axes, one shaved off the largest moment.
    np.testing.assert_allclose(engine.readback().values["body/plate/inertia"], tensor, atol=3e-16)


@pytest.mark.parametrize(
    ("body", "words"),
    [
        (Body("speck", 1e-16, diagonal(1, 1, 1), (Joint("slide", "slide"),)), "larger than mjMINVAL"),
        (
            Body("knot", 1.0, diagonal(1, 1, 1), (Joint("ball", "ball"), Joint("hinge", "hinge"))),
            "ball followed by rotation",
        ),
    ],
)
def test_what_mujoco_refuses_is_said_in_one_line(scene_of, body, words):
    q = [0.0] if len(body.joints) == 1 else [0, 0, 0, 1, 0]
    with pytest.raises(EngineError, match=f"^MuJoCo refuses trial: .*{words}.*$"):
        built(scene_of([body], q, [0.0] * (1 if len(q) == 1 else 4)))


@SINCE_3_13
def test_a_singular_pose_that_is_never_met_is_no_matter(scene_of):
    # Hinges about z, y, z: at all zero the first and the last are one, as Euler's angles at β = 0.
    joints = tuple(
        Joint(n, "hinge", axis) for n, axis in zip("αβγ", np.eye(3)[[2, 1, 2]].tolist(), strict=True)
    )
    gimbal = Body("gimbal", 1.0, diagonal(0.01, 0.015, 0.02), tuple(joints))
    scene = scene_of([gimbal], [0.1, 1.0, 0.2], [1.0, 2.0, 3.0])
    with pytest.warns(UserWarning, match="too close to singular"):
        mujoco.MjSpec.from_string(built(scene).model_text()[1]).compile()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        engine = built(scene)
        engine.step(100)
        engine.state()


# Schemes


def test_mujoco_itself_takes_dampers_implicitly_in_euler(spring):
    scene, dt, c = spring(0.0, 2.0), 0.1, 2.0
    explicit, implicit = 0.5 * (1 - c * dt), 0.5 / (1 + c * dt)
    engine = built(scene, dt=dt)
    engine.step(1)
    # Three roundings of a number below 1.
    assert engine.state().joint_velocity[0] == pytest.approx(explicit, abs=3e-16)
    engine = built(scene, dt=dt)
    engine._model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_EULERDAMP)
    engine.step(1)
    assert engine.state().joint_velocity[0] == pytest.approx(implicit, abs=3e-16)


def apart(scene, first, second, dt=1e-3, steps=500):
    """Largest difference between the states of two schemes."""
    a, b = built(scene, first, dt), built(scene, second, dt)
    a.step(steps)
    b.step(steps)
    return max(np.abs(x - y).max(initial=0) for x, y in zip(a.state(), b.state(), strict=True))


@LESS_IMPLICIT
def test_on_a_lone_free_body_these_are_the_implicit_scheme(top, scheme):
    # Rounding of 500 steps at most; a term treated differently shows at 1e-2.
    assert apart(top, scheme, "implicit") < 1e-12
    assert apart(top, scheme, "Euler") > 1e-3


@LESS_IMPLICIT
def test_on_a_pivot_these_are_the_explicit_scheme_to_the_bit(scene_of, scheme):
    body = Body("top", 1.0, diagonal(0.004, 0.004, 0.0075), (Joint("pivot", "ball"),), (0.0, 0.0, 0.05))
    scene = scene_of([body], [0.28, 0, 0, 0.96], [1.5, 0.5, 20])
    assert apart(scene, scheme, "Euler") == 0
    assert apart(scene, scheme, "implicit") > 1e-3


@SINCE_3_13
def test_they_take_dampers_at_the_end_of_the_step_and_discrete_springs_too(spring):
    for scheme, damped, sprung in (("implicitfast", True, False), ("discrete", True, True)):
        assert bool(apart(spring(0.0, 2.0), scheme, "Euler") > 1e-6) is damped
        assert bool(apart(spring(400.0), scheme, "Euler") > 1e-6) is sprung
        assert apart(spring(0.0, 2.0), scheme, "implicit") < 1e-14


@EVERY_SCHEME
@pytest.mark.parametrize("seed", [0, 1])
def test_each_scheme_has_its_declared_order_in_attitude(random_tree, scheme, seed):
    scene = random_tree(seed)
    exact = built(scene, "RK4", 2e-4)
    exact.step(1000)
    errors = []
    for dt, steps in ((8e-3, 25), (4e-3, 50), (2e-3, 100)):
        engine = built(scene, scheme, dt)
        engine.step(steps)
        turn = Rotation.from_quat(engine.state().quaternion).inv() * Rotation.from_quat(
            exact.state().quaternion
        )
        errors.append(np.linalg.norm(turn.magnitude()))
    order = np.log2(errors[1] / errors[2])
    assert order == pytest.approx(SCHEMES[scheme].order, abs=0.2)


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
        # Turned to principal axes and back.
        np.testing.assert_allclose(said.pop(f"body/{body.name}/inertia"), body.inertia, atol=1e-16)
    for joint in scene.scalar_joints:
        assert said.pop(f"joint/{joint.name}/stiffness") == joint.stiffness
        assert said.pop(f"joint/{joint.name}/damping") == joint.damping
    assert said.pop("gravity").tolist() == list(scene.gravity)
    asked = {name: said.pop(name) for name in list(said) if name.startswith(BUILT)}
    assert asked == counted(scene, asked)
    assert said == {"dt": 2e-3, "velocity_limit": np.inf, "linear_damping": 0.0, "angular_damping": 0.0}


def _set(name, index, value):
    def change(model):
        getattr(model, name)[index] = value

    return change


def _weightless(model):
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_GRAVITY


@pytest.mark.parametrize(
    ("change", "setting"),
    [
        (_set("body_mass", 1, 1.001), "body/top/mass"),
        (_set("body_inertia", (1, 2), 0.02), "body/top/inertia"),
        (_set("body_iquat", 1, (1, 0, 0, 0)), "body/top/inertia"),
        (_set("body_ipos", (1, 0), 0.03), "body/top/center_of_mass"),
        (_set("body_sameframe", 1, mujoco.mjtSameFrame.mjSAMEFRAME_BODY), "body/top/inertia"),
        (_set("dof_damping", 1, 0.04), "linear_damping"),
        (_set("dof_damping", 4, 0.04), "angular_damping"),
        (lambda model: model.opt.gravity.__setitem__(2, -9.80), "gravity"),
        (_weightless, "gravity"),
        (lambda model: setattr(model.opt, "timestep", 2e-3), "dt"),
    ],
)
def test_a_wrong_model_shows_in_the_readback(top, change, setting):
    right, wrong = built(top), built(top)
    change(wrong._model)
    a, b = right.readback().values[setting], wrong.readback().values[setting]
    assert np.abs(np.subtract(a, b)).max() > 1e-4


def test_an_offset_that_mujoco_drops_shows_in_the_readback(scene_of):
    body = Body("top", 1.0, diagonal(1, 2, 2.5), (Joint("pivot", "ball"),), center_of_mass=(0.1, 0.0, 0.0))
    engine = built(scene_of([body], [0, 0, 0, 1], [0, 0, 0]))
    assert engine.readback().values["body/top/center_of_mass"] == pytest.approx([0.1, 0.0, 0.0], rel=1e-15)
    engine._model.body_sameframe[1] = mujoco.mjtSameFrame.mjSAMEFRAME_BODY
    assert not engine.readback().values["body/top/center_of_mass"].any()


def test_damping_is_said_as_a_rate(scene_of):
    body = Body("body", 2.0, diagonal(0.5, 0.5, 0.5), (Joint("free", "free"),))
    engine = built(scene_of([body], [0] * 6 + [1], [0] * 6))
    engine._model.dof_damping[:] = 0.04
    said = engine.readback().values
    assert said["linear_damping"] == pytest.approx(0.04 / 2.0)
    assert said["angular_damping"] == pytest.approx(0.04 / 0.5)


def test_mujocos_own_text_has_six_digits(random_tree):
    engine = built(random_tree(1))
    copied = mujoco.MjModel.from_xml_string(engine._spec.to_xml())
    assert np.abs(copied.body_inertia - engine._model.body_inertia).max() > 1e-9


def same_model(engine):
    """The model that MuJoCo makes of the engine's text, once it is seen to be the engine's to the bit."""
    name, text = engine.model_text()
    assert name == "model.xml"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        copied = mujoco.MjModel.from_xml_string(text)
    for field in dir(copied):
        value = getattr(copied, field)
        if isinstance(value, np.ndarray) and field not in ("paths", "body_sameframe"):
            np.testing.assert_array_equal(value, getattr(engine._model, field), err_msg=field)
    for field in ("timestep", "gravity", "integrator", "disableflags", "enableflags"):
        assert np.all(getattr(copied.opt, field) == getattr(engine._model.opt, field)), field
    return copied


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("against", [Sphere(0.3), Plane((0.6, 0.0, 0.8), 0.1)])
@pytest.mark.parametrize("second", ["second", None])
def test_the_text_holds_every_shape_and_contact(scene_of, friction, against, second):
    bodies = [Body(name, 1.0, diagonal(1, 1, 1), (Joint(name, "free"),)) for name in ("first", "second")]
    q = [0, 0, 0, 0, 0, 0, 1, 1, 2, 3, 0, 0, 0, 1]
    contact = Contact("first", Rim(0.2) if second is None else Sphere(0.2), second, against, friction, 0.0)
    if second is None and isinstance(against, Sphere):
        against = Plane((0.0, 0.0, -1.0))
        contact = replace(contact, against=against)
    engine = built(replace(scene_of(bodies, q, [0] * 12), contacts=(contact,)))
    copied = same_model(engine)
    assert (copied.ngeom, copied.npair) == (2, 1)
    for name in ("cone", "impratio", "tolerance"):
        assert getattr(copied.opt, name) == getattr(engine._model.opt, name)
    # The face of the shape it is against points along the normal.
    if isinstance(against, Plane):
        face = np.zeros(9)
        mujoco.mju_quat2Mat(face, copied.geom("0 second").quat)
        assert face.reshape(3, 3)[:, 2] == pytest.approx(against.normal)


@EVERY_SCHEME
@pytest.mark.parametrize("seed", [0, 1, 2, 3])
def test_the_text_is_the_model_to_the_last_bit(random_tree, scheme, seed):
    engine = built(random_tree(seed), scheme, 1 / 3000)
    copied = same_model(engine)
    data = mujoco.MjData(copied)
    data.qpos[:], data.qvel[:] = engine._data.qpos, engine._data.qvel
    engine.step(100)
    mujoco.mj_step(copied, data, nstep=100)
    assert data.qpos.tobytes() == engine._data.qpos.tobytes()


@pytest.mark.parametrize(("offset", "simple"), [(0.0, 1), (9e-7, 0), (0.1, 0)])
def test_the_text_says_which_mass_matrices_are_diagonal(scene_of, offset, simple):
    body = Body("body", 1.0, diagonal(1, 2, 2.5), (Joint("ball", "ball"),), center_of_mass=(offset, 0.0, 0.0))
    engine = built(scene_of([body], [0] * 3 + [1], [0] * 3))
    assert same_model(engine).body_simple[1] == engine._model.body_simple[1] == simple
    # Only an exactly aligned body keeps MuJoCo's shortcut.
    same = mujoco.mjtSameFrame.mjSAMEFRAME_BODY
    assert (engine._model.body_sameframe[1] == same) == bool(simple)


def test_closing_lets_go_and_may_be_repeated(top):
    engine = built(top)
    engine.close()
    engine.close()
    assert not hasattr(engine, "_data")
