"""Contact as the engines are given it: only where a scene asks, all of what it asks, and read back as run."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters.contact_points import touch
from poinsot.adapters.registry import engines
from poinsot.adapters.simulate import simulate, unsupported
from poinsot.reference.errors import InputError
from poinsot.reports.cell import Cell
from poinsot.reports.setup import check
from poinsot.reports.verdict import Status
from poinsot.scenarios.contact import Contact, Plane, Rim, Sphere
from poinsot.scenarios.registry import scenes

BLOW = scenes()["collisions[e=0.5]"]
TOP = scenes()["free_symmetric_top[oblate]"]
TURNED = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


#: Those that are installed.
ENGINES = [engine for engine in engines().values() if not isinstance(engine, str)]


SCHEMES = [(engine, scheme) for engine in ENGINES for scheme in engine.schemes]
#: Those that have contacts; those of a higher order say why they do not.
TOUCHING = pytest.mark.parametrize(
    ("engine", "scheme"),
    [pair for pair in SCHEMES if not unsupported(BLOW, *pair)],
    ids=lambda part: part.name,
)
HIGHER = [pair for pair in SCHEMES if pair[1].order > 1]


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"friction": -1.0}, "friction"),
        ({"restitution": 1.1}, "restitution"),
        ({"friction": 0.1, "restitution": 0.5}, "expected one of them 0"),
        ({"second": "a"}, "the same body twice"),
    ],
)
def test_a_contact_that_cannot_be_is_refused(changes, says):
    given = {"first": "a", "shape": Sphere(1.0), "second": None, "against": Plane()}
    with pytest.raises(InputError, match=says):
        Contact(**(given | changes))


@pytest.mark.parametrize("make", [lambda: Sphere(0.0), lambda: Rim(-1.0), lambda: Plane((0.0, 0.0, 2.0))])
def test_a_shape_that_cannot_be_is_refused(make):
    with pytest.raises(InputError, match="expected"):
        make()


def test_a_scene_names_the_bodies_that_touch():
    with pytest.raises(InputError, match="got body 'ghost', expected one of first, second"):
        replace(BLOW, contacts=(Contact("ghost", Sphere(1.0), None, Plane()),))
    with pytest.raises(InputError, match="expected each pair once"):
        replace(BLOW, contacts=BLOW.contacts * 2)


def test_two_spheres_touch_between_their_centres():
    at, to = np.array([1.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.5])
    found = touch(Sphere(0.2), at, np.eye(3), Sphere(0.2), to, np.eye(3))
    assert found.point == pytest.approx([1.0, 0.0, 0.25])
    assert found.normal == pytest.approx([0.0, 0.0, 1.0])
    assert found.gap == pytest.approx(0.1)


def test_a_sphere_touches_a_plane_that_its_body_carries():
    # The plane's z is the world's x once its body is turned; 0.1 of the plane's offset, 0.3 of the sphere.
    found = touch(Sphere(0.3), np.array([2.0, 5.0, 6.0]), np.eye(3), Plane(offset=0.1), np.ones(3), TURNED)
    assert found.normal == pytest.approx([-1.0, 0.0, 0.0])
    assert found.gap == pytest.approx(2.0 - 1.0 - 0.1 - 0.3)
    assert found.point == pytest.approx([1.7, 5.0, 6.0])


@pytest.mark.parametrize("lean", [0.1, 1.0, np.pi / 2])
def test_a_rim_touches_with_its_lowest_point(lean):
    axis = np.array([np.sin(lean), 0.0, np.cos(lean)])
    turn = np.column_stack([np.cross([0.0, 1.0, 0.0], axis), [0.0, 1.0, 0.0], axis])
    angles = np.linspace(0, 2 * np.pi, 100001)
    circle = np.array([0.0, 0.0, 0.2]) + 0.3 * (
        np.cos(angles)[:, None] * turn[:, 0] + np.sin(angles)[:, None] * turn[:, 1]
    )
    found = touch(Rim(0.3), np.array([0.0, 0.0, 0.2]), turn, Plane(), np.zeros(3), np.eye(3))
    assert found.gap == pytest.approx(circle[:, 2].min(), abs=1e-9)
    assert found.point[2] == pytest.approx(found.gap)
    assert found.normal == pytest.approx([0.0, 0.0, -1.0])


@pytest.mark.parametrize(("engine", "scheme"), HIGHER, ids=lambda part: part.name)
def test_a_scheme_of_higher_order_says_why_it_carries_no_contact(engine, scheme):
    assert "first-order" in unsupported(BLOW, engine, scheme)


def test_every_engine_has_a_scheme_that_carries_contact():
    assert {engine for engine, scheme in SCHEMES if not unsupported(BLOW, engine, scheme)} == set(ENGINES)


@TOUCHING
def test_what_touches_is_sent_apart_as_it_should_be(engine, scheme):
    motion, _ = simulate(BLOW, engine, scheme, 9e-3)
    truth = BLOW.truth(BLOW, motion.t)
    apart = np.diff(motion.velocity[-1], axis=0) - np.diff(truth.velocity[-1], axis=0)
    assert np.linalg.norm(apart) < 0.1
    [verdict] = check(Cell.of(motion, scenes()))
    assert verdict.status is Status.PASS
    asked = motion.provenance.setup
    assert asked["contact/first on second/restitution"] == pytest.approx(0.5, rel=1e-12)
    assert asked["contact/first on second/friction"] == 0.0


@TOUCHING
def test_accelerations_know_no_contact(engine, scheme):
    machine = engine()
    machine.build(BLOW, scheme, 1e-3)
    q = np.array(BLOW.q0)
    q[7:10] = q[:3] + 0.2
    found = machine.acceleration(q, np.array(BLOW.v0))
    machine.close()
    # What is left is PyBullet's rounding in its limit of small steps.
    assert np.abs(found).max() < 1e-9


# Pinocchio's text tells of no shapes: tests/adapters/test_parts.py counts them in the model itself.
@pytest.mark.parametrize(
    "engine", [engine for engine in ENGINES if engine.name != "pinocchio"], ids=lambda engine: engine.name
)
def test_where_nothing_touches_there_are_no_shapes(engine):
    for scene, there in ((TOP, False), (BLOW, True)):
        machine = engine()
        machine.build(scene, engine.schemes[0], 1e-3)
        text = machine.model_text()[1]
        machine.close()
        assert ("sphere" in text) is there
        assert ('contact="disable"' in text) is (engine.name == "mujoco" and not there)


@pytest.mark.skipif(isinstance(engines()["mujoco"], str), reason="MuJoCo is not installed")
def test_mujoco_hops_where_it_is_not_told_that_something_slides():
    scene, engine = scenes()["rolling[slips]"], engines()["mujoco"]
    hopping = replace(scene, contacts=(replace(scene.contacts[0], slides=False),))
    for asked, least, most in ((scene, 0.0, 1e-12), (hopping, 1e-4, 1e-1)):
        motion, _ = simulate(asked, engine, engine.schemes[0], 1e-3)
        off = np.abs(motion.velocity - scene.truth(scene, motion.t).velocity).max()
        assert least <= off < most


def test_bodies_of_two_frictions_are_refused_by_pybullet_alone():
    extra = Contact("first", Sphere(0.1), None, Plane(offset=-5.0), friction=0.5)
    scene = replace(BLOW, contacts=(*BLOW.contacts, extra))
    for engine in ENGINES:
        machine = engine()
        if engine.name == "pybullet":
            with pytest.raises(InputError, match="body 'first' has contacts of different friction"):
                machine.build(scene, engine.schemes[0], 1e-3)
        else:
            machine.build(scene, engine.schemes[0], 1e-3)
        machine.close()


@TOUCHING
@pytest.mark.parametrize("variant", ["hoop", "slips"])
def test_friction_is_read_back_as_run(engine, scheme, variant):
    scene = scenes()[f"rolling[{variant}]"]
    machine = engine()
    machine.build(scene, scheme, 1e-3)
    values = machine.readback().values
    machine.close()
    assert values["contact/wheel on world/friction"] == pytest.approx(scene.contacts[0].friction, rel=1e-12)
    assert values["contact/wheel on world/restitution"] == pytest.approx(0.0, abs=1e-12)


@TOUCHING
def test_the_first_step_meets_the_inertia_of_the_attitude_it_starts_in(engine, scheme):
    # PyBullet's maximal coordinates turn it only at the end of a step: this hoop would start too fast.
    scene = scenes()["rolling[hoop]"]
    machine = engine()
    machine.build(scene, scheme, 8e-3)
    machine.step(1)
    found = machine.state().velocity[0]
    machine.close()
    assert found == pytest.approx(scene.truth(scene, np.array([8e-3])).velocity[0, 0], abs=1e-6)


@pytest.mark.parametrize("engine", ENGINES, ids=lambda engine: engine.name)
def test_only_the_pairs_named_touch(engine):
    # Without its contact each sphere flies on through the other.
    scene = replace(BLOW, contacts=(Contact("first", Sphere(0.1), None, Plane(offset=-50.0)),))
    motion, _ = simulate(scene, engine, engine.schemes[0], 9e-3)
    assert np.ptp(motion.velocity, axis=0).max() < 1e-12
