"""Cells to log: any number of bodies, joints and samples, with numbers that are easily lost."""

from collections.abc import Callable

import numpy as np
import pytest
from poinsot.scenarios.body import Body, Joint
from poinsot.scenarios.scene import Scene
from poinsot.scenarios.trajectory import Provenance, Trajectory

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
