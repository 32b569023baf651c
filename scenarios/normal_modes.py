"""Equal beads in line on equal springs: modes whose frequencies have a closed form, up to 64 of them.

The long chain catches an engine that loses accuracy, or leaves out a spring, far down a tree of bodies. The
ring, whose waves are as fast either way round, catches one that tells modes of equal frequency apart.
"""

from collections.abc import Callable
from functools import cache

import numpy as np

from ..reference import bead_chain, schemes
from ..reference.bead_chain import Ends
from ..reference.checked import Array
from . import observables, pictures
from .body import Body, Joint, diagonal
from .co2_chain import SCHEMES
from .forces import Spring
from .observables import Observable
from .scene import Scene, SchemeMotion
from .trajectory import Trajectory

MASS, STIFFNESS, SPACING, AMPLITUDE = 1.0, 100.0, 0.1, 0.05
PHASE = np.pi / 3
#: A ring's springs are forces, which no scheme treats implicitly.
RING_SCHEMES: dict[str, schemes.Scheme] = {
    twin: "rk4" if twin == "RKMK4" else "semi_implicit_euler" for twin in SCHEMES
}


WHERE: dict[Ends, str] = {
    "wall": "on a wall",
    "free": "free at both ends, which drift as one,",
    "ring": "the last tied to the first, with modes of equal frequency,",
}


def shape(beads: int, ends: Ends, mode: int) -> Array:
    """Displacements (N,) of the beads in a mode, counted from 0 upwards in frequency; AᵀTA = 1."""
    n = np.arange(1, beads + 1)
    if ends == "wall":
        wave = np.sin((2 * mode + 1) * np.pi / (2 * beads + 1) * n)
    elif ends == "ring":
        # A pair of equal frequency is a cosine and a sine.
        wave = np.cos((mode + 1) // 2 * 2 * np.pi / beads * n - (mode % 2 == 0 and mode > 0) * np.pi / 2)
    else:
        wave = np.cos(mode * np.pi / beads * (n - 0.5))
    return np.asarray(wave / np.sqrt(MASS * (wave @ wave)))


def _start(scene: Scene) -> tuple[Array, Array]:
    """Displacements and velocities of the beads, from the joints' relative ones."""
    return np.cumsum(scene.q0), np.cumsum(scene.v0)


def _ends(scene: Scene) -> Ends:
    return "ring" if scene.forces else "wall" if scene.joints[0].stiffness else "free"


def _at_rest(scene: Scene) -> Array:
    return np.cumsum([body.position[0] for body in scene.bodies])


def _along_x(scene: Scene, t: Array, eta: Array, eta_rate: Array) -> Trajectory:
    position, velocity = np.zeros((*eta.shape, 3)), np.zeros((*eta.shape, 3))
    position[:, :, 0], velocity[:, :, 0] = eta + _at_rest(scene), eta_rate
    upright = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (*eta.shape, 4))
    q, v = (np.diff(array, axis=1, prepend=0.0) for array in (eta, eta_rate))
    return Trajectory(t, position, upright, velocity, np.zeros_like(velocity), q, v)


@cache
def _all_modes(beads: int, ends: Ends) -> tuple[Array, Array]:
    forms = np.column_stack([shape(beads, ends, mode) for mode in range(beads)])
    return bead_chain.frequencies(beads, MASS, STIFFNESS, ends), forms


def _truth(scene: Scene, t: Array) -> Trajectory:
    """Every mode on its own, in closed form; one of frequency 0 drifts."""
    omega, forms = _all_modes(len(scene.bodies), _ends(scene))
    xi, xi_rate = (MASS * start @ forms for start in _start(scene))
    cos, sin = np.cos(np.outer(t, omega)), np.sin(np.outer(t, omega))
    drift = np.where(omega == 0, t[:, None], sin / np.where(omega == 0, 1.0, omega))
    eta, eta_rate = xi * cos + xi_rate * drift, xi_rate * cos - xi * omega * sin
    return _along_x(scene, t, eta @ forms.T, eta_rate @ forms.T)


def _scheme_motion(beads: int, ends: Ends, modes: tuple[int, ...]) -> SchemeMotion:
    """A scheme takes each mode on its own, so that what the others would cost, at rest, is saved."""
    squares = np.diag(bead_chain.frequencies(beads, MASS, STIFFNESS, ends)[list(modes)] ** 2)
    forms = np.column_stack([shape(beads, ends, mode) for mode in modes])
    known = RING_SCHEMES if ends == "ring" else SCHEMES

    def moved(scene: Scene, twin: str, dt: float, t: Array) -> Trajectory | None:
        if twin not in known:
            return None
        xi, xi_rate = (MASS * forms.T @ start for start in _start(scene))
        steps = np.rint(t / dt)
        xis = schemes.linear_motion(known[twin], np.eye(len(modes)), squares, xi, xi_rate, dt, steps)
        return _along_x(scene, t, *(array @ forms.T for array in xis))

    return moved


def _frequency(beads: int, ends: Ends, mode: int) -> Observable:
    omega = float(bead_chain.frequencies(beads, MASS, STIFFNESS, ends)[mode])
    form = MASS * shape(beads, ends, mode)

    def signal(scene: Scene, motion: Trajectory) -> Array:
        coordinate = (motion.position[:, :, 0] - _at_rest(scene)) @ form
        return np.asarray(coordinate - 1j * (motion.velocity[:, :, 0] @ form) / omega)

    return observables.rate(f"frequency of mode {mode + 1}", signal, lambda scene: omega)


