"""A rotor on a fixed axle, and what its bearings bear: nothing but its weight, where it is balanced.

Its motion says nothing of its balance: whatever weights are on it, it turns evenly. What tells them apart is
the reaction of the axle, which no other scene reads. Catches an engine that moves all bodies rightly but
tells the reactions of its joints in other axes, about another point, without the weight, with the gyroscopic
moment twice, or a step late.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..reference import inertia, quaternions, rotor_balance, schemes
from ..reference.checked import Array
from . import hinged, observables, pictures, reactions
from .body import Body, Joint, Matrix, Quaternion, Vector
from .observables import Observable
from .scene import Scene
from .trajectory import Trajectory

#: The bare rotor, balanced: mass [kg], height of its centre on the axle [m], inertia about it [kg m²].
MASS, HEIGHT = 2.0, 0.03
INERTIA: Matrix = ((0.012, 0.002, 0.0), (0.002, 0.010, 0.0), (0.0, 0.0, 0.018))
#: Heights of the two bearings on the axle [m]; spin [rad/s] and angle [rad] at the start; g [m/s²].
BEARINGS, SPIN, ANGLE, G = (-0.1, 0.2), 40.0, 0.7, 9.81
#: Torque of the brake over speed [N m s].
BRAKE = 0.055

#: What is fixed to the rotor: mass [kg] and place [m], in its axes, the axle along z.
Weight = tuple[float, Vector]
#: At the height of the centre, which so leaves the axle; in opposite corners, which so turn the axes.
BESIDE: tuple[Weight, ...] = ((0.08, (0.06, 0.02, HEIGHT)),)
SKEW: tuple[Weight, ...] = ((0.05, (0.06, 0.02, 0.11)), (0.05, (-0.06, -0.02, -0.05)))
ANYHOW: tuple[Weight, ...] = ((0.05, (0.06, 0.02, 0.11)), (0.03, (-0.03, 0.05, -0.06)))
#: In two planes, by ``reference.rotor_balance.correction``: with these the last are in balance.
BALANCING: tuple[Weight, ...] = ((0.05, (0.09 / 11, -0.03, -0.08)), (0.05, (-0.552 / 11, -0.02, 0.14)))

#: Turns of the axle in the room. Upright where there is weight, or it would turn a rotor off its centre.
UPRIGHT: Quaternion = (0.0, 0.0, 0.6, 0.8)
TILTED: Quaternion = (0.5, -0.1, 0.7, 0.5)

SCHEMES: dict[str, schemes.Scheme] = {
    "semi-implicit Euler": "semi_implicit_euler",
    "implicit gyroscopic": "implicit_damping",
    "implicitfast": "implicit_damping",
    "discrete": "implicit_damping",
    "RKMK4": "rk4",
}


def _weighted(weights: Sequence[Weight], brake: float, turn: Quaternion) -> Body:
    """The rotor with these weights on it."""
    masses = np.array([MASS, *(mass for mass, _ in weights)])
    places = np.array([(0.0, 0.0, HEIGHT), *(place for _, place in weights)])
    # Rounded, so that of what cancels nothing is left, nor its sign.
    centre = np.round(masses @ places / masses.sum(), 15) + 0.0
    arms = places - centre
    squares = np.einsum("p,pi,pi", masses, arms, arms) * np.eye(3)
    tensor = np.round(np.array(INERTIA) + squares - np.einsum("p,pi,pj", masses, arms, arms), 15)
    axle = Joint("axle", "hinge", (0.0, 0.0, 1.0), damping=brake)
    x, y, z = ((float(a), float(b), float(c)) for a, b, c in (tensor + tensor.T) / 2)
    return Body(
        "rotor", float(masses.sum()), (x, y, z), (axle,), tuple(centre.tolist()), position=(0.3, -0.2, 0.1),
        quaternion=turn,
    )  # fmt: skip


def _turning(scene: Scene, t: Array, angle: Array, rate: Array) -> Trajectory:
    """The rotor at angles and rates (n,), slowed by its brake alone, and what the axle does to it."""
    body, tensor = scene.bodies[0], _about_origin(scene)
    slowing = -body.joints[0].damping / tensor[2, 2] * rate
    motion = hinged.motion(scene.bodies, t, angle[:, None], rate[:, None])
    back = quaternions.conjugate(motion.quaternion[:, 0])
    pull = body.mass * quaternions.rotated(back, np.array(scene.gravity))
    spun, slowed = ((1.0, 0.0), (0.0, 1.0))  # ω and α
    force, moment = np.zeros((2, len(t), 3))
    for share, alone in ((rate**2, spun), (slowing, slowed)):
        force += np.outer(share, rotor_balance.axle_force(body.mass, body.center_of_mass, *alone))
        moment += np.outer(share, rotor_balance.bearing_torque(tensor, *alone))
    reaction = np.hstack([force - pull, moment - np.cross(body.center_of_mass, pull)])
    return replace(motion, reaction=reaction[:, None])


def _about_origin(scene: Scene) -> Array:
    body = scene.bodies[0]
    return inertia.about_point(body.inertia_array, body.mass, body.center_of_mass)


def _truth(scene: Scene, t: Array) -> Trajectory:
    fading = scene.joints[0].damping / _about_origin(scene)[2, 2]
    spun = -np.expm1(-fading * t) / fading if fading else t
    spin = scene.v0[0]
    return _turning(scene, t, scene.q0[0] + spin * spun, spin * np.exp(-fading * t))


def _scheme_motion(scene: Scene, twin: str, dt: float, t: Array) -> Trajectory | None:
    if twin not in SCHEMES:
        return None
    moment, brake = _about_origin(scene)[2:, 2:], [[scene.joints[0].damping]]
    start = scene.q0, scene.v0, dt, np.rint(t / dt)
    angle, rate = schemes.linear_motion(SCHEMES[twin], moment, [[0.0]], *start, damping=brake)
    return _turning(scene, t, angle[:, 0], rate[:, 0])


def bearing_forces(motion: Trajectory) -> Array:
    """Transverse forces (n, 2, 2) [N] of the two bearings on the rotor, in its axes, a row each."""
    return rotor_balance.shared(BEARINGS, motion.reaction[:, 0, :3], motion.reaction[:, 0, 3:])


def _velocity() -> Observable:
    """The centre's velocity, rounded as large as it is in engines that take it about the world's origin."""
    return replace(
        observables.velocity(),
        scale=lambda scene, b: float(np.abs(b.omega).max() * np.linalg.norm(b.position, axis=2).max()),
    )


def _on_bearings() -> Observable:
    force, moment = reactions.force(), reactions.moment()
    apart = BEARINGS[1] - BEARINGS[0]
    return Observable(
        "bearing forces",
        "N",
        "state",
        lambda scene, a, b: (bearing_forces(a) - bearing_forces(b)).reshape(len(a.t), -1),
        lambda scene, b: force.scale(scene, b) + moment.scale(scene, b) / apart,
    )


def _momentum_across(scene: Scene, motion: Trajectory) -> Array:
    """L_x + i L_y (n,) about the axle's origin, the axle along z and at rest in the room."""
    body, at_rest = scene.bodies[0], quaternions.conjugate(np.array(scene.bodies[0].quaternion))
    spin = quaternions.rotated(motion.quaternion[:, 0], motion.omega[:, 0] @ body.inertia_array)
    arm = motion.position[:, 0] - body.position
    momentum = quaternions.rotated(at_rest, spin + body.mass * np.cross(arm, motion.velocity[:, 0]))
    return np.asarray(momentum[:, 0] + 1j * momentum[:, 1])


