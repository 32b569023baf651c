"""The same system said in other words moves the same: in other units, turned, with other axes, cut in two."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
pytest.importorskip("pybullet")

from poinsot.adapters import registry
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.simulate import simulate, unsupported
from poinsot.reference.errors import InputError
from poinsot.scenarios import equivalents
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.registry import scenes

#: A turn about no axis in particular, and factors that are no powers of anything.
TURN = (0.3219, -0.5365, 0.2146, 0.7500)
TURN = tuple((np.array(TURN) / np.linalg.norm(TURN)).tolist())
WAYS = {
    "scaled": lambda scene: equivalents.scaled(scene, length=3.7, mass=0.13, time=2.1),
    "turned": lambda scene: equivalents.turned(scene, TURN),
    "reaxed": lambda scene: equivalents.reaxed(scene, TURN),
    "cut": lambda scene: equivalents.cut(scene, 0.25, TURN),
}
SCENES = (
    "free_asymmetric_top[general]", "heavy_top[moderate]", "double_pendulum[small]", "co2_chain[mixture]",
    "hanging_gyroscope[steady]", "gyrostat", "two_body[kepler e=0.1]", "coriolis_fall[thrown]",
    "collisions[e=1]",
)  # fmt: skip
STEPS, SAMPLES = 100, 10
#: Rounding of other numbers, over 100 steps.
SAME = 1e-12


def short(scene):
    return replace(scene, duration=STEPS * scene.dt, samples=SAMPLES, reactions=())


def motion(scene, engine, scheme):
    return simulate(scene, engine, scheme, scene.dt)[0]


def size(values):
    return float(np.abs(values).max(initial=0.0))


def apart(a, b):
    """The largest difference of two motions, each part by its own size, or what it does over the run."""
    run, reach = a.t[-1], size(a.position) or 1.0
    turns = np.minimum(
        np.abs(a.quaternion - b.quaternion), np.abs(a.quaternion + b.quaternion).max(-1)[..., None]
    )
    parts = (
        size(a.position - b.position) / reach,
        size(a.velocity - b.velocity) / max(size(a.velocity), reach / run),
        size(a.omega - b.omega) / max(size(a.omega), 1 / run),
        size(turns),
        size(a.joint_position - b.joint_position) / (size(a.joint_position) or 1.0),
    )
    return float(np.max(parts))  # no number, where one of them is none


def distance(way, scene, engine, scheme):
    """How far the motion said in another way is apart, or ``None`` where it cannot be said or run so."""
    scene = short(scenes()[scene])
    try:
        same = WAYS[way](scene)
    except InputError:
        return None
    if unsupported(scene, engine, scheme) or unsupported(same.scene, engine, scheme):
        return None
    return apart(motion(scene, engine, scheme), same.back(motion(same.scene, engine, scheme)))


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("way", WAYS)
def test_every_scheme_moves_the_same_in_other_words(scene, way):
    found = {
        (name, scheme.name): distance(way, scene, registry.load(name), scheme)
        for name in ("mujoco", "pybullet", "pinocchio")
        for scheme in registry.load(name).schemes
    }
    assert {place: far for place, far in found.items() if far is not None and not far <= SAME} == {}


def test_each_way_is_gone_by_some_scheme_in_most_scenes():
    scheme = MuJoCo.schemes[0]
    for way in WAYS:
        assert sum(distance(way, scene, MuJoCo, scheme) is not None for scene in SCENES) >= 4, way


class Mistaken(MuJoCo):
    """Builds something else, and says that it did not."""

    def build(self, scene, scheme, dt):
        super().build(self.mistaken(scene), scheme, dt)


class DownIsZ(Mistaken):
    """Takes gravity's size, and z for its direction."""

    def mistaken(self, scene):
        return replace(scene, gravity=(0.0, 0.0, -float(np.linalg.norm(scene.gravity))))


