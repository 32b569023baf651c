"""MuJoCo and Pinocchio run the same schemes: to rounding on every kind of body, joint and spring."""

import numpy as np
import pytest
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.scenarios.body import Body, Joint, diagonal
from scipy.spatial.transform import Rotation

ALL = ("semi-implicit Euler", "implicit gyroscopic", "RKMK4")
#: Until release 4.0 MuJoCo's RK4 was another scheme, and is called so.
TWINS = tuple(twin for twin in ALL if twin in {scheme.twin for scheme in MuJoCo.schemes})
STILL = (0.0, 0.0, 0.0)
TREES = tuple(f"tree {seed}" for seed in range(10))
DT = 1e-3


def free_symmetric_top(scene_of):
    body = Body("top", 1.0, diagonal(0.01, 0.01, 0.02), (Joint("free", "free"),))
    return scene_of([body], [0, 0, 0, 0, 0, 0, 1], [0, 0, 0, 1, 0, 5], STILL, 10.0, 100)


def free_asymmetric_body(scene_of, position=(0.1, 0.2, 0.3)):
    tensor = ((0.012, 0.001, -0.002), (0.001, 0.01, 0.002), (-0.002, 0.002, 0.018))
    body = Body("body", 1.5, tensor, (Joint("free", "free"),), center_of_mass=(0.02, -0.01, 0.03))
    q, v = [*position, 0.5, -0.5, 0.5, 0.5], [1, -2, 0.5, 1, 2, 5]
    return scene_of([body], q, v, duration=5.0, samples=50)


def body_far_away(scene_of):
    # Whatever is reckoned about the world's origin loses digits here.
    return free_asymmetric_body(scene_of, (300.0, -200.0, 100.0))


def heavy_top(scene_of):
    body = Body("top", 1.0, diagonal(0.004, 0.004, 0.0075), (Joint("pivot", "ball"),), (0.0, 0.0, 0.05))
    return scene_of([body], [0.28, 0, 0, 0.96], [1.5, 0.5, 20], duration=2.0, samples=40)


def three_masses(scene_of):
    def mass(name, m, parent):
        spring = Joint(f"{name} slides", "slide", (1.0, 0.0, 0.0), 30.0, 0.1)
        return Body(name, m, diagonal(1, 1, 1), (spring,), parent=parent, position=(1.0, 0.0, 0.0))

    bodies = [mass("left", 1.0, None), mass("middle", 2.0, "left"), mass("right", 1.0, "middle")]
    return scene_of(bodies, [0.1, 0.0, -0.2], [0.0, 0.3, 0.0], STILL, 10.0, 50)


NAMED = {
    "free symmetric top": free_symmetric_top,
    "free asymmetric body": free_asymmetric_body,
    "body far away": body_far_away,
    "heavy top": heavy_top,
    "three masses": three_masses,
}


@pytest.fixture
def scene(request, scene_of, random_tree):
    name = request.param
    return random_tree(int(name.split()[1])) if name in TREES else NAMED[name](scene_of)


EVERY_SCENE = pytest.mark.parametrize("scene", [*NAMED, *TREES], indirect=True)


def run(engine_class, scene, twin, kick=0.0, dt=DT):
    """States at the samples; the ``kick`` is added to every velocity at the start."""
    engine = engine_class()
    scheme = next(scheme for scheme in engine.schemes if scheme.twin == twin)
    kicked = type(scene)(**{**vars_of(scene), "v0": tuple(v + kick for v in scene.v0)})
    engine.build(kicked, scheme, dt)
    states = []
    for _ in range(scene.samples):
        engine.step(scene.steps_per_sample(dt))
        states.append(engine.state())
    return states


def vars_of(scene):
    return {name: getattr(scene, name) for name in scene.__dataclass_fields__}


def apart(a, b):
    """Largest distance at any sample, of turns in radians, of the rest relative to its largest size."""
    worst = 0.0
    for part in ("position", "velocity", "omega", "joint_position", "joint_velocity"):
        x, y = (np.array([getattr(state, part) for state in states]) for states in (a, b))
        if x.size:
            worst = max(worst, np.abs(x - y).max() / (np.abs(y).max() or 1.0))
    x, y = (np.array([state.quaternion for state in states]).reshape(-1, 4) for states in (a, b))
    return max(worst, float((Rotation.from_quat(x).inv() * Rotation.from_quat(y)).magnitude().max()))


def test_each_scheme_of_pinocchio_has_its_twin():
    assert tuple(scheme.twin for scheme in Pinocchio.schemes) == ALL
    expected = ALL if int(MuJoCo.version().split(".")[0]) >= 4 else ALL[:2]
    assert expected == TWINS


@EVERY_SCENE
@pytest.mark.parametrize("twin", TWINS)
def test_twins_agree_to_rounding(scene, twin):
    pinocchio = run(Pinocchio, scene, twin)
    growth = apart(run(Pinocchio, scene, twin, kick=1e-9), pinocchio) / 1e-9
    assert growth < 1e6, "chaotic: rounding alone separates twins here"
    # Rounding of the last state, and that of the first ones grown as a small kick grows.
    assert apart(run(MuJoCo, scene, twin), pinocchio) <= 1e-12 + 1e-13 * growth


@pytest.mark.parametrize("scene", ["free asymmetric body", "heavy top", "tree 0", "tree 3"], indirect=True)
@pytest.mark.parametrize("twin", TWINS)
def test_another_scheme_is_no_twin(scene, twin):
    for other in TWINS:
        if other != twin:
            assert apart(run(MuJoCo, scene, other), run(Pinocchio, scene, twin)) > 1e-5


@pytest.mark.parametrize("scene", ["heavy top", "tree 1"], indirect=True)
@pytest.mark.parametrize("twin", TWINS)
def test_a_step_that_differs_by_a_millionth_is_no_twin(scene, twin):
    # The twin check is no coarser than what it is asked to see.
    a = run(MuJoCo, scene, twin)
    b = run(Pinocchio, scene, twin, dt=DT * (1 + 1e-6))
    assert apart(a, b) > 1e-8
