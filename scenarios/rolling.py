"""Round bodies on an incline: at 0.95 of the slope at which they would slip, and at 1.05 of it.

Catches an engine whose friction is not Coulomb's: one that gives way a little where a body should
roll, grips a little where it should slip, or depends on the moment of inertia in another way.
"""

import numpy as np

from ..reference import quaternions, rolling
from ..reference.checked import Array
from ..reference.errors import InputError
from . import observables, pictures
from .body import Body, Joint, diagonal
from .contact import Contact, Plane, Sphere
from .scene import Scene, Softness
from .trajectory import Trajectory, of_one_body

MASS, RADIUS, GRAVITY, SLOPE, OFFSET = 1.5, 0.1, 9.81, 0.35, 0.2
SPEED, START = 0.3, np.array((0.3, -0.2, 0.0))
#: k²/a² about the axis, and about a diameter.
SHAPES = {"hoop": (1.0, 0.5), "disc": (0.5, 0.25), "sphere": (0.4, 0.4), "hollow sphere": (2 / 3, 2 / 3)}
#: Of the tangent of the slope at which a body begins to slip.
ROLLS, SLIPS = 0.95, 1.05
HOLDS = Softness(
    5e-6,
    "MuJoCo's contact holds back 0.9999 of what pushes it in a step: 3.5e-6 rad of 7.7 rad turned is the "
    "most measured, of a sphere at dt 16 ms, and 4.9e-8 of a hoop's at 1 ms",
    dt=1.6e-2,
    order=1,
)
SLIDES = Softness(
    1e-4,
    "where something slides MuJoCo's contact holds back 0.995 of what presses on it in a step, and the rest "
    "in the next: 7.2e-5 rad is the most measured, at dt 16 ms, and 2.5e-7 rad at 1 ms, as it lies deeper "
    "by 0.005 g dt²",
    dt=1.6e-2,
    order=2,
)


def axes(scene: Scene) -> tuple[Array, Array, Array]:
    """Out of the incline, down it, and along the axis about which a body then rolls, (3,) each."""
    plane = scene.contacts[0].against
    if not isinstance(plane, Plane):
        raise InputError(f"contact of {scene.full_name}: got {plane}, expected an incline")
    normal = np.array(plane.normal)
    down = np.array(scene.gravity) - (np.array(scene.gravity) @ normal) * normal
    down /= np.linalg.norm(down)
    return normal, down, np.cross(normal, down)


def _kappa(scene: Scene) -> float:
    return float(scene.bodies[0].inertia_array[2, 2] / (scene.bodies[0].mass * RADIUS**2))


def _rolled(scene: Scene, t: Array) -> rolling.Rolling:
    start = float(np.array(scene.v0[:3]) @ axes(scene)[1]), scene.v0[5]
    return rolling.down_an_incline(
        RADIUS, _kappa(scene), GRAVITY, SLOPE, scene.contacts[0].friction, t, *start
    )


def _motion(scene: Scene, t: Array, x: Array, angle: Array, v: Array, omega: Array) -> Trajectory:
    """The body's motion from its way down [m] and its turn about its axis [rad], (n,) each."""
    turned = quaternions.from_rotation_vector(np.outer(angle, [0.0, 0.0, 1.0]))
    q = quaternions.product(np.array(scene.q0[3:]), turned)
    _, down, _ = axes(scene)
    position = np.array(scene.q0[:3]) + np.outer(x, down)
    return of_one_body(t, position, q, np.outer(v, down), np.outer(omega, [0.0, 0.0, 1.0]))


def _truth(scene: Scene, t: Array) -> Trajectory:
    m = _rolled(scene, t)
    return _motion(scene, t, m.x, m.angle, m.v, m.omega)


def _scheme_motion(scene: Scene, twin: str, dt: float, t: Array) -> Trajectory | None:
    """Semi-implicit: velocities are exact, and places run ahead by dt/2 of the change of velocity."""
    if twin == "RKMK4":
        return None
    m = _rolled(scene, t)
    x, angle = m.x + (m.v - m.v[0]) * dt / 2, m.angle + (m.omega - m.omega[0]) * dt / 2
    return _motion(scene, t, x, angle, m.v, m.omega)


def _slope_of(t: Array, values: Array) -> float:
    centred = t - t.mean()
    return float(centred @ values / (centred @ centred))


def _acceleration(scene: Scene, motion: Trajectory) -> float:
    return _slope_of(motion.t, motion.velocity[:, 0] @ axes(scene)[1])


def _spinning_up(scene: Scene, motion: Trajectory) -> float:
    return _slope_of(motion.t, motion.omega[:, 0, 2])