class DiagonalOnly(Mistaken):
    """Leaves out products of inertia."""

    def mistaken(self, scene):
        bodies = [replace(body, inertia=diagonal(*np.diag(body.inertia_array))) for body in scene.bodies]
        return replace(scene, bodies=tuple(bodies))


class Weightless(Mistaken):
    """Takes nearly all mass from what is welded."""

    def mistaken(self, scene):
        bodies = [body if body.joints else replace(body, mass=1e-3 * body.mass) for body in scene.bodies]
        return replace(scene, bodies=tuple(bodies))


class Clamped(MuJoCo):
    """Lets nothing turn faster than 8 rad/s."""

    def step(self, n):
        for _ in range(n):
            super().step(1)
            np.clip(self._data.qvel, -8, 8, out=self._data.qvel)


@pytest.mark.parametrize(
    ("engine", "way", "scene"),
    [
        (DownIsZ, "turned", "heavy_top[moderate]"),
        (DiagonalOnly, "reaxed", "free_asymmetric_top[general]"),
        (Weightless, "cut", "double_pendulum[small]"),
    ],
)
def test_an_engine_that_knows_one_way_alone_is_caught(engine, way, scene):
    # In the scene as it is, it does nothing wrong.
    assert apart(*(motion(short(scenes()[scene]), one, MuJoCo.schemes[0]) for one in (MuJoCo, engine))) < SAME
    assert distance(way, scene, engine, engine.schemes[0]) > 1e-3


def test_a_hidden_clamp_shows_in_faster_units():
    scene = short(scenes()["free_asymmetric_top[general]"])
    fast = equivalents.scaled(scene, time=2**-4)
    runs = (motion(scene, Clamped, MuJoCo.schemes[0]), motion(fast.scene, Clamped, MuJoCo.schemes[0]))
    assert apart(runs[0], fast.back(runs[1])) > 1e-3


def test_powers_of_two_change_no_bit_but_their_own():
    scene = short(scenes()["double_pendulum[small]"])
    other = equivalents.scaled(scene, 2.0**10, 2.0**-20, 2.0**5)
    a = motion(scene, MuJoCo, MuJoCo.schemes[0])
    b = other.back(motion(other.scene, MuJoCo, MuJoCo.schemes[0]))
    for name in ("position", "quaternion", "velocity", "omega", "joint_position"):
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name), err_msg=name)


@pytest.mark.parametrize(
    ("way", "scene", "says"),
    [
        (WAYS["turned"], "rolling[hoop]", "contacts with the world"),
        (WAYS["reaxed"], "rolling[hoop]", "got contacts"),
        (WAYS["cut"], "rocket", "forces on masses"),
        (lambda scene: equivalents.scaled(scene, mass=0.0), "rocket", "mass"),
        (lambda scene: equivalents.scaled(scene, time=float("nan")), "rocket", "time"),
        (lambda scene: equivalents.turned(scene, (0.0, 0.0, 0.0, 2.0)), "heavy_top[fast]", "unit quaternion"),
    ],
)
def test_what_cannot_be_said_in_other_words_is_refused(way, scene, says):
    with pytest.raises(InputError, match=says):
        way(scenes()[scene])


def test_the_units_of_springs_dampers_and_slides_are_theirs(scene_of):
    joints = (
        Joint("slide", "slide", stiffness=5.0, damping=0.3),
        Joint("hinge", "hinge", (1.0, 0.0, 0.0), 7.0, 0.2),
    )
    body = Body("b", 1.5, diagonal(0.1, 0.2, 0.25), joints, (0.1, -0.2, 0.3))
    scene = scene_of([body], [0.3, -0.7], [1.0, 2.0])
    scheme = MuJoCo.schemes[0]
    same = equivalents.scaled(scene, 3.0, 0.2, 7.0)
    a, b = motion(scene, MuJoCo, scheme), same.back(motion(same.scene, MuJoCo, scheme))
    assert apart(a, b) < SAME
    assert size(a.joint_position[:, 0] - b.joint_position[:, 0]) < SAME
    assert size(a.joint_velocity - b.joint_velocity) < 10 * SAME
