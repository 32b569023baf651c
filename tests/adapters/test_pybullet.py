"""PyBullet: each trap is opened on the engine itself, and closed by the adapter."""

import math
import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pybullet as p
import pytest
from poinsot.adapters import pybullet_loading
from poinsot.adapters.engine import EngineError
from poinsot.adapters.pybullet_ import PyBullet
from poinsot.adapters.simulate import simulate
from poinsot.reference import equations_of_motion
from poinsot.reference.errors import InputError
from poinsot.reports.setup import expected
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.registry import scenes
from scipy.spatial.transform import Rotation

SCHEMES = {scheme.name: scheme for scheme in PyBullet.schemes}
REDUCED, MAXIMAL = SCHEMES
BOTH = pytest.mark.parametrize("scheme", SCHEMES)
SEEDS = range(12)
STILL = (0.0, 0.0, 0.0)
#: What reports/setup.py allows a setting to be off by.
SETUP = 1e-12


@pytest.fixture(scope="module")
def engine():
    """One engine for every test that leaves its worlds as they are: building starts afresh."""
    made = PyBullet()
    yield made
    made.close()


@pytest.fixture
def build(engine):
    def make(scene, scheme=REDUCED, dt=1e-3):
        engine.build(scene, SCHEMES[scheme], dt)
        return engine

    return make


@pytest.fixture
def client():
    """A world of PyBullet's own, as its user finds it."""
    number = p.connect(p.DIRECT)
    yield number
    p.disconnect(number)


@pytest.fixture
def load(client, tmp_path):
    """Loads a link, hung on the world by a joint of the given type if there is one."""
    count = iter(range(100))

    def make(moments="0.01 0.015 0.02", joint="", origin="", mass=1.0, name="", **options):
        path = tmp_path / (name or f"{next(count)}.urdf")
        path.write_text(f'<robot name="raw">{_links(moments, joint, origin, mass)}</robot>')
        options.setdefault("flags", p.URDF_USE_INERTIA_FROM_FILE)
        return p.loadURDF(str(path), physicsClientId=client, **options)

    return make


def _links(moments, joint, origin, mass):
    xx, yy, zz = moments.split()
    body = f"""<link name="body"><inertial>{origin}<mass value="{mass}"/>
      <inertia ixx="{xx}" iyy="{yy}" izz="{zz}" ixy="0" ixz="0" iyz="0"/></inertial></link>"""
    if not joint:
        return body
    return f"""<link name="ground"><inertial><mass value="0"/>
      <inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial></link>{body}
      <joint name="joint" type="{joint}"><parent link="ground"/><child link="body"/><axis xyz="1 0 0"/>
      <limit lower="0" upper="-1" effort="0" velocity="0"/></joint>"""


def still(uid, client):
    """What a user who knows of damping and the clamp takes off."""
    p.changeDynamics(uid, -1, linearDamping=0, angularDamping=0, maxJointVelocity=1e9, physicsClientId=client)


def step(client, n=1, dt=1e-2):
    p.setTimeStep(dt, physicsClientId=client)
    for _ in range(n):
        p.stepSimulation(client)


def bits(state):
    return [part.tobytes() for part in state]


@pytest.fixture
def free(scene_of):
    """A free body: with a full tensor and an offset centre of mass, or such as is asked for."""
    tensor = ((0.012, 0.001, 0.0), (0.001, 0.01, 0.002), (0.0, 0.002, 0.018))

    def make(velocity=(1.0, -2.0, 0.5), omega=(1.0, 2.0, 5.0), gravity=STILL, **changes):
        body = Body("body", 1.0, tensor, (Joint("free", "free"),), center_of_mass=(0.02, -0.01, 0.03))
        q = [0.1, 0.2, 0.3, 0.5, -0.5, 0.5, 0.5]
        return scene_of([replace(body, **changes)], q, [*velocity, *omega], gravity)

    return make


@pytest.fixture
def hung(scene_of):
    """A body on one joint to the world."""

    def make(kind, v=1.0, gravity=STILL, stiffness=0.0, damping=0.0, **changes):
        joint = Joint("joint", kind, (1.0, 0.0, 0.0), stiffness, damping)
        body = Body("body", 1.0, diagonal(0.01, 0.015, 0.02), (joint,), **changes)
        q, v = ([0, 0, 0, 1], [v, 0, 0]) if kind == "ball" else ([0], [v])
        return scene_of([body], q, v, gravity)

    return make


def setup_errors(scene, engine, dt=1e-3):
    """Every setting that is not as asked, as reports/setup.py reckons it."""
    values, errors = engine.readback().values, {}
    for name, asked in expected(scene, dt).items():
        got, asked = np.asarray(values[name], float), np.asarray(asked, float)
        if name == "velocity_limit":
            errors[name] = 0.0 if got == np.inf else np.inf
        else:
            errors[name] = float(np.max(np.abs(got - asked))) / (float(np.max(np.abs(asked))) or 1.0)
    return {name: error for name, error in errors.items() if not error <= SETUP}


# What PyBullet adds by itself: damping, a clamp, motors, sleep