def _in_room(scene: Scene, motion: Trajectory) -> Array:
    """What the first bearing bears along one direction across the axle (n,) [N]: a hum at the spin."""
    across = bearing_forces(motion)[:, 0] @ np.array([1, 1j]) * np.exp(1j * motion.joint_position[:, 0])
    return np.asarray(across.real)


def _rotor(variant: str, summary: str, weights: Sequence[Weight], turn: Quaternion, brake: float) -> Scene:
    circling = observables.rate("turning of L", _momentum_across, lambda scene: abs(scene.v0[0]))
    return Scene(
        name="rotor_balance",
        variant=variant,
        summary=f"A rotor on a fixed axle and what its bearings bear: {summary}.",
        source="Goldstein, Classical Mechanics, § 5.5; Taylor, Classical Mechanics, §§ 10.2, 10.3",
        bodies=(_weighted(weights, brake, turn),),
        gravity=(0.0, 0.0, -G if turn is UPRIGHT else 0.0),
        q0=(ANGLE,),
        v0=(SPIN,),
        duration=1.28,
        samples=80,
        truth=_truth,
        scheme_motion=_scheme_motion,
        reactions=("rotor",),
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            _velocity(),
            hinged.angle(),
            reactions.force(),
            reactions.moment(),
            _on_bearings(),
            *((circling,) if variant in ("static", "dynamic") else ()),
            *(() if brake else (observables.energy(),)),
            hinged.residual(),
            observables.unit_norm(),
        ),
        pictures=(pictures.against_time("First bearing", "force across the axle [N]", _in_room),),
        # Of fourth order the bearings' forces are clear of round-off down to 4 ms alone.
        ladders={1: (8e-3, 4e-3, 2e-3, 1e-3, 5e-4), 4: (1.6e-2, 8e-3, 1.6e-2 / 3, 4e-3, 2e-3)},
    )


SCENES = (
    _rotor("braked", "out of balance both ways, and slowed by a damper", ANYHOW, UPRIGHT, BRAKE),
    _rotor(
        "balanced", "weights of every kind, and two that balance them", (*ANYHOW, *BALANCING), TILTED, 0.0
    ),
    _rotor("static", "its centre is off the axle, ω² times which they pull at", BESIDE, UPRIGHT, 0.0),
    _rotor("dynamic", "its centre is on the axle, ω²(−I_yz, I_xz) turns at them", SKEW, TILTED, 0.0),
)
