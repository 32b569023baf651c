"""A bicycle wheel hung by one end of its axle from a rope: in steady precession, and let go to swing and nod.

Rope and wheel are two bodies on two ball joints. Catches an engine that hands out the second ball joint's
own rate for the angular velocity of the body behind it: with one joint the two are the same. Swinging, it
catches one whose wheel has other moments with which that very precession would be as steady.
"""

from functools import lru_cache

import numpy as np

from ..reference import euler_angles, hanging_gyroscope, hanging_gyroscope_motion, quaternions
from ..reference.checked import Array
from . import observables, pictures
from .body import Body, Joint, diagonal
from .observables import Observable
from .scene import Scene, every_scheme
from .trajectory import Trajectory

#: Rope: mass [kg], length, radius [m]. Wheel: mass, distance of its centre, moments about it; g [m/s²].
ROPE, LENGTH, RADIUS = 0.1, 0.5, 0.01
WHEEL, ARM, ACROSS, AXIAL, G = 1.5, 0.12, 0.022, 0.04, 9.81
#: Tilt of the axle from straight up [rad], rate of precession [rad/s]; azimuth and turns of rope and wheel
#: about their axes at the start [rad].
BETA, OMEGA, AZIMUTH, TURNS = 1.9, 3.0, 0.7, (0.5, -0.4)
#: Tilt of the rope from straight down [rad] and spin ω3 of the wheel [rad/s] that keep these, as
#: `hanging_gyroscope.steady_precession` gives them: a test compares.
CHI, OMEGA3 = 0.18015475683581866, 13.244642896101297
TILTS = (np.pi - CHI, BETA)
#: The start of the swing: azimuth, tilt from straight up and turn [rad] of rope and wheel, and their ω in
#: body axes [rad/s]. The rope does not spin: the reference knows nothing of its moment about its own axis.
LET_GO = ((0.7, np.pi - 0.45, 0.5), (1.9, 1.2, -0.4))
SWING = ((1.1, -1.6, 0.0), (0.8, -0.5, 25.0))
#: Mean rates [rad/s] at which rope and axle turn as seen from above while it swings: a test compares.
SWING_RATES = (-2.62862066, 1.54309933)
#: Of the integration, over which the truth is good to about a hundred times this; and from other starts.
FINE, COARSE = 2.3e-14, 1e-11


def system() -> "tuple[hanging_gyroscope.Rope, hanging_gyroscope.Gyroscope]":
    """Rope and gyroscope as the reference has them."""
    rope = hanging_gyroscope.Rope(LENGTH, ROPE * (LENGTH**2 / 3 + RADIUS**2 / 4), ROPE * LENGTH / 2)
    return rope, hanging_gyroscope.Gyroscope(WHEEL, ARM, (ACROSS + WHEEL * ARM**2, AXIAL))


def _steady(t: Array) -> tuple[Array, Array]:
    """Attitudes (n, 2, 4) and ω (n, 2, 3) in body axes [rad/s] of rope and wheel."""
    spins = np.array([0.0, OMEGA3]) - OMEGA * np.cos(TILTS)
    rates = np.stack([np.full(2, OMEGA), np.zeros(2), spins], axis=-1)
    start = np.stack([np.full(2, AZIMUTH), TILTS, TURNS], axis=-1)
    angles = start + t[:, None, None] * rates
    return euler_angles.zyz_attitude(angles), euler_angles.zyz_omega(angles, rates)


def _start(q: Array, omega: Array) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Coordinates and velocities of both joints, from attitudes (2, 4) and ω (2, 3) of rope and wheel."""
    relative = quaternions.product(quaternions.conjugate(q[0]), q[1])
    carried = quaternions.rotated(quaternions.conjugate(relative), omega[0])
    return (*q[0].tolist(), *relative.tolist()), (*omega[0].tolist(), *(omega[1] - carried).tolist())


@lru_cache(maxsize=8)
def _from(q0: tuple[float, ...], v0: tuple[float, ...], times: bytes) -> tuple[Array, Array]:
    """As `_steady`, from another start than that of the steady precession."""
    q, v = np.array(q0).reshape(2, 4), np.array(v0).reshape(2, 3)
    carried = quaternions.rotated(quaternions.conjugate(q[1]), v[0])
    attitudes = np.stack([q[0], quaternions.product(q[0], q[1])])
    omega, tolerance = np.stack([v[0], v[1] + carried]), FINE if (q0, v0) == LET_GO_START else COARSE
    return hanging_gyroscope_motion.motion(*system(), G, attitudes, omega, np.frombuffer(times), tolerance)


def _truth(scene: Scene, t: Array) -> Trajectory:
    if (scene.q0, scene.v0) == START:
        q, omega = _steady(t)
    else:  # the same samples, but for their rounding, at every step: integrated once
        q, omega = _from(scene.q0, scene.v0, np.round(t, 15).tobytes())
    arms = np.array([[0.0, 0.0, LENGTH / 2], [0.0, 0.0, ARM]])
    position, velocity = quaternions.rotated(q, arms), quaternions.rotated(q, np.cross(omega, arms))
    position[:, 1] += 2 * position[:, 0]
    velocity[:, 1] += 2 * velocity[:, 0]
    none = np.empty((len(t), 0))
    return Trajectory(t, position, q, velocity, omega, none, none)


def _rope_from_above(scene: Scene, motion: Trajectory) -> Array:
    x, y, _ = motion.position[:, 0].T
    return np.asarray(x + 1j * y)


def _axle_from_above(scene: Scene, motion: Trajectory) -> Array:
    x, y, _ = quaternions.rotated(motion.quaternion[:, 1], np.array([0.0, 0.0, 1.0])).T
    return np.asarray(x + 1j * y)


def _tilts(scene: Scene, motion: Trajectory) -> Array:
    """Angles (n, 2) of rope and axle from straight up [rad]."""
    x, y, z = np.moveaxis(quaternions.rotated(motion.quaternion, np.array([0.0, 0.0, 1.0])), 2, 0)
    return np.asarray(np.arctan2(np.hypot(x, y), z))


def _tilting() -> Observable:
    return Observable(
        "tilts", "rad", "state", lambda scene, a, b: _tilts(scene, a) - _tilts(scene, b),
        lambda scene, b: float(np.pi),
    )  # fmt: skip


def _parted(scene: Scene, motion: Trajectory) -> Array:
    """How far the rope's end is from the axle's, and the rope's other one from where it hangs [m]."""
    axes = quaternions.rotated(motion.quaternion, np.array([0.0, 0.0, 1.0]))
    rope, wheel = motion.position[:, 0], motion.position[:, 1]
    middle = LENGTH / 2 * axes[:, 0]
    return np.hstack([wheel - ARM * axes[:, 1] - rope - middle, rope - middle])


