"""A symmetric body spinning freely: ω circles the body's axis, which itself circles L.

The fast variant of engines as they come catches one that clips what spins faster than some limit.
"""

import numpy as np

from ..reference import torque_free
from ..reference.checked import Array
from . import free_body, observables, pictures
from .body import Body, Joint, diagonal
from .scene import Scene, every_scheme
from .trajectory import Trajectory

ATTITUDE = (0.1, 0.7, -0.1, 0.7)
VELOCITY = (0.3, -0.2, 0.1)
#: Variants for engines as they come. The fast one is nearly round, so that every scheme follows it at 1 ms.
NOTHING_SET = {"defaults": "the free oblate top", "defaults fast": "a nearly round top at 150 rad/s"}


def _body_cone_rate(scene: Scene) -> float:
    I1, _, I3 = np.diag(scene.bodies[0].inertia_array)
    return torque_free.body_cone_rate(I1, I3, scene.v0[5])


def _transverse(scene: Scene, motion: Trajectory) -> Array:
    return np.asarray(motion.omega[:, 0, 0] + 1j * motion.omega[:, 0, 1])


def _top(variant: str, I1: float, I3: float, spin: float = 5.0) -> Scene:
    shape, defaults, fast = "oblate" if I3 > I1 else "prolate", variant in NOTHING_SET, spin > 100
    return Scene(
        name="free_symmetric_top",
        variant=variant,
        summary=f"What a user gets who sets nothing: {NOTHING_SET[variant]} in engines as they come."
        if defaults
        else f"A free {shape} top: ω turns about the body's axis at Ω_b, that axis about L at L/I1.",
        defaults=defaults,
        source="Landau & Lifshitz, Mechanics, § 33 and § 36; Goldstein, Classical Mechanics, ch. 5.6",
        bodies=(Body("top", 1.0, diagonal(I1, I1, I3), (Joint("free", "free"),)),),
        q0=(0.0, 0.0, 0.0, *ATTITUDE),
        v0=(*VELOCITY, 1.0, 0.0, spin),
        duration=2.0 if fast else 10.0,
        samples=50 if fast else 250,
        truth=free_body.truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.rate("Omega_b", _transverse, _body_cone_rate),
            observables.energy(),
            observables.angular_momentum(),
            observables.momentum(),
            observables.unit_norm(),
        ),
        pictures=(pictures.tip(), pictures.body_cone()),
        ladders={}
        if defaults
        else {1: (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4), 4: (2e-2, 1e-2, 5e-3, 2.5e-3, 1.25e-3)},
        errors=every_scheme(ERRORS["fast" if fast else shape], like="implicit gyroscopic"),
    )


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "oblate": {
        "semi-implicit Euler": (91.0, 170.0, 0.0, 0.17, 2.2, 0.23, 0.0, 0.0),
        "implicit gyroscopic": (63.0, 130.0, 0.0, 0.17, 1.3, 0.13, 0.0, 0.0),
        "RKMK4": (31.0, 270.0, 0.0, 27.0, 0.22, 0.07, 0.0, 0.0),
    },
    "prolate": {
        "semi-implicit Euler": (64.0, 34.0, 0.0, 0.021, 0.72, 0.27, 0.0, 0.0),
        "implicit gyroscopic": (59.0, 32.0, 0.0, 0.021, 0.63, 0.25, 0.0, 0.0),
        "RKMK4": (5.2, 8.2, 0.0, 0.82, 0.0068, 0.098, 0.0, 0.0),
    },
    "fast": {
        "semi-implicit Euler": (0.02, 2.3, 0.0, 0.0012, 0.023, 0.016, 0.0, 0.0),
        "implicit gyroscopic": (0.025, 2.3, 0.0, 0.0012, 0.023, 0.015, 0.0, 0.0),
        "RKMK4": (160.0, 0.0, 0.0, 0.0, 0.0, 230.0, 0.0, 0.0),
    },
}

SCENES = (
    _top("oblate", 0.01, 0.02),
    _top("prolate", 0.02, 0.01),
    _top("defaults", 0.01, 0.02),
    _top("defaults fast", 0.01, 0.0101, spin=150.0),
)