def test_pybullet_itself_damps(client, load):
    uid = load()
    p.resetBaseVelocity(uid, [1, 0, 0], [0, 0, 1], client)
    step(client)
    velocity, omega = p.getBaseVelocity(uid, client)
    # 0.04 (1 + |v|), of which the second part no manual tells.
    assert velocity[0] == pytest.approx(1 - 0.01 * 0.04 * 2, abs=1e-9)
    assert omega[2] == pytest.approx(1 - 0.01 * 0.04 * 2, abs=1e-9)


def test_pybullet_itself_damps_joints_and_holds_them_back_at_a_hundred(client, load):
    for joint in ("continuous", "prismatic"):
        uid = load(joint=joint)
        p.setJointMotorControl2(uid, 0, p.VELOCITY_CONTROL, force=0, physicsClientId=client)
        p.resetJointState(uid, 0, 0, 1.0, client)
        step(client)
        assert p.getJointState(uid, 0, client)[1] == pytest.approx(1 - 0.01 * 0.04 * 2, abs=1e-9)
        p.resetJointState(uid, 0, 0, 150.0, client)
        step(client)
        assert p.getJointState(uid, 0, client)[1] <= 100


def test_pybullet_itself_clamps_every_component_at_a_hundred(client, load):
    uid = load()
    p.changeDynamics(uid, -1, linearDamping=0, angularDamping=0, physicsClientId=client)
    p.resetBaseVelocity(uid, [150, 0, -150], [0, 0, 150], client)
    step(client, dt=1e-3)
    assert p.getBaseVelocity(uid, client) == ((100, 0, -100), (0, 0, 100))


@BOTH
def test_a_free_body_keeps_its_velocities(build, free, scheme):
    # Spinning about a principal axis, so that ω too must stay as it is.
    scene = free(
        (150.0, -2e5, 1e-9), (0, 0, 150.0), inertia=diagonal(0.01, 0.02, 0.025), center_of_mass=STILL
    )
    engine = build(scene, scheme)
    before = engine.state()
    engine.step(1000)
    after = engine.state()
    np.testing.assert_array_equal(after.velocity, before.velocity)
    # Kept in world axes, ω = 150 is rounded by 3e-14 at every step.
    np.testing.assert_allclose(after.omega, before.omega, atol=3e-11)


@pytest.mark.parametrize("kind", ["hinge", "slide", "ball"])
@pytest.mark.parametrize("v", [1e-9, 1.0, 150.0])
def test_a_joint_keeps_its_velocity(build, hung, kind, v):
    engine = build(hung(kind, v))
    engine.step(3000)  # long enough for PyBullet to send to sleep what is slow
    state = engine.state()
    found = state.omega[0, 0] if kind == "ball" else state.joint_velocity[0]
    assert found == pytest.approx(v, rel=1e-14)


def test_pybullet_itself_holds_joints_by_motors(client, load):
    hinge, ball = load(joint="continuous"), load(joint="spherical")
    p.resetJointState(hinge, 0, 0, 1.0, client)
    p.resetJointStateMultiDof(ball, 0, [0, 0, 0, 1], [1, 2, 3], client)
    step(client)
    assert abs(p.getJointState(hinge, 0, client)[1]) < 1e-3
    assert np.abs(p.getJointStateMultiDof(ball, 0, client)[1]).max() < 1e-3


def test_pybullet_itself_puts_slow_bodies_to_sleep(client, load):
    uid = load(flags=p.URDF_USE_INERTIA_FROM_FILE | p.URDF_ENABLE_SLEEPING)
    still(uid, client)
    p.resetBaseVelocity(uid, [1e-3, 0, 0], STILL, client)
    step(client, 1000)
    assert p.getBaseVelocity(uid, client)[0] == STILL


# Setup: what is read back, what is tried out


@pytest.mark.parametrize("seed", SEEDS)
def test_setup_is_as_asked_on_every_kind_of_tree(build, random_tree, seed):
    scene = random_tree(seed)
    assert not setup_errors(scene, build(scene))


@BOTH
def test_setup_of_a_free_body_is_as_asked(build, free, scheme):
    scene = free(gravity=(0.1, 0.2, -9.81))
    assert not setup_errors(scene, build(scene, scheme))


def test_what_was_tried_out_is_said(build, hung):
    setup = build(hung("slide")).readback()
    tried = {
        "linear_damping",
        "angular_damping",
        "velocity_limit",
        "joint/joint/stiffness",
        "joint/joint/damping",
        "built/actuators",
        "built/sensors",
    }
    assert set(setup.probed) == tried


@pytest.fixture
def sabotage(monkeypatch):
    """Makes one of PyBullet's calls do something else."""

    def make(name, instead):
        real = getattr(p, name)
        monkeypatch.setattr(p, name, lambda *a, **k: instead(real, *a, **k))

    return make


def _forgets(*forgotten):
    def instead(real, *a, **k):
        return real(*a, **{name: value for name, value in k.items() if name not in forgotten})

    return instead


@pytest.mark.parametrize(
    ("forgotten", "name", "found"),
    [
        ("linearDamping", "linear_damping", 0.04),
        ("angularDamping", "angular_damping", 0.04),
        ("maxJointVelocity", "velocity_limit", 100.0),
    ],
)
def test_a_default_left_in_place_shows(build, free, hung, sabotage, forgotten, name, found):
    sabotage("changeDynamics", _forgets(forgotten))
    for scene in (free(), hung("slide" if name == "linear_damping" else "hinge")):
        engine = build(scene)
        # PyBullet's default is 0.04f, in single precision.
        assert engine.readback().values[name] == pytest.approx(found, rel=1e-7)
        assert set(setup_errors(scene, engine)) >= {name}