def _wheel_on_a_rope(
    variant: str,
    summary: str,
    start: tuple[tuple[float, ...], ...],
    rates: tuple[float, float],
    samples: int,
    coarsest: float,
) -> Scene:
    """``samples`` are 0.02 s apart, ``coarsest`` is the largest step of the ladder of order 4 [s]."""
    across = ROPE * (LENGTH**2 / 12 + RADIUS**2 / 4)
    # What does not spin may have any moment about its axis; one as small as a rope's is turned by rounding.
    along = across if variant == "swinging" else ROPE * RADIUS**2 / 2
    return Scene(
        name="hanging_gyroscope",
        variant=variant,
        summary=f"A spinning wheel hung from a rope by one end of its axle{summary}.",
        source="Goldstein, Classical Mechanics, § 1.2 and § 5.5; Taylor, Classical Mechanics, § 10.6",
        bodies=(
            Body(
                "rope", ROPE, diagonal(across, across, along), (Joint("hook", "ball"),),
                center_of_mass=(0.0, 0.0, LENGTH / 2),
            ),
            Body(
                "wheel", WHEEL, diagonal(ACROSS, ACROSS, AXIAL), (Joint("knot", "ball"),),
                center_of_mass=(0.0, 0.0, ARM), parent="rope", position=(0.0, 0.0, LENGTH),
            ),
        ),
        gravity=(0.0, 0.0, -G),
        q0=start[0],
        v0=start[1],
        duration=samples * 2e-2,
        samples=samples,
        truth=_truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.velocity(),
            observables.rate("precession of the rope", _rope_from_above, lambda scene: rates[0]),
            observables.rate("precession of the axle", _axle_from_above, lambda scene: rates[1]),
            observables.invariant("tilts", "rad", _tilts, lambda scene, b: float(np.pi))
            if variant == "steady"
            else _tilting(),
            observables.energy(),
            observables.vertical_angular_momentum(),
            observables.axial_angular_momentum(body=1),
            observables.unit_norm(),
            observables.invariant("joint residual", "m", _parted, lambda scene, b: LENGTH),
        ),
        pictures=(
            pictures.tip("Direction of the rope"),
            pictures.against_time("Tilt of the axle", "β [rad]", lambda scene, m: _tilts(scene, m)[:, 1]),
        ),
        ladders={1: (2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4), 4: tuple(coarsest / 2**k for k in range(5))},
        errors=every_scheme(ERRORS[variant], like="semi-implicit Euler"),
    )  # fmt: skip


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "steady": {
        "semi-implicit Euler": (6.5, 37.0, 3.3, 13.0, 29.0, 2.1, 5.2, 11.0, 4.0, 0.089, 0.0, 0.0),
        "implicit gyroscopic": (7.5, 50.0, 2.8, 11.0, 27.0, 3.4, 4.2, 11.0, 4.0, 0.088, 0.0, 0.0),
        "RKMK4": (430.0, 790.0, 100.0, 260.0, 870.0, 580.0, 59.0, 38.0, 6.7, 1.3, 0.0, 0.0),
    },
    "swinging": {
        "semi-implicit Euler": (11.0, 82.0, 5.9, 35.0, 41.0, 5.3, 5.8, 38.0, 5.2, 0.34, 0.0, 0.0),
        "implicit gyroscopic": (7.1, 120.0, 3.5, 29.0, 26.0, 1.8, 4.3, 43.0, 6.5, 0.23, 0.0, 0.0),
        "RKMK4": (3200.0, 60000.0, 1500.0, 8100.0, 820.0, 2000.0, 2800.0, 8300.0, 3300.0, 81.0, 0.0, 0.0),
    },
}
START = _start(*(part[0] for part in _steady(np.zeros(1))))
LET_GO_START = _start(euler_angles.zyz_attitude(np.array(LET_GO)), np.array(SWING))

SCENES = (
    _wheel_on_a_rope("steady", ", in steady precession", START, (OMEGA, OMEGA), 40, 1e-2),
    _wheel_on_a_rope("swinging", ", let go to swing and nod", LET_GO_START, SWING_RATES, 20, 2e-2),
)
