"""PyBullet's schemes are those that they are said to be: against integrators of a few lines, and MuJoCo's."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters.pybullet_ import PyBullet
from poinsot.reference.quaternions import from_rotation_vector, product
from poinsot.scenarios.body import Body, Joint, diagonal
from scipy.spatial.transform import Rotation

SCHEMES = {scheme.twin: scheme for scheme in PyBullet.schemes}
EULER, IMPLICIT = "semi-implicit Euler", "implicit gyroscopic"
STILL = (0.0, 0.0, 0.0)
SEEDS = range(12)


def explicit(inertia, omega, dt):
    """ω after a step, with the gyroscopic term at its start."""
    return omega - np.linalg.solve(inertia, dt * np.cross(omega, inertia @ omega))


def implicit(inertia, omega, dt):
    """ω after a step, with the gyroscopic term at its end, linearised about its start."""

    def skew(a):
        return np.cross(np.eye(3), a)  # a matrix that turns x into a×x

    momentum = inertia @ omega
    jacobian = inertia + dt * (skew(omega) @ inertia - skew(momentum))
    return omega - np.linalg.solve(jacobian, dt * np.cross(omega, momentum))


def spun(turned, inertia, q, omega, dt, n):
    """Attitudes and ω at every step of a free body: ω first, and then a turn by the new ω."""
    states = []
    for _ in range(n):
        omega = turned(inertia, omega, dt)
        q = product(q, from_rotation_vector(omega * dt))
        q = q / np.linalg.norm(q)
        states.append((q, omega))
    return tuple(np.array(part) for part in zip(*states, strict=True))


def run(scene, twin, dt, engine_class=PyBullet):
    """States at the samples, as arrays."""
    engine = engine_class()
    try:
        scheme = next(scheme for scheme in engine.schemes if scheme.twin == twin)
        engine.build(scene, scheme, dt)
        states = []
        for _ in range(scene.samples):
            engine.step(scene.steps_per_sample(dt))
            states.append(engine.state())
    finally:
        engine.close()
    return [np.array(part) for part in zip(*states, strict=True)]


def turns(a, b):
    turn = Rotation.from_quat(a.reshape(-1, 4)).inv() * Rotation.from_quat(b.reshape(-1, 4))
    return float(turn.magnitude().max())


def apart(a, b):
    """Largest distance at any sample, of turns in radians, of the rest relative to its largest size."""
    rest = [
        np.abs(x - y).max() / (np.abs(y).max() or 1.0)
        for i, (x, y) in enumerate(zip(a, b, strict=True))
        if x.size and i != 1
    ]
    return max(turns(a[1], b[1]), *rest)


@pytest.fixture
def top(scene_of):
    tilt = Rotation.from_euler("xyz", [0.3, 0.2, 0.1]).as_matrix()
    tensors = {
        "symmetric": np.diag([0.01, 0.01, 0.02]),
        "prolate": np.diag([0.02, 0.02, 0.01]),
        "full": tilt @ np.diag([0.01, 0.015, 0.02]) @ tilt.T,
    }

    def make(kind, center_of_mass=STILL):
        tensor = (tensors[kind] + tensors[kind].T) / 2
        body = Body("top", 1.0, tuple(map(tuple, tensor.tolist())), (Joint("free", "free"),), center_of_mass)
        return scene_of([body], [0, 0, 0, 0.1, 0.7, -0.1, 0.7], [0, 0, 0, 1, 0, 5], STILL, 10.0, 100)

    return make


@pytest.mark.parametrize(("twin", "turned"), [(EULER, explicit), (IMPLICIT, implicit)])
@pytest.mark.parametrize("kind", ["symmetric", "prolate", "full"])
def test_a_free_top_is_stepped_as_said(top, twin, turned, kind):
    scene, dt = top(kind), 2.5e-3
    inertia, q, omega = scene.bodies[0].inertia_array, np.array(scene.q0[3:]), np.array(scene.v0[3:])
    n, stride = round(scene.duration / dt), scene.steps_per_sample(dt)
    mine = spun(turned, inertia, q, omega, dt, n)
    growth = turns(mine[0], spun(turned, inertia, q, omega + 1e-9, dt, n)[0]) / 1e-9
    _, quaternion, _, got, *_ = run(scene, twin, dt)
    # Rounding of the last state, and that of the first ones grown as a small kick grows; and what turning ω
    # from the world's axes and back adds up to in maximal coordinates, 2e-15 a step.
    allowed = 1e-12 + 1e-13 * growth + (2e-15 * n if twin == IMPLICIT else 0.0)
    assert turns(quaternion[:, 0], mine[0][stride - 1 :: stride]) <= allowed
    assert np.abs(got[:, 0] - mine[1][stride - 1 :: stride]).max() <= allowed * np.linalg.norm(omega)


def test_the_two_schemes_are_told_apart(top):
    scene = top("full")
    assert turns(run(scene, EULER, 2.5e-3)[1], run(scene, IMPLICIT, 2.5e-3)[1]) > 1e-2


@pytest.mark.parametrize("twin", SCHEMES)
def test_the_centre_of_mass_of_a_free_body_goes_straight(top, twin):
    # PyBullet steps the centre of mass, wherever in the body it is; others step the origin of its frame.
    scene = top("full", (0.3, -0.2, 0.1))
    scene = replace(scene, v0=(1.0, 2.0, 3.0, *scene.v0[3:]))
    position, _, velocity, *_ = run(scene, twin, 1e-3)
    assert np.all(velocity == velocity[0])
    t = scene.sample_times()[1:, None]
    path = position[0, 0] + (t - t[0]) * velocity[0, 0]
    np.testing.assert_allclose(position[:, 0], path, rtol=1e-12, atol=1e-12)


# Against MuJoCo


@pytest.fixture
def mujoco():
    """MuJoCo's Euler, whose explicit gyroscopic term and dampers are those of PyBullet."""
    pytest.importorskip("mujoco")
    from poinsot.adapters.mujoco_ import MuJoCo

    return MuJoCo


