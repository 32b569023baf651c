"""Forces from outside the joints, in every engine: at every stage, with nothing left behind."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters import registry
from poinsot.adapters.simulate import simulate, unsupported
from poinsot.reference import equations_of_motion
from poinsot.scenarios.blows import Blow
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.forces import Attraction, Center, Centrifugal, Constant, Coriolis, Spring, forces_on
from poinsot.scenarios.scene import Scene

ENGINES = [engine for engine in registry.engines().values() if not isinstance(engine, str)]
CELLS = pytest.mark.parametrize(
    ("engine", "scheme"),
    [(engine, scheme) for engine in ENGINES for scheme in engine.schemes],
    ids=lambda part: part.name,
)
FOURTH = [(engine, scheme) for engine in ENGINES for scheme in engine.schemes if scheme.order == 4]
TURN = (0.5, -0.5, 0.1, 0.7)
FORCES = (
    Constant("second", (1.0, -2.0, 3.0)),
    Spring("first", "second", 30.0, 0.5),
    Attraction("first", "second", 4.0),
    Center(5.0, (0.3, 2.0, -1.0)),
    Coriolis((0.4, -0.7, 1.1)),
    Centrifugal((0.4, -0.7, 1.1), (0.2, 0.1, -0.3)),
)


def unit(q):
    return tuple((np.array(q) / np.linalg.norm(q)).tolist())


def scene(bodies, q0, v0, forces):
    return Scene("pushed", "", "", bodies, q0, v0, 1.0, 10, truth=None, observables=(), forces=forces)


def free_pair(forces=FORCES):
    """Two free bodies, off their frames' origins where an engine must then say so to turn them."""
    bodies = tuple(
        Body(name, m, diagonal(0.1, 0.12, 0.2), (Joint(name, "free"),))
        for name, m in (("first", 2.0), ("second", 3.0))
    )
    q0 = (0.1, 0.2, 0.3, *unit(TURN), -1.0, 0.5, 1.2, *unit((0.2, 0.6, -0.6, 0.4)))
    return scene(bodies, q0, (1.0, -0.5, 0.3, 1.0, 2.0, -1.0, 0.2, 0.6, -0.4, -2.0, 0.5, 1.5), forces)


def jointed_pair(forces=FORCES):
    """A ball joint, and on it a slide and a hinge; centres of mass off the joints."""
    first = Body(
        "first", 2.0, diagonal(0.1, 0.12, 0.2), (Joint("ball", "ball"),), center_of_mass=(0.1, -0.2, 0.4)
    )
    joints = (
        Joint("slide", "slide", (0.6, 0.8, 0.0), stiffness=20.0),
        Joint("hinge", "hinge", (0.0, 1.0, 0.0)),
    )
    second = Body(
        "second", 3.0, diagonal(0.3, 0.2, 0.2), joints, (0.0, 0.3, 0.2), "first", (0.5, 0.1, 0.2), unit(TURN)
    )
    q0 = (*unit((0.2, 0.6, -0.6, 0.4)), 0.2, 0.7)
    return scene((first, second), q0, (1.0, -2.0, 0.5, 0.4, -1.5), forces)


@CELLS
@pytest.mark.parametrize("make", [free_pair, jointed_pair])
@pytest.mark.parametrize("force", [*FORCES, None], ids=lambda force: type(force).__name__)
def test_accelerations_are_those_of_the_equations_of_motion(engine, scheme, make, force, links_of):
    pushed = make((force,) if force else FORCES)
    if unsupported(pushed, engine, scheme):
        pytest.skip("lacks joints")
    machine = engine()
    machine.build(pushed, scheme, 1e-3)
    q, v, links = np.array(pushed.q0), np.array(pushed.v0), links_of(pushed)
    position, _, velocity, _ = (part[0] for part in equations_of_motion.link_motion(links, q[None], v[None]))
    forces = forces_on(pushed.bodies, pushed.forces)(position, velocity)
    expected = equations_of_motion.accelerations(links, q, v, pushed.gravity, forces=forces)
    got = machine.acceleration(q, v)
    machine.close()
    # PyBullet's maximal coordinates are extrapolated: good to 1e-13 ω².
    assert np.abs(got - expected).max() < 1e-11 * max(1.0, np.abs(expected).max())


@pytest.mark.parametrize("make", [free_pair, jointed_pair])
def test_twins_agree(make):
    pushed, ends = make(), {}
    for engine in ENGINES:
        for scheme in engine.schemes:
            if not unsupported(pushed, engine, scheme):
                motion, _ = simulate(pushed, engine, scheme, 1e-3)
                ends.setdefault(scheme.twin, []).append(motion.position[-1])
    assert len(ends["semi-implicit Euler"]) == len(ENGINES)
    for found in ends.values():
        # A thousand steps of rounding, grown by what is a smooth motion.
        assert np.ptp(np.array(found), axis=0).max() < 1e-11


