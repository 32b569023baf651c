"""Two smooth spheres, each spinning, that meet off centre: e = 0, 0.5 and 1.

Catches an engine that pushes bodies out of the depth they met in (the speed of parting is then too
high), that lets smooth bodies rub (their spins change), or whose blow is not along the line of centres.
"""

import numpy as np

from ..reference import collisions, quaternions, two_body
from ..reference.checked import Array
from . import mechanics, observables, pictures
from .body import Body, Joint, Vector, diagonal
from .contact import Contact, Sphere
from .scene import Scene
from .trajectory import Trajectory

MASSES, RADII = (2.0, 3.0), (0.10, 0.15)
VELOCITIES: tuple[Vector, Vector] = ((1.2, 0.7, -0.3), (-0.9, 0.1, 0.4))
SPINS: tuple[Vector, Vector] = ((1.0, -2.0, 3.0), (-2.5, 0.5, 1.5))
ATTITUDES = ((0.5, -0.5, 0.1, 0.7), (0.2, 0.6, -0.6, 0.48))
#: From the first centre to the second when they meet: well away from the line of approach.
NORMAL = np.array((0.8, 0.48, 0.36))
#: In the middle of a step of every ladder, which goes by thirds to keep it there; MEETING/SAMPLE is 3 1/4.
LADDER = (8.1e-2, 2.7e-2, 9e-3, 3e-3, 1e-3)
SAMPLE, SAMPLES = 0.162, 8
MEETING = 3.25 * SAMPLE


def _restitution(scene: Scene) -> float:
    return scene.contacts[0].restitution


def _meeting(scene: Scene) -> float:
    """When the two meet [s]: |r + ut| = r1 + r2, the earlier root."""
    r, u = np.array(scene.q0[7:10]) - scene.q0[:3], np.array(scene.v0[6:9]) - scene.v0[:3]
    b, c = r @ u, r @ r - sum(RADII) ** 2
    return float(c / (-b + np.sqrt(b * b - c * (u @ u))))


def _motion(scene: Scene, t: Array, struck: float) -> Trajectory:
    """Free flight but for a blow at the time ``struck`` [s], along the line of centres of that time."""
    places = np.array([scene.q0[:3], scene.q0[7:10]])
    speeds = np.array([scene.v0[:3], scene.v0[6:9]])
    between = np.diff(places + speeds * struck, axis=0)[0]
    blow = collisions.collide(*MASSES, speeds[0], speeds[1], _restitution(scene), between)
    change = np.array([blow.v1, blow.v2]) - speeds
    late = np.maximum(t - struck, 0.0)[:, None, None]
    position = places + speeds * t[:, None, None] + change * late
    velocity = speeds + change * (late > 0)
    omega = np.array([scene.v0[3:6], scene.v0[9:12]])
    start = np.array([scene.q0[3:7], scene.q0[10:14]])
    turned = quaternions.product(start, quaternions.from_rotation_vector(t[:, None, None] * omega))
    none = np.empty((len(t), 0))
    return Trajectory(t, position, turned, velocity, np.broadcast_to(omega, position.shape), none, none)


def _truth(scene: Scene, t: Array) -> Trajectory:
    return _motion(scene, t, _meeting(scene))


def _scheme_motion(scene: Scene, twin: str, dt: float, t: Array) -> Trajectory | None:
    """First-order schemes fly exactly and turn exactly, and strike in the first step that begins inside."""
    if twin == "RKMK4":
        return None
    return _motion(scene, t, float(np.ceil(_meeting(scene) / dt)) * dt)


def _blow(scene: Scene, motion: Trajectory) -> float:
    """1 + e: the change of the relative velocity, along itself, over the velocity of meeting; 0 if none."""
    before, after = (np.diff(motion.velocity[i], axis=0)[0] for i in (0, -1))
    change = before - after
    return float(change @ change / (before @ change)) if change.any() else 0.0


def _kept(scene: Scene, motion: Trajectory) -> float:
    """Share of the kinetic energy of their centres that is left."""
    energy = np.sum(mechanics.masses(scene) * np.sum(motion.velocity**2, axis=2), axis=1)
    return float(energy[-1] / energy[0])


def _turned(scene: Scene, motion: Trajectory) -> float:
    """Angle [rad] by which the relative velocity turns: that of scattering, about the centre of mass."""
    before, after = (np.diff(motion.velocity[i], axis=0)[0] for i in (0, -1))
    return float(np.arctan2(np.linalg.norm(np.cross(before, after)), before @ after))


def _exactly_kept(scene: Scene) -> float:
    u = np.array(VELOCITIES[1]) - VELOCITIES[0]
    along, mu = float(u @ NORMAL), two_body.reduced_mass(*MASSES)
    total = sum(m * float(np.dot(v, v)) for m, v in zip(MASSES, VELOCITIES, strict=True)) / 2
    return 1 - mu * (1 - _restitution(scene) ** 2) * along**2 / 2 / total


def _exactly_turned(scene: Scene) -> float:
    """From u, whose part along the normal changes by the factor −e."""
    u = np.array(VELOCITIES[1]) - VELOCITIES[0]
    along = float(u @ NORMAL)
    across = float(np.sqrt(u @ u - along**2))
    return float(np.arctan2(across, along) - np.arctan2(across, -_restitution(scene) * along)) % np.pi


def _collision(restitution: float, defaults: bool = False) -> Scene:
    unit = [np.array(q) / np.linalg.norm(q) for q in ATTITUDES]
    where = (np.zeros(3), sum(RADII) * NORMAL)
    start = [w - MEETING * np.array(v) for w, v in zip(where, VELOCITIES, strict=True)]
    bodies = tuple(
        Body(name, m, diagonal(*(0.4 * m * r * r,) * 3), (Joint(f"{name} flies", "free"),))
        for name, m, r in zip(("first", "second"), MASSES, RADII, strict=True)
    )
    return Scene(
        name="collisions",
        variant="defaults" if defaults else f"e={restitution:g}",
        summary="What a user gets who sets nothing: e = 1 is asked for, of contacts as they come."
        if defaults
        else f"Two smooth spinning spheres meet off centre, e = {restitution:g}.",
        defaults=defaults,
        source="Goldstein, Classical Mechanics, ch. 3.11; Landau & Lifshitz, Mechanics, § 17",
        bodies=bodies,
        contacts=(Contact("first", Sphere(RADII[0]), "second", Sphere(RADII[1]), restitution=restitution),),
        q0=tuple(np.concatenate([start[0], unit[0], start[1], unit[1]]).tolist()),
        v0=(*VELOCITIES[0], *SPINS[0], *VELOCITIES[1], *SPINS[1]),
        duration=SAMPLE * SAMPLES,
        samples=SAMPLES,
        truth=_truth,
        scheme_motion=_scheme_motion,
        observables=(
            observables.position(),
            observables.velocity(),
            observables.orientation(),
            observables.omega(),
            observables.fitted("1 + e", "1", _blow, lambda scene: 1 + _restitution(scene)),
            observables.fitted("energy kept", "1", _kept, _exactly_kept),
            observables.fitted("angle of scattering", "rad", _turned, _exactly_turned),
            observables.momentum(),
            observables.angular_momentum(),
            observables.unit_norm(),
        ),
        pictures=(
            pictures.against_time("The first's x", "x [m]", lambda scene, m: m.position[:, 0, 0]),
            pictures.against_time("The second's x", "x [m]", lambda scene, m: m.position[:, 1, 0]),
        ),
        ladders={} if defaults else {1: LADDER},
    )


SCENES = (*(_collision(e) for e in (0.0, 0.5, 1.0)), _collision(1.0, defaults=True))
