"""What no body, joint or start can be is refused before an engine sees it; what just can be is not."""

import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from poinsot.reference.errors import InputError
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.contact import Contact, Plane, Sphere
from poinsot.scenarios.registry import scenes

NAN, INF = float("nan"), float("inf")
FREE = Joint("free", "free")
BENCHMARK = Path(__file__).resolve().parents[2] / "benchmarks" / "unphysical_input.py"


def body(**changed):
    return Body(
        **{"name": "b", "mass": 1.0, "inertia": diagonal(0.1, 0.2, 0.25), "joints": (FREE,)} | changed
    )


def turned(moments, seed=0):
    """These principal moments along axes in no special direction."""
    axes = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    tensor = axes @ np.diag(moments) @ axes.T
    return tuple(tuple(row) for row in ((tensor + tensor.T) / 2).tolist())


@pytest.mark.parametrize("mass", [-1.0, -1e-300, 0.0, -0.0, NAN, INF, -INF, "1", b"1", True, None, 1j, [1.0]])
def test_a_mass_that_is_none_is_refused(mass):
    with pytest.raises(InputError, match="body 'b' mass: got"):
        body(mass=mass)


BEYOND = [
    (0.1, 0.2, 0.3 * (1 + 1e-6)), (0.3 * (1 + 1e-6), 0.1, 0.2), (0.1, 0.2, 0.3 * (1 + 1e-12)),
    (1.0, 1.0, 0.0), (1.0, 1.0, -1e-6), (0.0, 0.0, 0.0), (-1.0, -1.0, -1.0), (1e-6, 1e-6, 1.0),
]  # fmt: skip


@pytest.mark.parametrize("moments", BEYOND)
@pytest.mark.parametrize("make", [lambda moments: diagonal(*moments), turned], ids=["along axes", "turned"])
def test_moments_that_no_body_has_are_refused(make, moments):
    with pytest.raises(InputError, match=r"no body has such moments|three moments above 0"):
        body(inertia=make(moments))


@pytest.mark.parametrize(
    "moments",
    [(0.1, 0.2, 0.1 + 0.2), (0.1, 0.2, 0.3), (1.0, 1.0, 1e-6), (1.0, 1.0, 1e-12), (1e-9, 1e-9, 2e-9)],
)
def test_plates_and_needles_are_bodies(moments):
    assert np.diag(body(inertia=diagonal(*moments)).inertia_array).tolist() == list(moments)


def test_plates_are_bodies_at_every_attitude():
    for seed in range(2000):
        I1, I2 = np.random.default_rng(seed).uniform(0.01, 1, 2)
        body(inertia=turned((I1, I2, I1 + I2), seed))