def _turning(beads: int, ends: Ends, mode: int) -> Observable:
    """ξ1 dξ2/dt − ξ2 dξ1/dt of a mode and the next, kept while both are equally fast."""
    first, second = (MASS * shape(beads, ends, one) for one in (mode, mode + 1))

    def of(scene: Scene, motion: Trajectory) -> Array:
        x, v = motion.position[:, :, 0] - _at_rest(scene), motion.velocity[:, :, 0]
        return np.asarray((x @ first) * (v @ second) - (x @ second) * (v @ first))

    def scale(scene: Scene, motion: Trajectory) -> float:
        return float(np.abs(of(scene, motion)).max())

    return observables.invariant(
        f"momentum round the ring of modes {mode + 1} and {mode + 2}", "J s", of, scale
    )


def _apart(scene: Scene, motion: Trajectory) -> Array:
    """What the springs' lengths and the joints' coordinates differ by, which nothing may part."""
    displaced = motion.position[:, :, 0] - _at_rest(scene)
    return np.asarray(np.diff(displaced, axis=1, prepend=0.0) - motion.joint_position)


def _apart_in_speed(scene: Scene, motion: Trajectory) -> Array:
    return np.asarray(np.diff(motion.velocity[:, :, 0], axis=1, prepend=0.0) - motion.joint_velocity)


def _largest(name: str) -> Callable[[Scene, Trajectory], float]:
    return lambda scene, motion: float(np.abs(getattr(motion, name)).max())


def _ring(beads: int) -> tuple[Spring, ...]:
    """A spring from each bead to the next, the longest from the last back to the first."""
    nexts = [(n, n % beads + 1) for n in range(1, beads + 1)]
    return tuple(Spring(f"bead {i}", f"bead {j}", STIFFNESS, SPACING * abs(j - i)) for i, j in nexts)


def _chain(beads: int, ends: Ends, modes: tuple[int, ...]) -> Scene:
    """Each mode starts a sixth of a turn past its largest displacement; one that drifts has a velocity."""
    omega = bead_chain.frequencies(beads, MASS, STIFFNESS, ends)
    displacement, velocity = np.zeros(beads), np.zeros(beads)
    for mode in modes:
        form = AMPLITUDE * shape(beads, ends, mode)
        displacement += form * (np.cos(PHASE) if omega[mode] else 0.0)
        # The second of a ring's pair starts the other way: together they are a wave that runs round it.
        way = -1 if ends == "ring" and mode % 2 == 0 else 1
        velocity += form * (-way * omega[mode] * np.sin(PHASE) if omega[mode] else 1.0)
    bodies = tuple(
        Body(
            f"bead {n}",
            MASS,
            diagonal(1.0, 1.0, 1.0),
            (
                Joint(
                    f"spring {n}",
                    "slide",
                    (1.0, 0.0, 0.0),
                    stiffness=STIFFNESS if ends == "wall" or (ends == "free" and n > 1) else 0.0,
                ),
            ),
            parent=f"bead {n - 1}" if n > 1 else None,
            position=(SPACING, 0.0, 0.0),
        )
        for n in range(1, beads + 1)
    )
    kept: tuple[Observable, ...] = () if ends == "wall" else (observables.momentum(),)
    if ends == "ring":
        kept += (_turning(beads, ends, 1),)
    return Scene(
        name="normal_modes",
        variant=f"{beads}_{ends}",
        summary=f"{beads} beads in line on springs, {WHERE[ends]} in a mixture of {len(modes)} modes.",
        source="Fetter & Walecka, Theoretical Mechanics, ch. 4; Goldstein, Classical Mechanics, ch. 6.3",
        bodies=bodies,
        forces=_ring(beads) if ends == "ring" else (),
        q0=tuple(np.diff(displacement, prepend=0.0).tolist()),
        v0=tuple(np.diff(velocity, prepend=0.0).tolist()),
        # A step's cost grows with the chain: the longest is followed for less time.
        duration=1.0 if beads < 64 else 0.2,
        samples=25 if beads < 64 else 5,
        truth=_truth,
        scheme_motion=_scheme_motion(beads, ends, modes),
        observables=(
            observables.position(),
            observables.velocity(),
            *(_frequency(beads, ends, mode) for mode in modes if omega[mode]),
            observables.energy(),
            *kept,
            observables.attitude(),
            observables.turning(),
            observables.invariant("joint residual", "m", _apart, _largest("position")),
            observables.invariant("joint speed residual", "m/s", _apart_in_speed, _largest("velocity")),
        ),
        pictures=(
            pictures.against_time(
                "Last bead", "x [m]", lambda scene, m: m.position[:, -1, 0] - _at_rest(scene)[-1]
            ),
        ),
        ladders={
            1: (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4),
            4: (2e-2, 1e-2, 5e-3, 2.5e-3, 1.25e-3),
            # Implicit Euler damps by ω²dt/2: at coarser steps the fastest mode has all but died.
            **({} if ends == "ring" else {"discrete": (5e-4, 2.5e-4, 1.25e-4, 6.25e-5, 3.125e-5)}),
        },
    )


# Of the longest chain no slow mode beside the fastest: its phase would be read from velocities eighty
# times its own, and be no better than the rounding of those.
SCENES = (
    _chain(4, "wall", (0, 1, 2, 3)),
    _chain(16, "wall", (0, 6, 15)),
    _chain(64, "wall", (10, 20, 63)),
    _chain(16, "free", (0, 5, 15)),
    _chain(6, "ring", (0, 1, 2, 5)),
)
