"""Spin about the axis of the middle moment (Dzhanibekov): a small deviation grows, and the body flips.

A deviation of 1e-4 catches an engine that takes ω for steady where it is nearly along a principal axis.
"""

import numpy as np

from ..reference import wobble
from ..reference.checked import Array
from . import free_body, observables, pictures
from .body import Body, Joint, diagonal
from .scene import Scene, every_scheme
from .trajectory import Trajectory

#: The middle one first, then the largest: along L the flipping body circles one of the other two [kg m²].
MOMENTS = (2.0e-4, 3.0e-4, 1.2e-4)
SPIN = 6.0
ATTITUDE = (0.1, 0.5, -0.7, 0.5)
VELOCITY = (0.02, -0.01, 0.03)


def _linear_rates(scene: Scene) -> tuple[float, float]:
    return wobble.linear_rates(np.diag(scene.bodies[0].inertia_array), 0, scene.v0[3])


def _growing(scene: Scene, motion: Trajectory) -> Array:
    """What of ω's deviation (n,) grows as exp(λt) while it is small; the rest of it dies as fast."""
    Omega_1, Omega_2 = _linear_rates(scene)
    return np.asarray(motion.omega[:, 0, 1] / np.sqrt(Omega_1) - motion.omega[:, 0, 2] / np.sqrt(-Omega_2))


def _growth(scene: Scene, motion: Trajectory) -> float:
    """Slope of the logarithm of the growing part, as long as it is expected to be small [1/s]."""
    start = np.linalg.norm(scene.v0[4:]) / scene.v0[3]
    early = motion.t <= np.log(SMALL / start) / _growth_rate(scene)
    size = np.abs(_growing(scene, motion)[early])
    # A body that stops has no logarithm, but it is the engine that is wrong.
    return float(np.polyfit(motion.t[early], np.log(np.maximum(size, 1e-300)), 1)[0])


def _growth_rate(scene: Scene) -> float:
    return wobble.growth_rate(np.diag(scene.bodies[0].inertia_array), scene.v0[3])


def _flipping(scene: Scene, motion: Trajectory) -> Array:
    """ω seen along the axis that it circles, one of largest or smallest moment: a half turn is a flip."""
    return free_body.around_axis(scene, motion.omega[:, 0])


def _flip_rate(scene: Scene) -> float:
    moments = np.diag(scene.bodies[0].inertia_array)
    return 2 * np.pi / wobble.flip_period(moments, scene.v0[3:])


#: How far ω may have left the axis for its deviation to count as small [1].
SMALL = 0.1


def _top(variant: str, duration: float, samples: int) -> Scene:
    deviation = SPIN * float(variant)
    return Scene(
        name="middle_axis",
        variant=variant,
        summary=f"A free body spun about its middle axis but for {variant}: that grows, and it flips.",
        source="Landau & Lifshitz, Mechanics, § 37; Goldstein, Classical Mechanics, ch. 5.6",
        bodies=(Body("wing nut", 0.05, diagonal(*MOMENTS), (Joint("free", "free"),)),),
        q0=(0.2, 0.3, -0.1, *ATTITUDE),
        v0=(*VELOCITY, SPIN, 0.8 * deviation, -0.6 * deviation),
        duration=duration,
        samples=samples,
        truth=free_body.truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.fitted("growth rate", "1/s", _growth, _growth_rate),
            observables.rate("flip rate", _flipping, _flip_rate),
            observables.energy(),
            observables.angular_momentum(),
            observables.momentum(),
            observables.unit_norm(),
        ),
        pictures=(
            pictures.against_time(
                "Spin about the middle axis", "ω1 [rad/s]", lambda scene, m: m.omega[:, 0, 0]
            ),
            pictures.body_cone(),
        ),
        ladders={1: (8e-3, 4e-3, 2e-3, 1e-3, 5e-4), 4: (3.2e-2, 1.6e-2, 8e-3, 4e-3, 2e-3)},
        errors=every_scheme(ERRORS[variant], like="implicit gyroscopic"),
    )


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "1e-2": {
        "semi-implicit Euler": (9.5, 35.0, 0.0, 4.0, 2.0, 0.021, 0.0037, 0.0, 0.0),
        "implicit gyroscopic": (9.5, 35.0, 0.0, 4.1, 1.9, 0.02, 0.0036, 0.0, 0.0),
        "RKMK4": (9.6, 19.0, 0.0, 1.5, 1.3, 0.0019, 0.0081, 0.0, 0.0),
    },
    "1e-4": {
        "semi-implicit Euler": (12.0, 74.0, 0.0, 4.0, 2.7, 0.02, 0.0036, 0.0, 0.0),
        "implicit gyroscopic": (14.0, 73.0, 0.0, 4.1, 2.7, 0.02, 0.0036, 0.0, 0.0),
        "RKMK4": (11.0, 32.0, 0.0, 1.5, 1.2, 0.0019, 0.0081, 0.0, 0.0),
    },
}
SCENES = (_top("1e-2", 2.4, 75), _top("1e-4", 4.0, 125))
