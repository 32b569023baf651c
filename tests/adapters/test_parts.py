"""Every engine's model of every scene holds what the scene names, by the engine's own count, and no more."""

import functools

import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
pytest.importorskip("pybullet")

from poinsot.adapters import pybullet_, pybullet_loading, registry
from poinsot.adapters.mujoco_ import MuJoCo, mujoco
from poinsot.adapters.pinocchio_ import Pinocchio, pin
from poinsot.adapters.pybullet_ import PyBullet
from poinsot.adapters.simulate import simulate, unsupported
from poinsot.reports import setup
from poinsot.reports.cell import Cell
from poinsot.reports.verdict import Status
from poinsot.scenarios.parts import BUILT, PARTS, parts
from poinsot.scenarios.registry import scenes

#: What an engine does not tell, each for a reason that its file of parts gives.
UNTOLD = {
    "mujoco": set(),
    "pybullet": {"pairs", "contact solver", "sleeping", "solids"},
    "pinocchio": {"sleeping", "pictures", "solids"},
}
#: A hinge, a ball, a free body and what touches: each kind of thing that a wrong engine may add to.
ARM, TOP, FREE, TOUCHING = (
    "double_pendulum[small]",
    "heavy_top[moderate]",
    "orbit_and_spin[flying]",
    "rolling[hoop]",
)


def built(engine, scene, scheme):
    machine = engine()
    try:
        machine.build(scene, scheme, scene.dt)
        told = machine.readback().values
    finally:
        machine.close()
    return {name.removeprefix(BUILT): told[name] for name in told if name.startswith(BUILT)}


@pytest.mark.parametrize("name", ["mujoco", "pybullet", "pinocchio"])
@pytest.mark.parametrize("scene", scenes().values(), ids=lambda scene: scene.full_name)
def test_a_model_holds_what_its_scene_names_and_no_more(scene, name):
    engine = registry.load(name)
    for scheme in engine.schemes:
        if unsupported(scene, engine, scheme):
            continue
        asked = {part: count for part, count in parts(scene).items() if part not in UNTOLD[name]}
        if scene.defaults and name == "pybullet":  # whose joints come with a motor each
            asked["actuators"] = sum(joint.kind != "free" for joint in scene.joints)
        assert built(engine, scene, scheme) == asked, scheme.name


def test_every_part_is_told_by_an_engine():
    assert set(PARTS) == set().union(*(PARTS.keys() - untold for untold in UNTOLD.values()))
    assert set(parts(scenes()[ARM])) == set(PARTS)


def changed(spec_change):
    """MuJoCo with something more in the model than it was asked for."""

    class Laden(MuJoCo):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            spec_change(self._spec)
            self._model = self._spec.compile()
            self._begin()

    return Laden


def ground(spec):
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1], pos=[0, 0, -100])


def look(spec):
    spec.bodies[1].add_geom(size=[0.1, 0, 0], mass=0, contype=0, conaffinity=0)


def touch(spec):
    spec.bodies[1].add_geom(size=[0.1, 0, 0], mass=0)


def collide(spec):
    spec.option.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_CONTACT)


def drive(spec):
    actuator = spec.add_actuator(target=spec.joints[0].name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    actuator.gainprm[0] = 1


def feel(spec):
    spec.add_sensor(type=mujoco.mjtSensor.mjSENS_CLOCK)


def hold(spec):
    spec.add_equality(
        type=mujoco.mjtEq.mjEQ_CONNECT, name1=spec.bodies[1].name, objtype=mujoco.mjtObj.mjOBJ_BODY
    )


def light(spec):
    spec.worldbody.add_light()


def air(spec):
    spec.option.density = 1.2


def rotor(spec):
    spec.joints[0].armature = 1e-9


def rub(spec):
    spec.joints[0].frictionloss = 1e-9


def spot(spec):
    spec.worldbody.add_site()


def energy(spec):
    spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)


def sleepy(spec):
    spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SLEEP)


def bound(spec):
    spec.joints[0].limited, spec.joints[0].range = True, [-3, 3]


MUJOCO_ADDS = {
    ground: {"shapes"}, look: {"pictures"}, touch: {"shapes"}, collide: {"contact solver"},
    drive: {"actuators"}, feel: {"sensors"}, hold: {"constraints"}, light: {"pictures"}, air: {"others"},
    rotor: {"others"}, rub: {"others"}, spot: {"others"}, energy: {"others"}, sleepy: {"sleeping"},
    bound: {"constraints"},
}  # fmt: skip