@pytest.mark.parametrize(
    ("inertia", "says"),
    [
        (((1.0, 2.0, 0.0), (2.0, 1.0, 0.0), (0.0, 0.0, 1.0)), "three moments above 0"),
        (((1.0, 2.0, 0.0), (2.0, 3.0, 0.0), (0.0, 0.0, 4.0)), r"got \[-0.236"),
        (((1.0, 0.6, 0.0), (0.6, 1.0, 0.0), (0.0, 0.0, 0.5)), "no body has such moments"),
        (((1.0, 0.1, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), "symmetric"),
        (((1.0, NAN, 0.0), (NAN, 1.0, 0.0), (0.0, 0.0, 1.0)), "finite"),
        (((INF, 0.0, 0.0), (0.0, INF, 0.0), (0.0, 0.0, INF)), "finite"),
        ((1.0, 1.0, 1.0), r"shape \(3,\)"),
        ((("1", 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), "expected numbers"),
    ],
)
def test_a_tensor_that_is_none_is_refused(inertia, says):
    with pytest.raises(InputError, match=says):
        body(inertia=inertia)


@pytest.mark.parametrize(
    "changed",
    [
        {"center_of_mass": (0.0, 0.0, NAN)}, {"center_of_mass": (0.0, 0.0)}, {"position": (INF, 0.0, 0.0)},
        {"quaternion": (0.0, 0.0, 0.0, 0.0)}, {"quaternion": (0.0, 0.0, 0.0, 1.0 + 1e-8)},
        {"quaternion": (0.0, 0.0, 0.0, NAN)}, {"quaternion": (0.0, 0.0, 1.0)},
    ],
)  # fmt: skip
def test_a_place_that_is_none_is_refused(changed):
    (name,) = changed
    with pytest.raises(InputError, match=f"body 'b' {name}: got"):
        body(joints=(Joint("ball", "ball"),), **changed)


@pytest.mark.parametrize(
    "changed",
    [
        {"axis": (0.0, 0.0, 0.0)}, {"axis": (0.0, 0.0, 2.0)}, {"axis": (0.0, 0.0, NAN)}, {"axis": (0.0, 1.0)},
        {"stiffness": -1.0}, {"stiffness": NAN}, {"stiffness": INF}, {"damping": -1e-9}, {"damping": NAN},
    ],
)  # fmt: skip
def test_a_joint_that_is_none_is_refused(changed):
    (name,) = changed
    with pytest.raises(InputError, match=f"joint 'j' {name}: got"):
        Joint("j", "hinge", **changed)


@pytest.mark.parametrize(
    ("part", "says"),
    [
        (lambda: Sphere(0.0), "sphere radius"),
        (lambda: Sphere(NAN), "sphere radius"),
        (lambda: Plane((0.0, 0.0, 0.0)), "plane normal"),
        (lambda: Plane(offset=INF), "plane offset"),
        (lambda: Contact("a", Sphere(1.0), None, Plane(), friction=-0.1), "friction"),
        (lambda: Contact("a", Sphere(1.0), None, Plane(), restitution=1 + 1e-12), "restitution"),
        (lambda: Contact("a", Sphere(1.0), None, Plane(), restitution=NAN), "restitution"),
    ],
)
def test_a_contact_that_is_none_is_refused(part, says):
    with pytest.raises(InputError, match=says):
        part()


TOP = scenes()["free_symmetric_top[oblate]"]


@pytest.mark.parametrize(
    ("changed", "says"),
    [
        ({"q0": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)}, "unit quaternion"),
        ({"q0": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1 + 1e-8)}, "unit quaternion"),
        ({"q0": (NAN, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)}, "q0"),
        ({"v0": (0.0, 0.0, 0.0, 0.0, 0.0, INF)}, "v0"),
        ({"v0": (0.0, 0.0, 0.0)}, "v0"),
        ({"gravity": (0.0, 0.0, NAN)}, "gravity"),
        ({"dt": 0.0}, "dt"),
        ({"dt": -1e-3}, "dt"),
        ({"duration": -1.0}, "duration"),
        ({"samples": 0}, "samples"),
    ],
)
def test_a_start_or_a_step_that_is_none_is_refused(changed, says):
    with pytest.raises(InputError, match=f"free_symmetric_top.*{says}"):
        replace(TOP, **changed)


def test_what_engines_were_tried_with_is_refused_here():
    """The input whose fate in each engine is on record, but what is a body after all."""
    tried = runpy.run_path(str(BENCHMARK))
    accepted = set()
    for name, changed in tried["CASES"].items():
        case = tried["SOUND"] | changed
        tensor = np.diag([float(moment) for moment in case["moments"]])
        tensor[0, 1] = tensor[1, 0] = case["products"][0]
        try:
            joint = (
                Joint("j", "hinge", tuple(map(float, case["axis"]))) if case["axis"] else Joint("j", "ball")
            )
            inertia, turn = tuple(map(tuple, tensor.tolist())), tuple(map(float, case["turn"]))
            Body("b", float(case["mass"]), inertia, (joint,), quaternion=turn)
        except InputError:
            continue
        accepted.add(name.split(",")[0])
    assert accepted == {"a sound body", "a plate", "a plate whose I3 is rounded up an ulp", "a needle"}