@pytest.mark.parametrize("kind", ["hinge", "slide", "ball"])
@pytest.mark.parametrize("state", ["sleep", "motors"])
def test_sleep_and_motors_show(build, hung, monkeypatch, sabotage, kind, state):
    scene = hung(kind)
    engine = build(scene)
    engine._copy = None
    if state == "sleep":
        monkeypatch.setattr(p, "ACTIVATION_STATE_DISABLE_SLEEPING", p.ACTIVATION_STATE_ENABLE_SLEEPING)
    else:
        for call in ("setJointMotorControl2", "setJointMotorControlMultiDof"):
            sabotage(call, lambda real, *a, **k: real(*a, **k) if a[2] == p.TORQUE_CONTROL else None)
    values = engine.readback().values
    # Either ends the motion within the 5 s of the probe.
    assert max(values["linear_damping"], values["angular_damping"]) > 0.9


def test_a_wrong_spring_shows(build, hung, sabotage):
    sabotage(
        "setJointMotorControlArray",
        lambda real, *a, forces, **k: real(*a, forces=[1.001 * force for force in forces], **k),
    )
    values = build(hung("slide", stiffness=1600.0)).readback().values
    assert values["joint/joint/stiffness"] == pytest.approx(1601.6, rel=1e-12)


def test_a_wrong_damper_shows(build, hung, sabotage):
    def instead(real, uid, link, *, physicsClientId, **k):
        real(uid, link, physicsClientId=physicsClientId, **k)
        real(uid, 0, jointDamping=0.2, physicsClientId=physicsClientId)

    sabotage("changeDynamics", instead)
    values = build(hung("hinge", damping=0.3)).readback().values
    assert values["joint/joint/damping"] == pytest.approx(0.2, rel=1e-12)


@BOTH
def test_a_wrong_gravity_shows(build, free, sabotage, scheme):
    sabotage("setGravity", lambda real, x, y, z, **k: real(x, y, z * 9.80 / 9.81, **k))
    scene = free(gravity=(0.0, 0.0, -9.81))
    assert list(setup_errors(scene, build(scene, scheme))) == ["gravity"]


def test_pybullet_itself_takes_no_inertia_from_the_file(client, load):
    uid = load(flags=0)
    assert max(p.getDynamicsInfo(uid, -1, client)[2]) < 1e-6


def test_a_forgotten_flag_shows(build, free, monkeypatch):
    monkeypatch.setattr(p, "URDF_USE_INERTIA_FROM_FILE", 0)
    scene = free()
    assert "body/body/inertia" in setup_errors(scene, build(scene))


def test_pybullet_itself_overwrites_the_inertia_with_the_mass(client, load):
    uid = load()
    p.changeDynamics(uid, -1, mass=2.0, physicsClientId=client)
    assert max(p.getDynamicsInfo(uid, -1, client)[2]) < 1e-5
    uid = load(useMaximalCoordinates=True)
    p.changeDynamics(uid, -1, localInertiaDiagonal=[0.02, 0.03, 0.04], physicsClientId=client)
    assert p.getDynamicsInfo(uid, -1, client)[0] != pytest.approx(1.0)


def test_pybullet_itself_tells_a_false_inertial_frame_in_maximal_coordinates(client, load):
    origin = '<origin xyz="0.1 0.2 0.3" rpy="0.1 0.2 0.3"/>'
    uid = load(origin=origin, useMaximalCoordinates=True)
    assert p.getDynamicsInfo(uid, -1, client)[3] != pytest.approx((0.1, 0.2, 0.3))


def test_pybullet_itself_remembers_files_by_name(client, load):
    first, second = load(mass=1.0, name="same.urdf"), load(mass=2.0, name="same.urdf")
    assert p.getDynamicsInfo(first, -1, client)[0] == p.getDynamicsInfo(second, -1, client)[0] == 1.0


def test_the_same_name_twice_is_two_models(build, free, monkeypatch, tmp_path):
    class SameFolder:
        def __enter__(self):
            return str(tmp_path)

        def __exit__(self, *rest):
            return None

    # Not even the same file name brings back what was read before.
    monkeypatch.setattr(pybullet_loading.tempfile, "TemporaryDirectory", SameFolder)
    for mass in (1.0, 2.0):
        assert build(free(mass=mass)).readback().values["body/body/mass"] == mass


def test_pybullet_itself_takes_the_inertia_of_a_plate_away(load, client, capfd):
    # 0.1 + 0.7 is 0.7999999999999999 in binary.
    uid = load("0.1 0.7 0.8")
    assert p.getDynamicsInfo(uid, -1, client)[2] == STILL
    assert "Bad inertia tensor" in capfd.readouterr().out


