"""A ball that rolls on a turning table: in the room its path is a circle, gone round at 2Ω/7.

Catches an engine whose friction knows the speed of the ball but not that of the surface under it, or
takes that of the surface where the ball is not. The table is so heavy that the ball does not slow it.
"""

import numpy as np

from ..reference import quaternions, sphere_on_turntable
from ..reference.checked import Array
from . import observables, pictures
from .body import Body, Joint, diagonal
from .contact import Contact, Plane, Sphere
from .scene import Scene, Softness
from .trajectory import Trajectory

MASS, RADIUS, TURNING, HEIGHT, GRAVITY = 0.7, 0.1, 3.0, 0.05, 9.81
#: Of the table: the ball's torque of 1 N m changes its speed by 1e-15 rad/s in a second.
TABLE_MASS, TABLE_INERTIA = 1e6, 1e15
PLACE, VELOCITY, SPIN = (0.4, -0.2), (0.3, 0.5), 1.5
#: 2Ω/7.
RATE = 6 / 7
ATTITUDE = np.array((0.5, -0.5, 0.1, 0.7))
#: Turns between two samples by which the truth's attitude is followed, 2^FINE; the rule is of order 4.
FINE = 9

SOFT = Softness(
    2e-5,
    "MuJoCo's contact holds back 0.9999 of what pushes it in a step: 8.6e-6 rad is the most measured, at dt "
    "16 ms, and 3.1e-7 rad at 1 ms",
    dt=1.6e-2,
    order=1,
)


def _plane_motion(scene: Scene, t: Array) -> tuple[Array, Array, Array]:
    """Place and velocity (n, 2) of the ball and ω (n, 3), world axes."""
    Omega, start, speed = scene.v0[0], scene.q0[1:3], scene.v0[1:3]
    spin = float(quaternions.rotated(np.array(scene.q0[4:8]), np.array(scene.v0[4:7]))[2])
    return sphere_on_turntable.ball_on_a_turntable(RADIUS, Omega, start, speed, t, spin)


def _assembled(scene: Scene, t: Array, r: Array, v: Array, q: Array, omega: Array) -> Trajectory:
    n, Omega, angle = len(t), scene.v0[0], scene.q0[0] + scene.v0[0] * t
    level = np.full((n, 1), scene.q0[3])
    position = np.stack([np.zeros((n, 3)), np.hstack([r, level])], axis=1)
    velocity = np.stack([np.zeros((n, 3)), np.hstack([v, 0 * level])], axis=1)
    table = quaternions.from_rotation_vector(np.outer(angle, [0.0, 0.0, 1.0]))
    turning = np.broadcast_to([0.0, 0.0, Omega], (n, 3))
    body = quaternions.rotated(quaternions.conjugate(q), omega)
    return Trajectory(
        t, position, np.stack([table, q], axis=1), velocity, np.stack([turning, body], axis=1),
        angle[:, None], np.full((n, 1), Omega),
    )  # fmt: skip


def _followed(start: Array, turns: Array) -> Array:
    """Attitudes (n + 1, 4) after the turns (n, k, 3), world axes, of each sample, one after the other."""
    q = quaternions.from_rotation_vector(turns)
    while q.shape[1] > 1:
        if q.shape[1] % 2:
            q = np.concatenate([q, np.broadcast_to([0.0, 0.0, 0.0, 1.0], (len(q), 1, 4))], axis=1)
        q = quaternions.product(q[:, 1::2], q[:, ::2])
    found = [start]
    for turn in q[:, 0]:
        now = quaternions.product(turn, found[-1])
        found.append(now / np.linalg.norm(now))
    return np.array(found)


def _truth(scene: Scene, t: Array) -> Trajectory:
    """Place and ω in closed form; the attitude from ω by Magnus's series, as ω does not keep its axis."""
    r, v, omega = _plane_motion(scene, t)
    times = np.concatenate([[0.0], t])
    h = np.diff(times)[:, None] / 2**FINE
    middle = times[:-1, None] + h * (np.arange(2**FINE) + 0.5)
    early, late = (_plane_motion(scene, (middle + s * h / np.sqrt(12)).ravel())[2] for s in (-1, 1))
    h = np.repeat(h, 2**FINE, axis=1).ravel()[:, None]
    turns = h / 2 * (early + late) + np.sqrt(3) / 12 * h**2 * np.cross(late, early)
    q = _followed(np.array(scene.q0[4:8]), turns.reshape(len(t), -1, 3))[1:]
    return _assembled(scene, t, r, v, q, omega)


