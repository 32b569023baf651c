"""Two spheres that meet: the truth against Newton's laws, and engines that would get the blow wrong."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import collisions as laws
from poinsot.reports.cell import Cell
from poinsot.reports.truth import check
from poinsot.reports.verdict import Status
from poinsot.scenarios import collisions, mechanics
from poinsot.scenarios.trajectory import Provenance

EVERY = pytest.mark.parametrize("scene", collisions.SCENES, ids=lambda scene: scene.full_name)
ELASTIC = collisions.SCENES[2]


def judged(scene, motion, dt=1e-3):
    run = Provenance(scene.full_name, "engine", "1", "Euler", 1, "semi-implicit Euler", dt, 1296)
    return {v.observable for v in check(Cell(scene, motion, run)) if v.status is not Status.PASS}


def stepped(scene, dt=1e-3, **wrong):
    """The scheme by hand, with a blow of a push or a rub of its own."""
    push, rub = wrong.get("push", 0.0), wrong.get("rub", 0.0)
    x, v = ([np.array(part[i : i + 3]) for i in at] for part, at in ((scene.q0, (0, 7)), (scene.v0, (0, 6))))
    places, speeds = [np.array(x)], [np.array(v)]
    for step in range(round(scene.duration / dt)):
        apart, met = x[1] - x[0], v[1] - v[0]
        if np.linalg.norm(apart) < sum(collisions.RADII) and apart @ met < -1e-12:
            normal = apart / np.linalg.norm(apart) + rub * met
            blow = laws.collide(*collisions.MASSES, *v, scene.contacts[0].restitution, normal)
            depth = sum(collisions.RADII) - np.linalg.norm(apart)
            v = [blow.v1 - push * depth / dt * apart, blow.v2]
        x = [place + dt * speed for place, speed in zip(x, v, strict=True)]
        if (step + 1) % scene.steps_per_sample(dt) == 0:
            places.append(np.array(x))
            speeds.append(np.array(v))
    spun = scene.truth(scene, scene.sample_times())
    return replace(spun, position=np.array(places), velocity=np.array(speeds))


@EVERY
def test_the_blow_obeys_newtons_laws_and_nothing_else_happens(scene):
    t = np.array([0.0, collisions.MEETING - 1e-9, collisions.MEETING + 1e-9, scene.duration])
    m = scene.truth(scene, t)
    apart = m.position[:, 1] - m.position[:, 0]
    assert np.linalg.norm(apart[1]) == pytest.approx(sum(collisions.RADII), abs=1e-8)
    assert np.linalg.norm(apart, axis=1).min() > sum(collisions.RADII) - 1e-8
    normal, met, parted = collisions.NORMAL, *(np.diff(m.velocity[i], axis=0)[0] for i in (1, 2))
    assert parted @ normal == pytest.approx(-scene.contacts[0].restitution * (met @ normal), abs=1e-13)
    assert parted - (parted @ normal) * normal == pytest.approx(met - (met @ normal) * normal, abs=1e-13)
    assert m.omega == pytest.approx(np.broadcast_to(m.omega[0], m.omega.shape), abs=0)
    for name in ("momentum", "angular_momentum_world"):
        kept = getattr(mechanics, name)(scene, m)
        assert kept == pytest.approx(np.broadcast_to(kept[0], kept.shape), abs=1e-13)


@EVERY
def test_numbers_of_the_blow_are_those_of_the_closed_forms(scene):
    m = scene.truth(scene, scene.sample_times())
    for observable, value in zip(
        scene.observables[4:7],
        (collisions._blow(scene, m), collisions._kept(scene, m), collisions._turned(scene, m)),
        strict=True,
    ):
        assert value == pytest.approx(observable.scale(scene, m), rel=1e-13), observable.name
    v1, v2 = (np.array(v) for v in collisions.VELOCITIES)
    lost = laws.collide(
        *collisions.MASSES, v1, v2, scene.contacts[0].restitution, collisions.NORMAL
    ).energy_lost
    T = mechanics.kinetic_energy(scene, m)
    assert T[0] - T[-1] == pytest.approx(lost, abs=1e-13)


@EVERY
def test_every_blow_falls_in_the_middle_of_a_step(scene):
    for dt in scene.ladder(1):
        assert (collisions.MEETING / dt) % 1 == pytest.approx(0.5, abs=1e-9)


@EVERY
def test_the_scheme_by_hand_is_the_schemes_own_motion(scene):
    assert judged(scene, stepped(scene)) == set()


@pytest.mark.parametrize(
    ("wrong", "seen"),
    [
        # Pushed out of the depth it met in, a body parts too fast.
        ({"push": 0.2}, {"1 + e", "energy kept", "momentum"}),
        # A blow that is not along the line of centres turns what it should not.
        ({"rub": 0.01}, {"angle of scattering", "angular momentum"}),
    ],
)
def test_a_wrong_blow_is_seen(wrong, seen):
    assert seen <= judged(ELASTIC, stepped(ELASTIC, **wrong))


def test_smooth_bodies_that_rub_are_seen():
    m = stepped(ELASTIC)
    omega = m.omega.copy()
    omega[5:, 0] += 1e-3
    assert {"omega", "angular momentum"} <= judged(ELASTIC, replace(m, omega=omega))


@EVERY
def test_spheres_that_pass_through_each_other_are_seen(scene):
    truth = scene.truth(scene, scene.sample_times())
    missed = replace(truth, velocity=np.broadcast_to(truth.velocity[:1], truth.velocity.shape))
    assert "1 + e" in judged(scene, missed)