@BOTH
@pytest.mark.parametrize("turn", [[0, 0, 0, 1], [0.1, 0.2, 0.3, 0.9]])
def test_plates_are_built(build, free, scheme, turn):
    axes = Rotation.from_quat(turn).as_matrix()
    tensor = axes @ np.diag([0.1, 0.7, 0.8]) @ axes.T
    scene = free(inertia=tuple(map(tuple, ((tensor + tensor.T) / 2).tolist())))
    # Two units in the last place: one for the axes, one shaved off the largest moment.
    found = build(scene, scheme).readback().values["body/body/inertia"]
    np.testing.assert_allclose(found, scene.bodies[0].inertia_array, atol=3e-16)


def test_what_pybullet_complains_of_is_an_error(build, free, monkeypatch, capfd):
    real = pybullet_loading.urdf
    monkeypatch.setattr(pybullet_loading, "urdf", lambda *a: real(*a).replace('ixx="0.01"', 'ixx="0.9"'))
    with pytest.raises(EngineError, match=r"PyBullet refuses trial: .*Bad inertia tensor"):
        build(free(inertia=diagonal(0.01, 0.015, 0.02)))
    monkeypatch.setattr(pybullet_loading, "urdf", lambda *a: "<robot")
    with pytest.raises(EngineError, match=r"PyBullet refuses trial: .*XML_ERROR"):
        build(free())
    assert capfd.readouterr() == ("", "")


# What PyBullet takes for zero, or has no room for


def test_pybullet_itself_drops_the_gyroscopic_term_of_small_bodies(client, load):
    moments = {"1e-6 1.5e-6 2e-6": False, "1e-5 1.5e-5 2e-5": True}
    for text, precesses in moments.items():
        uid = load(text, useMaximalCoordinates=True)
        p.resetBaseVelocity(uid, STILL, [1, 2, 3], client)
        step(client)
        assert (abs(p.getBaseVelocity(uid, client)[1][0] - 1.0) > 1e-3) is precesses


def test_pybullet_itself_does_not_turn_what_is_smaller_still(client, load):
    for moment, precesses in (("1e-16", False), ("3e-16", True)):
        uid = load(f"{moment} 4e-16 5e-16")
        still(uid, client)
        p.resetBaseVelocity(uid, STILL, [1, 2, 3], client)
        step(client)
        assert (p.getBaseVelocity(uid, client)[1] != (1, 2, 3)) is precesses


@pytest.mark.parametrize(
    ("scheme", "size", "words"),
    [
        (MAXIMAL, 4e-6, r"product of moments of 1.92e-16; below 2.22e-16 .*the gyroscopic term"),
        (REDUCED, 1e-16, r"smallest of mass and moments of 1e-16; below 2.22e-16 .*its acceleration"),
    ],
)
def test_bodies_too_small_are_refused(build, free, scheme, size, words):
    with pytest.raises(InputError, match=rf"^scene trial: body 'body' has a {words}; scale the scene up$"):
        build(free(inertia=diagonal(size, 1.5 * size, 2 * size)), scheme)


@pytest.mark.parametrize(("scheme", "size"), [(MAXIMAL, 5e-6), (REDUCED, 3e-16)])
def test_bodies_just_large_enough_turn(build, free, links_of, scheme, size):
    scene = free(inertia=diagonal(size, 1.5 * size, 2 * size), center_of_mass=STILL)
    got = build(scene, scheme).acceleration(np.array(scene.q0), np.array(scene.v0))
    expected = equations_of_motion.accelerations(links_of(scene), scene.q0, scene.v0, scene.gravity)
    np.testing.assert_allclose(got[3:], expected[3:], atol=1e-11)


def test_pybullet_itself_freezes_light_joints(client, load):
    p.setGravity(0, -9.81, 0, physicsClientId=client)
    for moment, falls in (("1e-17", False), ("1e-15", True)):
        uid = load(f"{moment} {moment} {moment}", "continuous", '<origin xyz="0 0 1e-9"/>', 1e-3)
        p.setJointMotorControl2(uid, 0, p.VELOCITY_CONTROL, force=0, physicsClientId=client)
        step(client)
        assert (p.getJointState(uid, 0, client)[1] != 0) is falls


def test_light_joints_are_refused(build, hung):
    speck = {"mass": 1e-3, "inertia": diagonal(1e-17, 1e-17, 1e-17)}
    scene = hung("hinge")
    frozen = replace(scene, bodies=(replace(scene.bodies[0], **speck),))
    with pytest.raises(
        InputError, match=r"joint 'joint' moves an inertia below 2.22e-16 .*scale the scene up"
    ):
        build(frozen)
    # The same speck on an arm is heavy enough.
    build(replace(scene, bodies=(replace(scene.bodies[0], **speck, center_of_mass=(0, 0, 0.1)),)))


@pytest.mark.parametrize(("kind", "most"), [("slide", 121), ("ball", 30)])
def test_trees_that_overrun_pybullets_memory_are_refused(build, scene_of, kind, most):
    def chain(n):
        bodies = [
            Body(f"{i}", 1.0, diagonal(1, 1, 1), (Joint(f"{i}", kind),), parent=str(i - 1) if i else None)
            for i in range(n)
        ]
        q = [0.1] if kind == "slide" else [0, 0, 0.6, 0.8]
        return scene_of(bodies, q * n, [0.2] * n * (1 if kind == "slide" else 3), STILL)

    state = build(chain(most)).state()
    assert state.omega[-1, 0] == pytest.approx(0.0 if kind == "slide" else state.omega[-1, 0])
    if kind == "slide":
        np.testing.assert_allclose(state.position[:, 2], 0.1 * np.arange(1, most + 1), rtol=1e-14)
    with pytest.raises(
        InputError, match=rf"a tree of {most + 1} links .*room for 127 links and 121 coordinates"
    ):
        build(chain(most + 1))