def _exact_acceleration(scene: Scene) -> float:
    if scene.variant.startswith("slips"):
        return GRAVITY * float(np.sin(SLOPE) - scene.contacts[0].friction * np.cos(SLOPE))
    return rolling.rolling_acceleration(GRAVITY, SLOPE, _kappa(scene))


def _exact_spinning_up(scene: Scene) -> float:
    if scene.variant.startswith("slips"):
        return scene.contacts[0].friction * GRAVITY * float(np.cos(SLOPE)) / (_kappa(scene) * RADIUS)
    return _exact_acceleration(scene) / RADIUS


def _slip(scene: Scene, motion: Trajectory) -> Array:
    """Velocity of the point that touches (n, 3) [m/s]."""
    omega = quaternions.rotated(motion.quaternion[:, 0], motion.omega[:, 0])
    return np.asarray(motion.velocity[:, 0] - np.cross(omega, RADIUS * axes(scene)[0]))


def _height(scene: Scene, motion: Trajectory) -> Array:
    return np.asarray(motion.position[:, 0] @ axes(scene)[0])


def _speed(scene: Scene, motion: Trajectory) -> float:
    return float(np.abs(motion.velocity).max())


def _attitude(axis: Array) -> Array:
    """The body's third axis along ``axis`` (3,), turned about it by some angle."""
    half = np.array([*np.cross([0.0, 0.0, 1.0], axis), 1 + axis[2]])
    spun = quaternions.from_rotation_vector(np.array([0.0, 0.0, 0.7]))
    return quaternions.product(half / np.linalg.norm(half), spun)


def _incline(variant: str) -> Scene:
    slips, defaults = variant.startswith("slips"), variant == "defaults"
    shape = "hoop" if slips else "sphere" if defaults else variant
    kappa, across = SHAPES[shape]
    # Downhill is along x only where PyBullet's two directions of friction are to lie along the slip.
    heading = 0.0 if variant == "slips" else 0.6
    level = np.array([np.cos(heading), np.sin(heading), 0.0])
    normal = np.sin(SLOPE) * level + [0.0, 0.0, np.cos(SLOPE)]
    down = np.cos(SLOPE) * level - [0.0, 0.0, np.sin(SLOPE)]
    friction = float(np.tan(SLOPE) * kappa / (1 + kappa) / (SLIPS if slips else ROLLS))
    place = (OFFSET + RADIUS) * normal + START - (START @ normal) * normal
    plane = Plane((float(normal[0]), float(normal[1]), float(normal[2])), OFFSET)
    moments = MASS * RADIUS**2 * np.array([across, across, kappa])
    kept = (observables.invariant("slip", "m/s", _slip, _speed), observables.energy())
    return Scene(
        name="rolling",
        variant=variant,
        summary="What a user gets who sets nothing: a sphere that should roll, in contacts as they come."
        if defaults
        else f"A {shape} on an incline {'a little too' if slips else 'all but too'} steep to roll.",
        defaults=defaults,
        source="Goldstein, Classical Mechanics, ch. 2.4; Sommerfeld, Mechanics, ch. IV",
        bodies=(Body("wheel", MASS, diagonal(*moments), (Joint("free", "free"),)),),
        contacts=(Contact("wheel", Sphere(RADIUS), None, plane, friction=friction, slides=slips),),
        gravity=(0.0, 0.0, -GRAVITY),
        q0=(*place.tolist(), *_attitude(np.cross(normal, down)).tolist()),
        v0=(*(SPEED * down).tolist(), 0.0, 0.0, SPEED / RADIUS),
        duration=0.64,
        samples=20,
        truth=_truth,
        scheme_motion=_scheme_motion,
        soft={"mujoco": SLIDES if slips else HOLDS},
        observables=(
            observables.position(),
            observables.velocity(),
            observables.orientation(),
            observables.omega(),
            observables.fitted("acceleration", "m/s²", _acceleration, _exact_acceleration),
            observables.fitted("angular acceleration", "rad/s²", _spinning_up, _exact_spinning_up),
            *(() if slips else kept),
            observables.invariant("height", "m", _height, lambda scene, b: RADIUS),
            observables.unit_norm(),
        ),
        pictures=(
            pictures.against_time("Speed", "v [m/s]", lambda scene, m: m.velocity[:, 0] @ axes(scene)[1]),
        ),
        ladders={} if defaults else {1: (1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3)},
    )


SCENES = tuple(_incline(variant) for variant in (*SHAPES, "slips", "slips aslant", "defaults"))
