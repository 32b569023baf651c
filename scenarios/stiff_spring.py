"""One mass on a spring so stiff that the usual step of a millisecond is past every explicit limit.

Catches an engine that treats springs explicitly and says otherwise, that clamps velocities, or that takes
smaller steps in secret: the largest stable step is ωdt = 2 or 2√2, or there is none, and nothing else.
"""

import numpy as np

from ..reference import normal_modes, scheme_stability, schemes
from ..reference.checked import Array
from . import observables, pictures
from .body import Body, Joint, diagonal
from .co2_chain import SCHEMES
from .scene import Scene
from .trajectory import Trajectory

#: Mass [kg], spring [N/m], amplitude [m], and how far past its largest displacement it starts [rad].
MASS, STIFFNESS, AMPLITUDE, PHASE = 1.0, 1e8, 1e-3, np.pi / 3


def frequency(scene: Scene) -> float:
    """ω = √(k/m) [rad/s]."""
    return float(np.sqrt(scene.joints[0].stiffness / scene.bodies[0].mass))


def _matrices(scene: Scene) -> tuple[list[list[float]], list[list[float]]]:
    return [[scene.bodies[0].mass]], [[scene.joints[0].stiffness]]


def _along_x(t: Array, x: Array, speed: Array) -> Trajectory:
    nothing = np.zeros((len(t), 1, 3))
    position, velocity = nothing.copy(), nothing.copy()
    position[:, :, 0], velocity[:, :, 0] = x, speed
    upright = np.tile([0.0, 0.0, 0.0, 1.0], (len(t), 1, 1))
    return Trajectory(t, position, upright, velocity, nothing, x, speed)


def _truth(scene: Scene, t: Array) -> Trajectory:
    return _along_x(t, *normal_modes.motion(*_matrices(scene), scene.q0, scene.v0, t))


def _scheme_motion(scene: Scene, twin: str, dt: float, t: Array) -> Trajectory | None:
    if twin not in SCHEMES:
        return None
    start, steps = (scene.q0, scene.v0), np.rint(t / dt)
    return _along_x(t, *schemes.linear_motion(SCHEMES[twin], *_matrices(scene), *start, dt, steps))


def stable_step(scene: Scene, twin: str) -> float | None:
    """2/ω, 2√2/ω, or infinite [s]."""
    if twin not in SCHEMES:
        return None
    return scheme_stability.largest_stable_step(SCHEMES[twin], frequency(scene))


def _signal(scene: Scene, motion: Trajectory) -> Array:
    return np.asarray(motion.joint_position[:, 0] - 1j * motion.joint_velocity[:, 0] / frequency(scene))


def on_spring(stiffness: float) -> Scene:
    """The mass on a spring of this ``stiffness`` [N/m]: five turns, at steps that follow its period."""
    omega = np.sqrt(stiffness / MASS)
    unit = 0.1 / omega
    return Scene(
        name="stiff_spring",
        summary=f"A mass on a spring of {stiffness:g} N/m.",
        source="Hairer, Lubich & Wanner, Geometric Numerical Integration, § I.1; Goldstein, ch. 6",
        bodies=(
            Body(
                "mass",
                MASS,
                diagonal(1.0, 1.0, 1.0),
                (Joint("spring", "slide", (1.0, 0.0, 0.0), stiffness=stiffness),),
            ),
        ),
        q0=(float(AMPLITUDE * np.cos(PHASE)),),
        v0=(float(-AMPLITUDE * omega * np.sin(PHASE)),),
        duration=float(320 * unit),
        samples=40,
        dt=float(unit),
        truth=_truth,
        scheme_motion=_scheme_motion,
        stable_step=stable_step,
        observables=(
            observables.position(),
            observables.velocity(),
            observables.rate("frequency", _signal, frequency),
            observables.energy(),
            observables.attitude(),
            observables.turning(),
        ),
        pictures=(pictures.against_time("Displacement", "x [m]", lambda scene, m: m.joint_position[:, 0]),),
        ladders={
            1: tuple(float(unit / 2**k) for k in range(5)),
            4: tuple(float(4 * unit / 2**k) for k in range(5)),
            # Implicit Euler damps by ω²dt/2: at coarser steps the motion has all but died.
            "discrete": tuple(float(unit / 8 / 2**k) for k in range(5)),
        },
    )


SCENES = (on_spring(STIFFNESS),)
