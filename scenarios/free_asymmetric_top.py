"""A body with three different moments spinning freely: near each stable axis, and far from both.

A satellite's moments, and tens of newton metres of gyroscopic torque, catch an engine that clamps it, as
Bullet's explicit form of it lets one do.
"""

import numpy as np

from ..reference import wobble
from ..reference.checked import Array
from . import free_body, observables, pictures
from .body import Body, Joint, Vector, diagonal
from .scene import Scene, every_scheme
from .trajectory import Trajectory

#: In no order, the largest first and the middle one last [kg m²].
MOMENTS = (120.0, 60.0, 90.0)
ATTITUDE = (0.5, -0.1, 0.7, 0.5)
VELOCITY = (-0.02, 0.05, 0.01)


def _round(scene: Scene, motion: Trajectory) -> Array:
    return free_body.around_axis(scene, motion.omega[:, 0])


def _rate(scene: Scene) -> float:
    """Exact at any amplitude: √(Ω1Ω2) is its limit for small ones."""
    moments = np.diag(scene.bodies[0].inertia_array)
    return 2 * np.pi / wobble.flip_period(moments, scene.v0[3:])


def _amplitude_ratio(scene: Scene, motion: Trajectory) -> float:
    """Root mean square of the second over that of the first: on an ellipse, √(Ω2/Ω1)."""
    around = _round(scene, motion)
    return float(np.linalg.norm(around.imag) / (np.linalg.norm(around.real) or 1.0))


def _small_ratio(scene: Scene) -> float:
    return wobble.wobble_ratio(np.diag(scene.bodies[0].inertia_array), free_body.circled_axis(scene))


#: Of small ellipses only: far from the axes there is no such closed form.
RATIO = observables.fitted("amplitude ratio", "1", _amplitude_ratio, _small_ratio)


def _top(variant: str, omega0: Vector) -> Scene:
    return Scene(
        name="free_asymmetric_top",
        variant=variant,
        summary=f"A free body with three different moments, spinning {_WORDS[variant]}.",
        source="Landau & Lifshitz, Mechanics, § 37; Goldstein, Classical Mechanics, ch. 5.6",
        bodies=(Body("satellite", 200.0, diagonal(*MOMENTS), (Joint("free", "free"),)),),
        q0=(3.0, -1.0, 2.0, *ATTITUDE),
        v0=(*VELOCITY, *omega0),
        duration=6.4,
        samples=100,
        dt=4e-3,
        truth=free_body.truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.rate("wobble", _round, _rate),
            *((RATIO,) if variant != "general" else ()),
            observables.energy(),
            observables.angular_momentum(),
            observables.momentum(),
            observables.unit_norm(),
        ),
        pictures=(pictures.body_cone(), pictures.tip()),
        ladders={1: (3.2e-2, 1.6e-2, 8e-3, 4e-3, 2e-3), 4: (6.4e-2, 3.2e-2, 1.6e-2, 8e-3, 4e-3)},
        errors=every_scheme(ERRORS[variant], like="implicit gyroscopic"),
    )


_WORDS = {
    "largest": "near the axis of its largest moment: ω draws a small ellipse",
    "smallest": "near the axis of its smallest moment: ω draws a small ellipse",
    "general": "far from its axes: Jacobi's functions, and for its attitude the third kind's integral",
}

#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "largest": {
        "semi-implicit Euler": (0.19, 0.58, 0.0, 0.018, 0.081, 6.5, 17.0, 0.0, 0.0),
        "implicit gyroscopic": (0.2, 0.54, 0.0, 0.018, 0.052, 5.6, 14.0, 0.0, 0.0),
        "RKMK4": (0.007, 0.015, 0.0, 0.019, 0.0012, 0.02, 1.1, 0.0, 0.0),
    },
    "smallest": {
        "semi-implicit Euler": (0.23, 0.26, 0.0, 0.0055, 0.041, 3.1, 4.3, 0.0, 0.0),
        "implicit gyroscopic": (0.22, 0.26, 0.0, 0.0046, 0.046, 2.9, 17.0, 0.0, 0.0),
        "RKMK4": (0.0071, 0.0027, 0.0, 0.0027, 0.0018, 0.0038, 0.83, 0.0, 0.0),
    },
    "general": {
        "semi-implicit Euler": (4.3, 1.4, 0.0, 0.0068, 200.0, 110.0, 0.0, 0.0),
        "implicit gyroscopic": (4.2, 1.4, 0.0, 0.0051, 190.0, 110.0, 0.0, 0.0),
        "RKMK4": (0.032, 0.012, 0.0, 0.00062, 0.088, 4.9, 0.0, 0.0),
    },
}
SCENES = (
    _top("largest", (2.0, 0.11, -0.05)),
    _top("smallest", (-0.07, -2.0, 0.09)),
    _top("general", (1.1, 1.3, -0.7)),
)