class Loaded(PyBullet):
    """Has something more in its world than it was asked for."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self.add(functools.partial(getattr, pybullet_.p), {"physicsClientId": self._world.client})


class Grounded(Loaded):
    def add(self, p, where):
        p("createMultiBody")(0, p("createCollisionShape")(p("GEOM_PLANE"), **where), **where)


class Seen(Loaded):
    def add(self, p, where):
        look = p("createVisualShape")(p("GEOM_SPHERE"), radius=0.1, **where)
        p("createMultiBody")(0, -1, look, **where)


class Tied(Loaded):
    def add(self, p, where):
        p("createConstraint")(0, -1, -1, -1, p("JOINT_POINT2POINT"), [0, 0, 0], [0, 0, 0], [0, 0, 0], **where)


class Burdened(Loaded):
    def add(self, p, where):
        p("createMultiBody")(1.0, **where)


class WithShapes(PyBullet):
    """Gives every link a shape, as URDFs mostly do."""

    def build(self, scene, scheme, dt):
        plain = pybullet_loading.urdf
        shape = '  <collision><geometry><sphere radius="0.01"/></geometry></collision>\n</link>'
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(pybullet_loading, "urdf", lambda *of: plain(*of).replace("</link>", shape))
            super().build(scene, scheme, dt)


class Busy(PyBullet):
    """Has something at work in its joints, in the copy of the scene that is tried out too."""

    def build(self, scene, scheme, dt):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(pybullet_, "quieted", functools.partial(self.awake, pybullet_loading.quieted))
            super().build(scene, scheme, dt)

    def readback(self):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(pybullet_, "quieted", functools.partial(self.awake, pybullet_loading.quieted))
            return super().readback()


class Motored(Busy):
    """Leaves on the motors that PyBullet's joints are born with."""

    def awake(self, quieted, p, client, uid, scene):
        for link in range(p.getNumJoints(uid, client)):
            yield p.getJointInfo(uid, link, client)[1].decode(), (uid, link)


class Driven(Busy):
    """Has one weak motor."""

    def awake(self, quieted, p, client, uid, scene):
        yield from quieted(p, client, uid, scene)
        p.setJointMotorControl2(uid, 0, p.VELOCITY_CONTROL, force=1e-9, physicsClientId=client)


class Sensing(Busy):
    """Has a sensor of force in the first joint of each tree."""

    def awake(self, quieted, p, client, uid, scene):
        p.enableJointForceTorqueSensor(uid, 0, 1, client)
        yield from quieted(p, client, uid, scene)


class Framed(Pinocchio):
    """Has a frame more than it has bodies."""

    kind = pin.FrameType.OP_FRAME

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._model.addFrame(pin.Frame("more", 1, pin.SE3.Identity(), self.kind))


class Felt(Framed):
    kind = pin.FrameType.SENSOR


class Geared(Pinocchio):
    """Has a rotor in its first joint."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._model.armature[0] = 1e-9


class Colliding(Pinocchio):
    """Solves for contacts in a scene that has none."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._contacts = type("Idle", (), {"pairs": []})()


OTHERS = [
    (Grounded, {"shapes"}), (Seen, {"pictures"}), (Tied, {"constraints"}),
    (Burdened, {"bodies", "joints", "coordinates"}), (WithShapes, {"shapes"}), (Driven, {"actuators"}),
    (Sensing, {"sensors"}), (Framed, {"others"}), (Felt, {"sensors"}), (Geared, {"actuators"}),
    (Colliding, {"contact solver"}),
]  # fmt: skip


def surplus(engine, scene):
    """The parts of which an engine has another number than the scene needs, as its setup check names them."""
    run, _ = simulate(scenes()[scene], engine, engine.schemes[0], 0.01)
    verdicts = setup.check(Cell.of(run, scenes()))
    wrong = {v.observable.removeprefix(BUILT) for v in verdicts if v.status is Status.FAIL}
    return wrong & set(PARTS)


@pytest.mark.parametrize("add", MUJOCO_ADDS, ids=lambda add: add.__name__)
def test_whatever_more_is_in_a_mujoco_model_is_named(add):
    assert surplus(changed(add), ARM) == MUJOCO_ADDS[add]


@pytest.mark.parametrize(("engine", "named"), OTHERS, ids=lambda part: getattr(part, "__name__", ""))
def test_whatever_more_is_in_a_model_is_named(engine, named):
    assert surplus(engine, ARM) == named


@pytest.mark.parametrize("scene", [ARM, TOP, FREE, TOUCHING])
@pytest.mark.parametrize("engine", [MuJoCo, PyBullet, Pinocchio])
def test_an_engine_that_adds_nothing_passes(engine, scene):
    assert surplus(engine, scene) == set()


def test_the_balls_of_pybullet_are_seen_to_be_motored():
    assert surplus(Motored, TOP) == {"actuators"}


def test_a_shape_too_many_is_seen_in_maximal_coordinates():
    scheme = PyBullet.schemes[1]
    asked = parts(scenes()[FREE])
    assert built(WithShapes, scenes()[FREE], scheme)["shapes"] == asked["shapes"] + 1


def test_the_message_says_how_many_there_are_and_are_needed():
    run, _ = simulate(scenes()[ARM], changed(drive), MuJoCo.schemes[0], 0.01)
    (verdict,) = setup.check(Cell.of(run, scenes()))
    assert verdict.message == "actuators, and motors that push: the model has 1, the scene needs 0"
    assert verdict.observable == "built/actuators"
