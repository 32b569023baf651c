"""Cells to log, with numbers that are easily lost; trees of bodies to build in engines."""

from collections.abc import Callable
from importlib.util import find_spec

import numpy as np
import pytest
from poinsot.scenarios.body import Body, Joint
from poinsot.scenarios.scene import Scene
from poinsot.scenarios.trajectory import Provenance, Trajectory

#: Tests that speak to an engine itself, where it is not installed.
collect_ignore = [
    *(["test_mujoco.py", "test_twins.py"] if find_spec("mujoco") is None else []),
    *(["test_pybullet.py", "test_pybullet_twins.py"] if find_spec("pybullet") is None else []),
    *(
        ["test_pinocchio.py", "test_pinocchio_schemes.py", "test_twins.py"]
        if find_spec("pinocchio") is None
        else []
    ),
]

Cell = tuple[Scene, Trajectory]

#: What a careless encoding drops, rounds or equates: zeros, infinities, the smallest and largest numbers.
AWKWARD = (0.0, -0.0, np.inf, -np.inf, np.nan, 5e-324, -1.7976931348623157e308, 0.1)


@pytest.fixture
def make_cell() -> Callable[..., Cell]:
    def make(bodies: int = 2, hinges: int = 1, samples: int = 20, dt: float = 1e-3, stride: int = 3) -> Cell:
        scene = _scene(bodies, hinges, samples, dt * stride)
        rng = np.random.default_rng(bodies + 10 * hinges)
        shapes = [(bodies, 3), (bodies, 4), (bodies, 3), (bodies, 3), (bodies * hinges,), (bodies * hinges,)]
        arrays = [rng.normal(size=(samples, *shape)) for shape in shapes]
        for array in arrays:
            array.flat[: len(AWKWARD)] = AWKWARD[: array.size]
        run = Provenance(scene.full_name, "engine", "1.2", "Euler", 1, "SE", dt, (samples - 1) * stride)
        return scene, Trajectory(np.arange(samples) * stride * dt, *arrays, provenance=run)

    return make


def _scene(bodies: int, hinges: int, samples: int, period: float) -> Scene:
    inertia = ((0.03, 0.004, 0.0), (0.004, 0.02, 0.0), (0.0, 0.0, 0.04))
    chain = tuple(
        Body(
            f"body {k}",
            1.0 + k,
            inertia,
            tuple(Joint(f"hinge {k}.{h}", "hinge") for h in range(hinges)),
            parent=f"body {k - 1}" if k else None,
        )
        for k in range(bodies)
    )
    at_rest = (0.0,) * (bodies * hinges)
    return Scene(
        name="chain",
        summary="A chain of bodies",
        source="none",
        bodies=chain,
        q0=at_rest,
        v0=at_rest,
        duration=max(1, samples - 1) * period,
        samples=max(1, samples - 1),
        truth=lambda scene, t: (_ for _ in ()).throw(AssertionError("a log asks for no truth")),
        observables=(),
        dt=period,
    )


#: Joints of one body that leave it no two ways to make the same motion.
STACKS = (
    (), ("ball",), ("hinge",), ("slide",), ("hinge", "hinge"), ("slide", "ball"), ("ball", "slide"),
    ("hinge", "slide"), ("slide", "hinge", "slide"), ("hinge", "slide", "hinge"), ("slide", "slide"),
)  # fmt: skip


@pytest.fixture
def scene_of() -> Callable[..., Scene]:
    """A scene of these bodies at this state, of which no truth is asked."""

    def make(bodies, q0, v0, gravity=(0.0, 0.0, -9.81), duration=1.0, samples=20):
        return Scene(
            name="trial",
            summary="",
            source="",
            bodies=tuple(bodies),
            q0=tuple(float(x) for x in q0),
            v0=tuple(float(x) for x in v0),
            duration=duration,
            samples=samples,
            truth=None,
            observables=(),
            gravity=gravity,
        )

    return make


@pytest.fixture
def random_tree(scene_of) -> Callable[..., Scene]:
    """Five bodies in a tree listed in no special order: offset centres, full tensors, several joints a body.

    Even seeds begin with a free body, odd ones with joints to the world.
    """

    def make(seed: int) -> Scene:
        rng = np.random.default_rng(seed)
        bodies: list[Body] = []
        for k in range(5):
            parent = bodies[rng.integers(k)].name if k else None
            stack = ("free",) if k == 0 and seed % 2 == 0 else STACKS[rng.integers(k == 0, len(STACKS))]
            bodies.append(_random_body(rng, f"body {k}", parent, stack))
        states = [_random_state(rng, joint.kind) for body in bodies for joint in body.joints]
        return scene_of(
            bodies, np.concatenate([q for q, _ in states]), np.concatenate([v for _, v in states])
        )

    return make


def _random_body(rng: np.random.Generator, name: str, parent: str | None, stack: tuple[str, ...]) -> Body:
    # The tensor of a cloud of points: always one that a body can have.
    points = rng.normal(scale=0.05, size=(6, 3))
    tensor = sum(np.dot(x, x) * np.eye(3) - np.outer(x, x) for x in points)
    place = {"position": _tuple(rng.normal(size=3)), "quaternion": _tuple(_unit(rng, 4))}
    joints = [
        Joint(f"{kind} {i} of {name}", kind, _tuple(_unit(rng, 3)), *_spring(rng, kind))
        for i, kind in enumerate(stack)
    ]
    return Body(
        name,
        float(rng.uniform(0.5, 2)),
        tuple(_tuple(row) for row in (tensor + tensor.T) / 2),
        tuple(joints),
        center_of_mass=_tuple(rng.normal(scale=0.1, size=3)),
        parent=parent,
        **({} if "free" in stack else place),
    )


def _spring(rng: np.random.Generator, kind: str) -> tuple[float, float]:
    stiffness, damping = float(rng.uniform(1, 30)), float(rng.uniform(0.1, 0.5))
    return (stiffness, damping) if kind in ("hinge", "slide") else (0.0, 0.0)


def _random_state(rng: np.random.Generator, kind: str) -> tuple[np.ndarray, np.ndarray]:
    q = {
        "free": lambda: np.concatenate([rng.normal(size=3), _unit(rng, 4)]),
        "ball": lambda: _unit(rng, 4),
    }.get(kind, lambda: rng.normal(size=1))()
    return q, rng.normal(size={"free": 6, "ball": 3}.get(kind, 1))


def _unit(rng: np.random.Generator, n: int) -> np.ndarray:
    vector = rng.normal(size=n)
    return vector / np.linalg.norm(vector)


def _tuple(vector: np.ndarray) -> tuple[float, ...]:
    return tuple(float(x) for x in vector)