def test_pybullet_itself_cuts_long_lines(client, load, capfd):
    with pytest.raises(p.error):
        load(origin=f"<{'a' * 9000}/>")
    assert "XML_ERROR" in capfd.readouterr().out


def test_names_may_be_long_and_strange(build, hung):
    scene = hung("hinge")
    body = replace(scene.bodies[0], name="<&'>é --> " * 2000)
    scene = replace(scene, name=body.name, bodies=(body,))
    assert not setup_errors(scene, build(scene))


def test_pybullet_itself_has_no_joints_in_maximal_coordinates(client, load):
    assert p.getNumJoints(load(joint="continuous"), client) == 1
    assert p.getNumJoints(load(joint="continuous", useMaximalCoordinates=True), client) == 0


@pytest.mark.parametrize("kind", ["hinge", "slide", "ball"])
def test_joints_in_maximal_coordinates_are_refused(build, hung, kind):
    with pytest.raises(InputError, match="PyBullet lets no one set or read a joint"):
        build(hung(kind), MAXIMAL)


def test_what_maximal_coordinates_lack_is_said():
    lacking = set(SCHEMES[MAXIMAL].lacks) - {"acceleration"}
    assert lacking == PyBullet.features - {
        "free", "gravity", "force", "blow", "burning", "contact", "friction", "solid",
    }  # fmt: skip
    assert set(SCHEMES[REDUCED].lacks) == {"rim", "ellipsoid", "shell", "hollow"}


# What is too fast


@BOTH
def test_pybullet_itself_clips_turns(client, load, scheme):
    for omega, clipped in ((70.0, False), (90.0, True)):
        uid = load(useMaximalCoordinates=scheme == MAXIMAL)
        still(uid, client)
        p.resetBaseVelocity(uid, STILL, [0, 0, omega], client)
        step(client)
        *_, z, w = p.getBasePositionAndOrientation(uid, client)[1]
        assert (abs(2 * math.atan2(z, w) - omega * 0.01) > 1e-3) is clipped


@BOTH
def test_clipped_turns_are_an_error(build, free, hung, scheme):
    scenes = [free(omega=(0, 0, 90.0))] + ([hung("ball", 90.0)] if scheme == REDUCED else [])
    for scene in scenes:
        build(scene, scheme, 8.7e-3).state()
        with pytest.raises(EngineError, match=r"clips turns .* got 90 rad/s .* take a step below 0.00873 s"):
            build(scene, scheme, 8.8e-3).state()


def test_hinges_may_turn_as_far_as_they_like(build, hung):
    engine = build(hung("hinge", 900.0), dt=1e-2)
    engine.step(10)
    assert engine.state().joint_position[0] == pytest.approx(90.0)


@BOTH
def test_what_is_not_finite_is_an_error_though_pybullet_says_nothing(build, free, scheme):
    engine = build(free(), scheme)
    p.resetBaseVelocity(0, [math.nan, 0, 0], [0, 0, 1], engine._world.client)
    engine.step(1)
    with pytest.raises(EngineError, match="PyBullet left the finite numbers"):
        engine.state()


def test_a_spring_that_runs_away_is_an_error(build, hung):
    engine = build(hung("slide", stiffness=1e8), dt=1e-2)
    engine.step(400)
    with pytest.raises(EngineError, match="PyBullet left the finite numbers"):
        engine.state()


# Where everything is


def test_pybullet_itself_leaves_links_where_they_were(client, load):
    uid = load(joint="continuous", origin='<origin xyz="0 0 0.1"/>')
    p.setJointMotorControl2(uid, 0, p.VELOCITY_CONTROL, force=0, physicsClientId=client)
    p.resetJointState(uid, 0, 0.5, 3.0, client)
    before = p.getLinkState(uid, 0, physicsClientId=client)[0]
    step(client)
    assert p.getLinkState(uid, 0, physicsClientId=client)[0] == before
    assert p.getLinkState(uid, 0, computeForwardKinematics=1, physicsClientId=client)[0] != before


def test_pybullet_itself_tells_frames_of_links_in_single_precision(client, load):
    uid = load(joint="continuous")
    p.resetJointState(uid, 0, 0.5, 0.0, client)
    _, inertial, *_, frame = p.getLinkState(uid, 0, computeForwardKinematics=1, physicsClientId=client)[:6]
    assert inertial[0] == pytest.approx(math.sin(0.25), rel=1e-15)
    assert frame[0] == float(np.float32(frame[0]))
    assert frame[0] != pytest.approx(math.sin(0.25), rel=1e-9)