@pytest.mark.parametrize(("engine", "scheme"), FOURTH, ids=lambda part: part.name)
@pytest.mark.parametrize("make", [free_pair, jointed_pair])
def test_runge_kutta_takes_forces_at_every_stage(engine, scheme, make):
    steps = (2.5e-3, 1.25e-3, 6.25e-4)
    ends = [simulate(make(), engine, scheme, dt)[0].position[-1] for dt in steps]
    coarse, fine = (np.abs(np.diff(pair, axis=0)).max() for pair in (ends[:2], ends[1:]))
    # 16 in the limit; 2 if forces stood still over a step, 8 at the next order below.
    assert 12 < coarse / fine < 32


@CELLS
def test_forces_stay_with_the_scene_that_asked_for_them(engine, scheme):
    pushed, still = free_pair(), free_pair(())
    before, _ = simulate(still, engine, scheme, 1e-2)
    one, other = engine(), engine()
    one.build(pushed, scheme, 1e-2)
    other.build(still, scheme, 1e-2)
    for _ in range(10):
        one.step(10)
        other.step(10)
    np.testing.assert_array_equal(other.state().position, before.position[-1])
    assert np.abs(one.state().position - before.position[-1]).max() > 0.1
    one.build(still, scheme, 1e-2)
    one.step(100)
    np.testing.assert_array_equal(one.state().position, before.position[-1])
    one.close()
    other.close()


@CELLS
def test_what_is_read_back_is_as_without_forces(engine, scheme):
    machine, found = engine(), []
    for forces in ((), FORCES):
        machine.build(free_pair(forces), scheme, 1e-3)
        found.append({name: np.asarray(value).tolist() for name, value in machine.readback().values.items()})
    machine.close()
    assert found[0] == found[1]


@pytest.mark.parametrize("force", FORCES, ids=lambda force: type(force).__name__)
def test_a_force_is_the_slope_of_its_energy(force):
    pushed = free_pair((force,))
    position = np.array([pushed.q0[:3], pushed.q0[7:10]])
    got = forces_on(pushed.bodies, (force,))(position, np.zeros((2, 3)))
    h = 1e-5
    for body, axis in np.ndindex(2, 3):
        shift = np.zeros((2, 3))
        shift[body, axis] = h
        up, down = (force.potential(pushed.bodies, (position + sign * shift)[None])[0] for sign in (1, -1))
        # The difference quotient is off by h²/6 of a third derivative and by the rounding of energies over h.
        assert got[body, axis] == pytest.approx((down - up) / (2 * h), abs=1e-7)


def test_a_force_is_part_of_the_logged_scene():
    assert '"length": 0.5' in free_pair().as_json()
    assert '"force"' not in free_pair(()).as_json()


def test_a_force_on_a_body_that_is_not_there_is_refused():
    with pytest.raises(Exception, match="force: got body 'third', expected one of first, second"):
        replace(free_pair(), forces=(Constant("third", (1.0, 0.0, 0.0)),))


@CELLS
def test_a_blow_gives_its_impulse_and_nothing_before_or_after(engine, scheme):
    # Two of them, one upon the other, on the second of two free bodies, nothing else at work; called for at
    # once, in pieces, and after accelerations were asked for, which all blows take part in.
    blows = (Blow("second", (3.0, 0.0, -6.0), 0.2, 0.4), Blow("second", (0.0, 9.0, 0.0), 0.3, 0.7))
    described = free_pair(blows)
    machine, given = engine(), []
    machine.build(described, scheme, 1e-2)
    before = machine.state().velocity
    for steps in (20, 5, 5, 3, 47, 20):
        machine.acceleration(np.array(described.q0), np.array(described.v0))
        machine.step(steps)
        given.append((machine.state().velocity - before) * [[2.0], [3.0]])
    machine.close()
    second = [
        (0, 0, 0),
        (0.15, 0, -0.3),
        (0.3, 0, -0.6),
        (0.39, 0.27, -0.78),
        (0.6, 3.6, -1.2),
        (0.6, 3.6, -1.2),
    ]
    assert np.array(given)[:, 0] == pytest.approx(np.zeros((6, 3)), abs=1e-13)
    assert np.array(given)[:, 1] == pytest.approx(np.array(second), abs=1e-13)


@CELLS
def test_blows_take_part_in_accelerations_whenever_they_act(engine, scheme):
    if "acceleration" in scheme.lacks:
        pytest.skip(scheme.lacks["acceleration"])
    blow = Blow("second", (3.0, 0.0, -6.0), 0.5, 0.6)
    q, v = (np.array(part) for part in (free_pair().q0, free_pair().v0))
    found = []
    for forces in ((blow,), (Constant("second", blow.force),)):
        machine = engine()
        machine.build(free_pair(forces), scheme, 1e-2)
        found.append(machine.acceleration(q, v))
        machine.close()
    assert found[0].tolist() == found[1].tolist()
