"""Two masses on two springs, one far heavier than the other: next to the wall, or beyond the light one.

In the joints' coordinates the mass matrix of a heavy body on a light one is singular but for their ratio.
"""

import numpy as np

from ..reference import normal_modes, scheme_stability
from ..reference.checked import Array
from . import observables
from .body import Body, Joint, diagonal
from .co2_chain import SCHEMES
from .scene import Scene
from .trajectory import Trajectory

STIFFNESS, SPACING, AMPLITUDE, PHASE = 1e4, 1.0, 1e-2, np.pi / 3


def _matrices(scene: Scene) -> tuple[Array, Array]:
    T = np.diag([body.mass for body in scene.bodies])
    return T, STIFFNESS * np.array([[2.0, -1.0], [-1.0, 1.0]])


def _fastest(scene: Scene) -> float:
    omega, _ = normal_modes.normal_modes(*_matrices(scene))
    return float(omega[-1])


def _truth(scene: Scene, t: Array) -> Trajectory:
    x, speed = normal_modes.motion(*_matrices(scene), np.cumsum(scene.q0), np.cumsum(scene.v0), t)
    position, velocity = np.zeros((2, len(t), 2, 3))
    position[:, :, 0], velocity[:, :, 0] = x + SPACING * np.array([1.0, 2.0]), speed
    upright = np.tile([0.0, 0.0, 0.0, 1.0], (len(t), 2, 1))
    joint, rate = (np.diff(array, axis=1, prepend=0.0) for array in (x, speed))
    return Trajectory(t, position, upright, velocity, np.zeros_like(velocity), joint, rate)


def _stable_step(scene: Scene, twin: str) -> float | None:
    if twin not in SCHEMES:
        return None
    return scheme_stability.largest_stable_step(SCHEMES[twin], _fastest(scene))


def _chain(name: str, ratio: float, masses: tuple[float, float]) -> Scene:
    """The light mass is set swinging; the heavy one is at rest, so that all energy is in what is fast."""
    light = int(np.argmin(masses))
    omega = np.sqrt(STIFFNESS * (2 - light) / masses[light])
    displacement, velocity = np.zeros((2, 2))
    displacement[light], velocity[light] = AMPLITUDE * np.cos(PHASE), -AMPLITUDE * omega * np.sin(PHASE)
    bodies = tuple(
        Body(
            body,
            mass,
            diagonal(1.0, 1.0, 1.0),
            (Joint(f"{body} spring", "slide", (1.0, 0.0, 0.0), stiffness=STIFFNESS),),
            parent=parent,
            position=(SPACING, 0.0, 0.0),
        )
        for body, parent, mass in zip(("inner", "outer"), (None, "inner"), masses, strict=True)
    )
    return Scene(
        name=name,
        variant=f"{ratio:g}",
        summary=f"Two masses on springs, of {masses[0]:g} and {masses[1]:g} kg from the wall.",
        source="Goldstein, Classical Mechanics, ch. 6.2; Fetter & Walecka, Theoretical Mechanics, § 22",
        bodies=bodies,
        q0=tuple(np.diff(displacement, prepend=0.0).tolist()),
        v0=tuple(np.diff(velocity, prepend=0.0).tolist()),
        duration=float(32 / omega),
        samples=32,
        dt=float(0.1 / omega),
        truth=_truth,
        stable_step=_stable_step,
        observables=(observables.position(), observables.velocity(), observables.energy()),
    )


def heavy_outside(ratio: float) -> Scene:
    """1 kg next to the wall, and ``ratio`` kg beyond it."""
    return _chain("heavy_outside", ratio, (1.0, ratio))


def heavy_inside(ratio: float) -> Scene:
    """``ratio`` kg next to the wall, and 1 kg beyond it."""
    return _chain("heavy_inside", ratio, (ratio, 1.0))
