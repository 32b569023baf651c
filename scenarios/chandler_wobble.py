"""The wobble of the Earth's pole: a body oblate by 1/305 turns many times while ω goes round once.

Moments so nearly equal catch an engine that takes a body for a sphere where they differ by less than a
hundredth: nothing of it wobbles.
"""

import numpy as np

from ..reference import chandler
from ..reference.checked import Array
from . import free_body, observables
from .body import Body, Joint, diagonal
from .pictures import Picture
from .scene import Scene, every_scheme
from .trajectory import Trajectory

#: One turn a second instead of a day; the pole of rotation 0.2 rad from that of figure, on Earth 1e-6.
ELLIPTICITY, SPIN, AMPLITUDE, PHASE = 1 / 305, 2 * np.pi, 0.2, 0.7
ATTITUDE = (0.1, -0.3, 0.9, 0.3)
VELOCITY = (0.05, 0.02, -0.04)


def _pole(scene: Scene, motion: Trajectory) -> Array:
    """Where ω points from the Earth, as complex numbers (n,): ω1 + iω2."""
    return np.asarray(motion.omega[:, 0, 0] + 1j * motion.omega[:, 0, 1])


def _wobble_rate(scene: Scene) -> float:
    return chandler.wobble_rate(ELLIPTICITY, SPIN)


def _pole_distance(scene: Scene, motion: Trajectory) -> Array:
    """Angle (n,) [rad] between ω and the axis of figure."""
    return np.arctan2(np.abs(_pole(scene, motion)), motion.omega[:, 0, 2])


ACROSS = SPIN * np.tan(AMPLITUDE)

#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, tuple[float, ...]] = {
    "semi-implicit Euler": (0.097, 0.017, 0.0, 3e-07, 0.0025, 0.021, 0.027, 0.0, 0.0),
    "implicit gyroscopic": (0.097, 0.017, 0.0, 3e-07, 0.0025, 0.021, 0.027, 0.0, 0.0),
    "RKMK4": (0.0049, 0.0, 0.0, 0.0, 0.0, 0.0, 0.032, 0.0, 0.0),
}

SCENES = (
    Scene(
        name="chandler_wobble",
        summary="A body oblate by 1/305, turned 60 times: its pole of rotation goes round at ω3/305.",
        source="Landau & Lifshitz, Mechanics, § 33; Goldstein, Classical Mechanics, ch. 5.6",
        bodies=(Body("earth", 5.0, diagonal(1.0, 1.0, 1.0 + ELLIPTICITY), (Joint("free", "free"),)),),
        q0=(1.0, 0.5, -2.0, *ATTITUDE),
        v0=(*VELOCITY, ACROSS * np.cos(PHASE), ACROSS * np.sin(PHASE), SPIN),
        duration=60.0,
        samples=100,
        dt=2.5e-2,
        truth=free_body.truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.rate("wobble", _pole, _wobble_rate),
            observables.invariant("pole distance", "rad", _pole_distance, lambda scene, b: 1.0),
            observables.energy(),
            observables.angular_momentum(),
            observables.momentum(),
            observables.unit_norm(),
        ),
        pictures=(
            Picture(
                "Path of the pole of rotation on the body",
                ("ω1/ω3", "ω2/ω3"),
                lambda scene, m: m.omega[:, 0, :2] / m.omega[:, 0, 2:],
            ),
        ),
        ladders={1: (1e-1, 5e-2, 2.5e-2, 1.25e-2, 6.25e-3), 4: (1e-1, 5e-2, 2.5e-2, 1.25e-2, 6.25e-3)},
        errors=every_scheme(ERRORS, like="implicit gyroscopic"),
    ),
)