def _scheme_motion(scene: Scene, twin: str, dt: float, t: Array) -> Trajectory | None:
    """In a step the velocity turns as by Euler's explicit rule, as the surface is that under the start of it.

    So v_(n+1) = (1 + iW dt) v_n, W = 2Ω/7, but in the first step, where the ball already rolls.
    """
    if twin == "RKMK4":
        return None
    Omega, steps = scene.v0[0], round(float(t[-1]) / dt)
    W = sphere_on_turntable.circling_rate(Omega)
    ahead = (1 + 1j * W * dt) ** np.maximum(np.arange(steps + 1) - 1, 0)
    v = complex(*scene.v0[1:3]) * ahead
    r = complex(*scene.q0[1:3]) + dt * (np.cumsum(v) - v[0])
    under = np.concatenate([r[:1], r[:-1]])
    across = (1j * v + Omega * under) / RADIUS
    spin = float(quaternions.rotated(np.array(scene.q0[4:8]), np.array(scene.v0[4:7]))[2])
    omega = np.column_stack([across.real, across.imag, np.full(steps + 1, spin)])
    stride = steps // (len(t) - 1)
    turned = _followed(np.array(scene.q0[4:8]), dt * omega[1:].reshape(len(t) - 1, stride, 3))
    seen = slice(None, None, stride)
    r_seen, v_seen = (np.column_stack([z.real, z.imag])[seen] for z in (r, v))
    return _assembled(scene, t, r_seen, v_seen, turned, omega[seen])


def _circling(scene: Scene, motion: Trajectory) -> Array:
    return np.asarray(motion.velocity[:, 1, 0] + 1j * motion.velocity[:, 1, 1])


def _spin(scene: Scene, motion: Trajectory) -> Array:
    """ω of the ball about the vertical, (n,) [rad/s]."""
    return quaternions.rotated(motion.quaternion[:, 1], motion.omega[:, 1])[:, 2]


def _slip(scene: Scene, motion: Trajectory) -> Array:
    """Velocity of the ball's lowest point over the table's, (n, 2) [m/s]."""
    omega = quaternions.rotated(motion.quaternion[:, 1], motion.omega[:, 1])
    table = np.cross([0.0, 0.0, scene.v0[0]], motion.position[:, 1])
    return np.asarray(motion.velocity[:, 1] - np.cross(omega, [0.0, 0.0, RADIUS]) - table)[:, :2]


def _surface_speed(scene: Scene, motion: Trajectory) -> float:
    return float(scene.v0[0] * np.linalg.norm(motion.position[:, 1, :2], axis=1).max())


def _table(scene: Scene, motion: Trajectory) -> Array:
    """How far the hinge's angle has gone beyond Ωt, and its rate, (n, 2)."""
    return np.hstack([motion.joint_position - scene.v0[0] * motion.t[:, None], motion.joint_velocity])


#: ω of the ball at the start, world axes [rad/s]: that it rolls, as `ball_on_a_turntable` gives it.
OMEGA = (7.0, -3.0, 1.5)


def _ball() -> Scene:
    attitude = ATTITUDE / np.linalg.norm(ATTITUDE)
    body = quaternions.rotated(quaternions.conjugate(attitude), np.array(OMEGA))
    moment = 0.4 * MASS * RADIUS**2
    plate = diagonal(TABLE_INERTIA, TABLE_INERTIA, TABLE_INERTIA)
    return Scene(
        name="sphere_on_turntable",
        summary="A ball that rolls on a turning table goes round a circle at 2Ω/7.",
        source="Weltner, Am. J. Phys. 47 (1979) 984",
        bodies=(
            Body("table", TABLE_MASS, plate, (Joint("axle", "hinge"),)),
            Body("ball", MASS, diagonal(moment, moment, moment), (Joint("free", "free"),)),
        ),
        contacts=(Contact("ball", Sphere(RADIUS), "table", Plane(offset=HEIGHT), friction=1.0),),
        gravity=(0.0, 0.0, -GRAVITY),
        q0=(0.2, *PLACE, RADIUS + HEIGHT, *attitude.tolist()),
        v0=(TURNING, *VELOCITY, 0.0, *body.tolist()),
        duration=1.28,
        samples=20,
        dt=4e-3,
        truth=_truth,
        scheme_motion=_scheme_motion,
        soft={"mujoco": SOFT},
        observables=(
            observables.position(),
            observables.velocity(),
            observables.orientation(),
            observables.omega(),
            observables.rate("circling", _circling, lambda scene: RATE),
            observables.invariant("slip", "m/s", _slip, _surface_speed),
            observables.invariant("spin", "rad/s", _spin, lambda scene, b: float(np.abs(b.omega).max())),
            observables.invariant("table", "rad", _table, lambda scene, b: scene.v0[0] * scene.duration),
            observables.unit_norm(),
        ),
        pictures=(
            pictures.Picture("Path of the ball", ("x [m]", "y [m]"), lambda scene, m: m.position[:, 1, :2]),
        ),
        ladders={1: (1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3)},
    )


SCENES = (_ball(),)