def test_pybullet_itself_speaks_of_the_inertial_frame(client, load):
    uid = load(origin='<origin xyz="0.1 0.2 0.3" rpy="0.1 0.2 0.3"/>')
    place, turn = p.getBasePositionAndOrientation(uid, client)
    assert place == pytest.approx((0.1, 0.2, 0.3))
    np.testing.assert_allclose(Rotation.from_quat(turn).as_euler("xyz"), [0.1, 0.2, 0.3])
    ball = load(origin='<origin rpy="0 0 1.5707963267948966"/>', joint="spherical")
    p.resetJointStateMultiDof(ball, 0, [0.6, 0, 0, 0.8], [0, 0, 0], client)
    state = p.getLinkState(ball, 0, computeForwardKinematics=1, physicsClientId=client)
    # A turn about the inertial frame's x, which is the link's y.
    np.testing.assert_allclose(state[5], [0, 0.6, 0, 0.8], atol=1e-7)


def test_pybullet_itself_gives_omega_in_world_axes(client, load):
    uid = load()
    p.resetBasePositionAndOrientation(uid, STILL, [0.5, 0.5, 0.5, 0.5], client)
    p.resetBaseVelocity(uid, STILL, [7, 0, 0], client)
    step(client, dt=1e-3)
    turn = Rotation.from_quat(p.getBasePositionAndOrientation(uid, client)[1])
    # About the world's x, which is the body's z and stays where it is; the body's x is the world's y.
    np.testing.assert_allclose(turn.apply([0, 0, 1]), [1, 0, 0], atol=1e-4)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_state_is_that_of_the_coordinates(build, random_tree, links_of, seed):
    scene = random_tree(seed)
    state = build(scene).state()
    expected = equations_of_motion.link_motion(links_of(scene), scene.q0, scene.v0)
    agree(state, expected)
    scalar = [(q.start, v.start) for _, j, q, v in scene.slices() if j.kind in ("hinge", "slide")]
    assert state.joint_position.tolist() == [scene.q0[q] for q, _ in scalar]
    assert state.joint_velocity.tolist() == [scene.v0[v] for _, v in scalar]


@BOTH
def test_the_state_of_a_free_body_is_that_of_its_coordinates(build, free, links_of, scheme):
    scene = free()
    agree(build(scene, scheme).state(), equations_of_motion.link_motion(links_of(scene), scene.q0, scene.v0))


def agree(state, expected):
    position, quaternion, velocity, omega = expected
    # A few roundings of numbers of size 1 to 10 along five links.
    np.testing.assert_allclose(state.position, position, atol=2e-14)
    np.testing.assert_allclose(state.velocity, velocity, atol=1e-13)
    np.testing.assert_allclose(state.omega, omega, atol=1e-13)
    turn = Rotation.from_quat(state.quaternion).inv() * Rotation.from_quat(quaternion)
    np.testing.assert_allclose(turn.magnitude(), 0, atol=1e-14)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_state_is_that_after_the_step(build, random_tree, links_of, seed):
    scene = random_tree(seed)
    engine = build(scene)
    engine.step(100)
    state = engine.state()
    q, v = coordinates(scene, state, engine._world)
    agree(state, equations_of_motion.link_motion(links_of(scene), q, v))


def coordinates(scene, state, world):
    """The scene's coordinates and velocities, from the joints that PyBullet tells of."""
    q, v = np.empty(len(scene.q0)), np.empty(len(scene.v0))
    scalars = iter(zip(state.joint_position, state.joint_velocity, strict=True))
    balls = iter(world.at.balls)
    for (body, joint, at_q, at_v), index in zip(scene.slices(), bodies_of(scene), strict=True):
        if joint.kind in ("hinge", "slide"):
            q[at_q], v[at_v] = next(scalars)
        elif joint.kind == "ball":
            ball = next(balls)
            turn, omega = p.getJointStateMultiDof(ball.uid, ball.link, world.client)[:2]
            axes = Rotation.from_quat(world._carried[ball.carried])
            q[at_q] = (axes * Rotation.from_quat(turn) * axes.inv()).as_quat()
            v[at_v] = axes.apply(omega)
        else:
            turn = Rotation.from_quat(state.quaternion[index])
            arm, omega = turn.apply(body.center_of_mass), turn.apply(state.omega[index])
            q[at_q] = [*(state.position[index] - arm), *state.quaternion[index]]
            v[at_v] = [*(state.velocity[index] - np.cross(omega, arm)), *state.omega[index]]
    return q, v


def bodies_of(scene):
    return [index for index, body in enumerate(scene.bodies) for _ in body.joints]


def test_states_are_copies(build, free):
    engine = build(free())
    before = engine.state()
    kept = bits(before)
    engine.step(10)
    engine.state()
    assert bits(before) == kept


# Steps


