"""Three masses in line, joined by two springs: the stretching modes of a CO2 molecule."""

from collections.abc import Callable

import numpy as np

from ..reference import co2_chain, normal_modes, schemes
from ..reference.checked import Array
from . import observables, pictures
from .body import Body, Joint, Vector, diagonal
from .observables import Observable
from .scene import Scene
from .trajectory import Trajectory

OXYGEN, CARBON, STIFFNESS, SPACING = 16.0, 12.0, 1600.0, 1.0
PHASE = np.pi / 3
FREQUENCIES = co2_chain.frequencies(OXYGEN, CARBON, STIFFNESS)
MODES = co2_chain.modes(OXYGEN, CARBON)
#: MuJoCo's and Pinocchio's implicit schemes do not treat a joint's spring implicitly, so that on a
#: chain of springs every first-order scheme is the same.
SCHEMES: dict[str, schemes.Scheme] = {
    "semi-implicit Euler": "semi_implicit_euler",
    "implicit gyroscopic": "semi_implicit_euler",
    "RKMK4": "rk4",
    "discrete": "implicit_euler",
    "implicitfast": "semi_implicit_euler",
}


def _displacements(scene: Scene) -> tuple[Array, Array]:
    """Displacements and velocities of the three masses at the start, from the joints' relative ones."""
    return np.cumsum(scene.q0), np.cumsum(scene.v0)


def _along_x(t: Array, eta: Array, eta_rate: Array) -> Trajectory:
    n = len(t)
    position, velocity = np.zeros((n, 3, 3)), np.zeros((n, 3, 3))
    position[:, :, 0], velocity[:, :, 0] = eta + SPACING * np.arange(3), eta_rate
    upright = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (n, 3, 4))
    q, v = (np.diff(array, axis=1, prepend=0.0) for array in (eta, eta_rate))
    return Trajectory(t, position, upright, velocity, np.zeros((n, 3, 3)), q, v)


def _truth(scene: Scene, t: Array) -> Trajectory:
    T, V = co2_chain.energies(OXYGEN, CARBON, STIFFNESS)
    return _along_x(t, *normal_modes.motion(T, V, *_displacements(scene), t))


def _scheme_motion(scene: Scene, twin: str, dt: float, t: Array) -> Trajectory | None:
    if twin not in SCHEMES:
        return None
    T, V = co2_chain.energies(OXYGEN, CARBON, STIFFNESS)
    steps = np.rint(t / dt)
    return _along_x(t, *schemes.linear_motion(SCHEMES[twin], T, V, *_displacements(scene), dt, steps))


def _frequency(mode: int, name: str) -> Observable:
    T, _ = co2_chain.energies(OXYGEN, CARBON, STIFFNESS)

    def signal(scene: Scene, motion: Trajectory) -> Array:
        rest = SPACING * np.arange(3)
        coordinate, velocity = (
            array @ T @ MODES[:, mode]
            for array in (motion.position[:, :, 0] - rest, motion.velocity[:, :, 0])
        )
        return np.asarray(coordinate - 1j * velocity / FREQUENCIES[mode])

    return observables.rate(f"frequency of the {name} mode", signal, lambda scene: float(FREQUENCIES[mode]))


def _apart(scene: Scene, motion: Trajectory) -> Array:
    """What the springs' lengths and the joints' coordinates differ by, which nothing may part."""
    at_rest = np.array([body.position[0] for body in scene.bodies])
    springs = np.diff(motion.position[:, :, 0], axis=1, prepend=0.0) - at_rest
    return np.asarray(springs - motion.joint_position)


def _apart_in_speed(scene: Scene, motion: Trajectory) -> Array:
    return np.asarray(np.diff(motion.velocity[:, :, 0], axis=1, prepend=0.0) - motion.joint_velocity)


def _largest(name: str) -> Callable[[Scene, Trajectory], float]:
    return lambda scene, motion: float(np.abs(getattr(motion, name)).max())


RATES = {1: _frequency(1, "symmetric"), 2: _frequency(2, "antisymmetric")}


def _chain(variant: str, amplitudes: Vector) -> Scene:
    """Each mode starts a sixth of a turn past its largest displacement, the free one with a velocity.

    From a turning point, semi-implicit Euler's velocities would be accurate to second order.
    """
    size = np.array(amplitudes)
    displacement = MODES @ (size * (0.0, np.cos(PHASE), np.cos(PHASE)))
    velocity = MODES @ (size * (1.0, -FREQUENCIES[1] * np.sin(PHASE), -FREQUENCIES[2] * np.sin(PHASE)))
    bodies = tuple(
        Body(
            name,
            mass,
            diagonal(1.0, 1.0, 1.0),
            (Joint(f"{name} along x", "slide", (1.0, 0.0, 0.0), stiffness=STIFFNESS if parent else 0.0),),
            parent=parent,
            position=(SPACING if parent else 0.0, 0.0, 0.0),
        )
        for name, mass, parent in (
            ("left", OXYGEN, None),
            ("middle", CARBON, "left"),
            ("right", OXYGEN, "middle"),
        )
    )
    excited = [RATES[mode] for mode in RATES if amplitudes[mode]]
    return Scene(
        name="co2_chain",
        variant=variant,
        summary=f"Three masses in line on two springs, in {_WORDS[variant]}.",
        source="Goldstein, Classical Mechanics, ch. 6.4; Fetter & Walecka, Theoretical Mechanics, § 22",
        bodies=bodies,
        q0=tuple(np.diff(displacement, prepend=0.0).tolist()),
        v0=tuple(np.diff(velocity, prepend=0.0).tolist()),
        duration=2.5,
        samples=125,
        truth=_truth,
        scheme_motion=_scheme_motion,
        observables=(
            observables.position(),
            observables.velocity(),
            *excited,
            observables.energy(),
            observables.momentum(),
            observables.attitude(),
            observables.turning(),
            observables.invariant("joint residual", "m", _apart, _largest("position")),
            observables.invariant("joint speed residual", "m/s", _apart_in_speed, _largest("velocity")),
        ),
        pictures=(
            pictures.against_time(
                "Displacement of the left mass", "x [m]", lambda scene, m: m.joint_position[:, 0]
            ),
        ),
        ladders={
            1: (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4),
            4: (2e-2, 1e-2, 5e-3, 2.5e-3, 1.25e-3),
            # Implicit Euler damps by ω²dt/2: at coarser steps the modes have all but died.
            "discrete": (5e-4, 2.5e-4, 1.25e-4, 6.25e-5, 3.125e-5),
        },
    )


_WORDS = {
    "translation": "the mode of frequency 0: all three drift together",
    "symmetric": "the symmetric mode, √(k/m): the middle one rests",
    "antisymmetric": "the antisymmetric mode, √(k/m (1 + 2m/M)): the middle one against the outer two",
    "mixture": "a mixture of its three modes",
}

SCENES = (
    _chain("mixture", (0.02, 0.03, 0.04)),
    _chain("translation", (0.05, 0.0, 0.0)),
    _chain("symmetric", (0.0, 0.05, 0.0)),
    _chain("antisymmetric", (0.0, 0.0, 0.05)),
)