@pytest.fixture
def heavy_top(scene_of):
    tilt = Rotation.from_euler("xyz", [0.3, 0.2, 0.1]).as_matrix()

    def make(kind):
        tensor = np.diag([0.004, 0.004, 0.0075])
        tensor = tilt @ tensor @ tilt.T if kind == "tilted" else tensor
        rows = tuple(map(tuple, ((tensor + tensor.T) / 2).tolist()))
        body = Body("top", 1.0, rows, (Joint("pivot", "ball"),), (0.01, 0.0, 0.05))
        return scene_of([body], [0.28, 0, 0, 0.96], [1.5, 0.5, 20], duration=2.0, samples=40)

    return make


def chain(scene_of):
    def mass(name, m, parent):
        spring = Joint(f"{name} slides", "slide", (1.0, 0.0, 0.0), 30.0, 0.1)
        return Body(name, m, diagonal(1, 1, 1), (spring,), parent=parent, position=(1.0, 0.0, 0.0))

    bodies = [mass("left", 1.0, None), mass("middle", 2.0, "left"), mass("right", 1.0, "middle")]
    return scene_of(bodies, [0.1, 0.0, -0.2], [0.0, 0.3, 0.0], STILL, 10.0, 50)


def centred(scene):
    """The scene with the centre of a free body at its frame's origin, where MuJoCo too steps it."""
    first, *rest = scene.bodies
    if first.joints[0].kind != "free":
        return scene
    return replace(scene, bodies=(replace(first, center_of_mass=STILL), *rest))


def close_to(mujoco, scene, twin=EULER, dt=1e-3):
    theirs = run(scene, twin, dt, mujoco)
    kicked = replace(scene, v0=tuple(v + 1e-9 for v in scene.v0))
    growth = apart(run(kicked, twin, dt, mujoco), theirs) / 1e-9
    assert growth < 1e6, "chaotic: rounding alone separates twins here"
    return apart(run(scene, twin, dt), theirs), 1e-12 + 1e-13 * growth


@pytest.mark.parametrize("kind", ["upright", "tilted"])
def test_a_heavy_top_is_mujocos(mujoco, heavy_top, kind):
    distance, allowed = close_to(mujoco, heavy_top(kind))
    assert distance <= allowed


def test_a_chain_of_springs_and_dampers_is_mujocos(mujoco, scene_of):
    distance, allowed = close_to(mujoco, chain(scene_of))
    assert distance <= allowed


@pytest.mark.parametrize("seed", SEEDS)
def test_every_kind_of_tree_is_mujocos(mujoco, random_tree, seed):
    distance, allowed = close_to(mujoco, centred(random_tree(seed)))
    assert distance <= allowed


@pytest.mark.parametrize("kind", ["symmetric", "full"])
def test_maximal_coordinates_are_mujocos_implicit(mujoco, top, kind):
    distance, allowed = close_to(mujoco, top(kind), IMPLICIT)
    # As above: 2e-15 for each of the 10000 steps.
    assert distance <= allowed + 2e-11


@pytest.mark.parametrize("seed", [0, 1])
def test_a_step_that_differs_by_a_millionth_is_no_twin(mujoco, random_tree, seed):
    # The comparison is no coarser than what it is asked to see.
    scene = centred(random_tree(seed))
    assert apart(run(scene, EULER, 1e-3), run(scene, EULER, 1e-3 * (1 + 1e-6), mujoco)) > 1e-8