def test_pybullet_itself_loses_steps_in_batches(client, load):
    dt, n = 4e-5, 2000

    def motion(batch):
        p.resetSimulation(physicsClientId=client)
        p.setPhysicsEngineParameter(
            fixedTimeStep=dt * batch, numSubSteps=batch if batch > 1 else 0, physicsClientId=client
        )
        uid = load()
        still(uid, client)
        p.resetBaseVelocity(uid, [1, 0, 0], [1, 0.5, 5], client)
        for _ in range(n // batch):
            p.stepSimulation(client)
        return p.getBasePositionAndOrientation(uid, client), p.getBaseVelocity(uid, client)

    one = motion(1)
    assert one[0][0][0] == pytest.approx(n * dt)
    assert all(motion(batch) == one for batch in (2, 8, 16))
    assert motion(250)[0][0][0] == pytest.approx((n - 4) * dt)


def test_pybullet_itself_applies_joint_damping_once_a_batch(client, load):
    def motion(batch):
        p.resetSimulation(physicsClientId=client)
        p.setPhysicsEngineParameter(
            fixedTimeStep=1e-3 * batch, numSubSteps=batch if batch > 1 else 0, physicsClientId=client
        )
        uid = load(joint="continuous")
        still(uid, client)
        p.changeDynamics(uid, 0, jointDamping=0.05, physicsClientId=client)
        p.setJointMotorControl2(uid, 0, p.VELOCITY_CONTROL, force=0, physicsClientId=client)
        p.resetJointState(uid, 0, 0.0, 1.0, client)
        for _ in range(64 // batch):
            p.stepSimulation(client)
        return p.getJointState(uid, 0, client)[1]

    assert motion(1) == pytest.approx((1 - 0.005) ** 64, rel=1e-9)
    assert abs(motion(32) - motion(1)) > 1e-2


def _case(name, free, hung, random_tree):
    return {
        "free": lambda: free(gravity=(0.1, 0.2, -9.81)),
        "ball": lambda: hung("ball", 5.0, (0, 0, -9.81), center_of_mass=(0.01, 0.02, 0.1)),
        "spring": lambda: hung("slide", stiffness=50.0),
        "damper": lambda: hung("hinge", damping=0.01, gravity=(0, -9.81, 0), center_of_mass=(0, 0, 0.1)),
        "tree 0": lambda: random_tree(0),
        "tree 1": lambda: random_tree(1),
    }[name]()


CASES = [
    *((name, REDUCED) for name in ("free", "ball", "spring", "damper", "tree 0", "tree 1")),
    ("free", MAXIMAL),
]


@pytest.mark.parametrize(("name", "scheme"), CASES)
def test_batches_change_no_bit_of_the_motion(build, free, hung, random_tree, name, scheme):
    scene = _case(name, free, hung, random_tree)
    engine = build(scene, scheme, 4e-5)
    for _ in range(1000):
        engine.step(1)
    one_by_one = bits(engine.state())
    for portions in ([1000], [250] * 4, [777, 223], [300, 7, 0, 256, 33, 404], [1, 999]):
        engine = build(scene, scheme, 4e-5)
        for n in portions:
            engine.step(n)
        assert bits(engine.state()) == one_by_one, portions


def test_free_fall_is_that_of_semi_implicit_euler_in_every_batch(build, free):
    engine = build(free(gravity=(0.1, 0.2, -9.81), velocity=STILL, omega=STILL))
    start, n, dt = engine.state().position, 1000, 1e-3
    engine.step(n)
    state = engine.state()
    np.testing.assert_allclose(state.velocity[0], np.multiply((0.1, 0.2, -9.81), n * dt), rtol=1e-12)
    fallen = np.multiply((0.1, 0.2, -9.81), n * (n + 1) / 2 * dt**2)
    np.testing.assert_allclose((state.position - start)[0], fallen, rtol=1e-12)


@pytest.mark.parametrize(("name", "scheme"), CASES)
def test_looking_does_not_disturb_the_motion(build, free, hung, random_tree, name, scheme):
    scene = _case(name, free, hung, random_tree)
    engine = build(scene, scheme)
    engine.step(100)
    unwatched = bits(engine.state())
    engine = build(scene, scheme)
    for _ in range(20):
        engine.step(5)
        engine.state()
        engine.acceleration(np.array(scene.q0), np.array(scene.v0))
    engine.readback()
    assert bits(engine.state()) == unwatched


@pytest.mark.parametrize(("name", "scheme"), CASES)
def test_the_same_cell_gives_the_same_bits(build, free, hung, random_tree, name, scheme):
    scene = _case(name, free, hung, random_tree)

    def motion(engine, dt=1e-3):
        engine.build(scene, SCHEMES[scheme], dt)
        engine.step(300)
        return bits(engine.state())

    engine = build(scene, scheme)
    first = motion(engine)
    assert motion(engine) == first
    other = build(random_tree(5), REDUCED, 7e-4)
    other.step(1000)
    assert motion(engine) == first
    fresh = PyBullet()
    try:
        assert motion(fresh) == first
    finally:
        fresh.close()


def test_engines_do_not_share_a_world(build, free, random_tree):
    alone = build(free())
    alone.step(100)
    expected, other = bits(alone.state()), PyBullet()
    engine = build(free())
    try:
        engine.step(50)
        other.build(random_tree(1), SCHEMES[REDUCED], 1e-3)
        other.step(100)
        engine.step(50)
        assert bits(engine.state()) == expected
    finally:
        other.close()


def closed(scene):
    """The clients of an engine that has built a scene, been read back and closed, twice."""
    engine = PyBullet()
    engine.build(scene, SCHEMES[REDUCED], scene.dt)
    engine.readback()
    clients = list(engine._clients.values())
    engine.close()
    engine.close()
    assert len(clients) == 2
    assert not engine._clients
    return clients


def test_closing_leaves_the_clients_to_the_next(free):
    first = closed(free())
    assert all(p.isConnected(client) for client in first)
    assert set(closed(free())) == set(first)


def test_closing_ends_the_clients_whose_solver_was_set_for_contacts():
    before = closed(scenes()["heavy_top[fast]"])
    assert not any(p.isConnected(client) for client in closed(scenes()["rolling[hoop]"]))
    assert not any(p.isConnected(client) for client in before)  # the same two, taken up and set


def test_a_client_that_was_used_gives_the_bits_of_a_new_one():
    scene = scenes()["heavy_top[fast]"]
    closed(scenes()["rolling[hoop]"])
    new, _ = simulate(scene, PyBullet, SCHEMES[REDUCED], scene.dt, repeats=2)
    for other in ("free_symmetric_top[defaults]", "co2_chain[mixture]", "sleeping_top[0.9]"):
        closed(scenes()[other])
    again, _ = simulate(scene, PyBullet, SCHEMES[REDUCED], scene.dt, repeats=2)
    assert {*again.provenance.digests, *new.provenance.digests} == {new.provenance.digests[0]}
    assert again.provenance.accelerations == new.provenance.accelerations
    assert again.provenance.setup == new.provenance.setup


# What is moved


@pytest.mark.parametrize("seed", SEEDS)
def test_accelerations_are_those_of_the_equations_of_motion(build, random_tree, links_of, seed):
    scene, rng = random_tree(seed), np.random.default_rng(seed)
    engine, links = build(scene), links_of(scene)
    q, v = np.array(scene.q0), rng.normal(size=len(scene.v0))
    expected = equations_of_motion.accelerations(links, q, v, scene.gravity)
    # Solving with the mass matrix multiplies rounding by its condition.
    allowed = 4 * np.finfo(float).eps * np.linalg.cond(equations_of_motion.mass_matrix(links, q))
    assert np.abs(engine.acceleration(q, v) - expected).max() <= allowed * np.abs(expected).max()


@pytest.mark.parametrize("speed", [1e-3, 1.0, 1e3])
def test_accelerations_in_maximal_coordinates_are_a_limit(build, free, links_of, speed):
    scene = free(omega=(0.3 * speed, -1.2 * speed, speed), gravity=(0.1, 0.2, -9.81))
    got = build(scene, MAXIMAL).acceleration(np.array(scene.q0), np.array(scene.v0))
    expected = equations_of_motion.accelerations(links_of(scene), scene.q0, scene.v0, scene.gravity)
    # Rounding of ω, 2e-16, over the shortest step of the extrapolation, 6e-3/ω, is 4e-14 ω²; gravity
    # adds its own.
    np.testing.assert_allclose(got, expected, atol=2e-13 * (speed * 1.6) ** 2 + 4e-15)


def test_an_inertia_off_by_a_millionth_shows(build, free):
    scene = free()
    (xx, *rest), *rows = scene.bodies[0].inertia
    q, v = np.array(scene.q0), np.array(scene.v0)
    right = build(scene).acceleration(q, v)
    wrong = build(free(inertia=((xx * (1 + 1e-6), *rest), *rows))).acceleration(q, v)
    assert np.abs(right - wrong).max() > 1e-7 * np.abs(right).max()


def test_an_acceleration_asks_for_every_coordinate(build, free):
    engine = build(free())
    with pytest.raises(InputError, match=r"q: got an array of shape \(3,\), expected \(7,\)"):
        engine.acceleration(np.zeros(3), np.zeros(6))


# The model


def test_the_model_text_is_what_pybullet_was_given(build, random_tree, client, tmp_path):
    scene = random_tree(3)
    name, text = build(scene).model_text()
    assert name == "model.urdf"
    path = tmp_path / name
    path.write_text(text)
    uid = p.loadURDF(str(path), flags=p.URDF_USE_INERTIA_FROM_FILE, physicsClientId=client)
    masses = {p.getDynamicsInfo(uid, link, client)[0] for link in range(p.getNumJoints(uid, client))}
    assert masses >= {body.mass for body in scene.bodies}


def test_several_trees_are_several_documents(build, scene_of):
    bodies = [Body(name, 1.0, diagonal(1, 1, 1), (Joint(name, "free"),)) for name in "ab"]
    scene = scene_of(bodies, [0, 0, 0, 0, 0, 0, 1] * 2, [0] * 12)
    assert build(scene).model_text()[1].count("<robot ") == 2


# What is printed


IMPORT = "import pybullet"
RUN = """
from poinsot.adapters.pybullet_ import PyBullet
from poinsot.scenarios.registry import scenes
engine = PyBullet()
for name in ("heavy_top[fast]", "free_symmetric_top[oblate]"):
    engine.build(scenes()[name], engine.schemes[0], 1e-3)
    engine.step(300)
    engine.state()
    engine.readback()
engine.close()
print("only this")
"""


@pytest.mark.parametrize(("code", "words"), [(IMPORT, "pybullet build time"), (RUN, "only this")])
def test_nothing_is_printed_but_by_pybullet_itself(code, words):
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True)
    printed = (run.stdout + run.stderr).splitlines()
    assert len(printed) == 1
    assert words in printed[0]


def test_a_process_without_standard_streams_can_run_it():
    run = subprocess.Popen([sys.executable, "-c", f"import os\nos.close(1); os.close(2)\n{RUN[:-19]}"])
    assert run.wait(timeout=60) == os.EX_OK
