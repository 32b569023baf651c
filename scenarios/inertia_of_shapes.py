"""Solids of which an engine is told shape and density alone: it works out mass, centre and inertia itself.

Three copies of each twist to and fro on wires of their own, along two axes of the body and aslant; from how
fast, each moment follows to rounding. A box and a cylinder also tumble freely, in all schemes there are.
Catches what no other scene can, as those tell the engine the inertia: one that takes a solid for a shell,
leaves out its density, its place or its turn, or puts a box around it, even if it reads back what was asked.
"""

from dataclasses import replace

import numpy as np

from ..reference import quaternions, schemes
from ..reference.checked import Array
from . import free_body, hinged, observables, pictures
from .body import Body, Joint, Quaternion, Vector, of_solids
from .co2_chain import SCHEMES
from .observables import Observable
from .scene import Scene, every_scheme
from .solid import Solid
from .trajectory import Trajectory

#: The wires' axes in the body, and their stiffness [N m/rad]; angles [rad] and rates [rad/s] to begin with.
WIRES: dict[str, Vector] = {"e1": (1.0, 0.0, 0.0), "e3": (0.0, 0.0, 1.0), "aslant": (0.48, -0.6, 0.64)}
STIFFNESS = 3.0
ANGLES, RATES = (0.9, -0.6, 0.4), (1.5, 2.0, -3.0)
#: How the copies hang, and how solids are turned in their bodies.
HUNG: Quaternion = (0.1, 0.7, -0.1, 0.7)
TURNED: Quaternion = (0.48, -0.36, 0.0, 0.8)
#: A cube with a corner at its body's origin; atoms of a bent molecule, the first at the origin [m].
EDGE = 0.2
ATOMS: tuple[Vector, Vector] = ((0.25, 0.03, 0.0), (-0.08, 0.21, 0.11))
#: A cone as a mesh: how many sides, radius and height [m], where its tip is.
SIDES, RADIUS, HEIGHT, TIP = 12, 0.17, 0.4, (0.15, 0.2, -0.05)


def cone(sides: int, radius: float, height: float) -> Solid:
    """A cone as a mesh of triangles, tip at the origin, with its corners at ``radius`` [m]."""
    turns = 2 * np.pi * np.arange(sides) / sides
    around = [(radius * float(np.cos(a)), radius * float(np.sin(a)), height) for a in turns]
    sloping = [(k, sides, (k + 1) % sides) for k in range(sides)]
    flat = [(0, k, k + 1) for k in range(1, sides - 1)]
    return Solid("mesh", (), 900.0, TIP, TURNED, vertices=(*around, (0.0, 0.0, 0.0)), faces=(*sloping, *flat))


def moment(body: Body) -> float:
    """Moment about the body's hinge [kg m²]."""
    arm, axis = np.array(body.center_of_mass), np.array(body.joints[0].axis)
    across = quaternions.cross(axis, arm)
    return float(axis @ body.inertia_array @ axis + body.mass * (across @ across))


def _omegas(scene: Scene) -> Array:
    """Angular frequencies (b,) of the wires [rad/s]."""
    return np.asarray(np.sqrt([body.joints[0].stiffness / moment(body) for body in scene.bodies]))


def _twisting(scene: Scene, t: Array) -> Trajectory:
    omega, angle, rate = _omegas(scene), np.array(scene.q0), np.array(scene.v0)
    cos, sin = np.cos(np.outer(t, omega)), np.sin(np.outer(t, omega))
    return hinged.motion(scene.bodies, t, angle * cos + rate / omega * sin, rate * cos - angle * omega * sin)


def _of_scheme(scene: Scene, twin: str, dt: float, t: Array) -> Trajectory | None:
    if twin not in SCHEMES:
        return None
    inertia = np.diag([moment(body) for body in scene.bodies])
    wires = STIFFNESS * np.eye(len(scene.bodies))
    steps = np.rint(t / dt)
    moved = schemes.linear_motion(SCHEMES[twin], inertia, wires, scene.q0, scene.v0, dt, steps)
    return hinged.motion(scene.bodies, t, *moved)


def _measured(which: int, wire: str) -> Observable:
    """The moment about a wire [kg m²] that the frequency of the motion tells."""

    def signal(scene: Scene, motion: Trajectory) -> Array:
        speed = motion.joint_velocity[:, which] / _omegas(scene)[which]
        return np.asarray(motion.joint_position[:, which] - 1j * speed)

    frequency = observables.rate("", signal, lambda scene: float(_omegas(scene)[which]))

    def difference(scene: Scene, a: Trajectory, b: Trajectory) -> Array:
        omega = _omegas(scene)[which]
        measured = omega + frequency.difference(scene, a, b)
        return np.asarray(STIFFNESS / measured**2 - STIFFNESS / omega**2)

    def exact(scene: Scene) -> float:
        return moment(scene.bodies[which])

    return Observable(
        f"moment about {wire}", "kg m²", "rate", difference, lambda scene, b: exact(scene), exact
    )


def _twisted(variant: str, words: str, *solids: Solid) -> Scene:
    body = of_solids("", solids, (), quaternion=HUNG)
    bodies = tuple(
        replace(
            body,
            name=f"on {wire}",
            joints=(Joint(f"wire along {wire}", "hinge", axis, stiffness=STIFFNESS),),
            position=(float(number), 0.0, 0.0),
        )
        for number, (wire, axis) in enumerate(WIRES.items())
    )
    return Scene(
        name="inertia_of_shapes",
        variant=variant,
        summary=f"{words}, its inertia left to the engine, twists on wires along three axes.",
        source="Landau & Lifshitz, Mechanics, § 32; Goldstein, Classical Mechanics, ch. 5",
        bodies=bodies,
        q0=ANGLES,
        v0=RATES,
        duration=2.0,
        samples=50,
        truth=_twisting,
        # What single precision makes of the cone lies within a scheme's error, but not within its rounding.
        scheme_motion=None if variant in ERRORS else _of_scheme,
        errors=ERRORS.get(variant, {}),
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            *(_measured(which, wire) for which, wire in enumerate(WIRES)),
            observables.energy(),
            hinged.residual(),
            hinged.centre_residual(),
            observables.unit_norm(),
        ),
        pictures=tuple(_twist(which, wire) for which, wire in enumerate(WIRES)),
        dt=2e-3,
        # No coarser, though RK4 could be: of a body of several geoms MuJoCo finds the axes to 8e-15, and in a
        # hundred steps no more than that is granted to rounding.
        ladders=dict.fromkeys((1, 4), (8e-3, 4e-3, 2e-3, 1e-3, 5e-4)),
    )


def _twist(which: int, wire: str) -> pictures.Picture:
    return pictures.against_time(f"Twist on {wire}", "θ [rad]", lambda scene, m: m.joint_position[:, which])


def _tumbling() -> Scene:
    solids = {
        "box": Solid("box", (0.3, 0.2, 0.1), 700.0, (0.05, -0.11, 0.07)),
        "cylinder": Solid("cylinder", (0.12, 0.3), 500.0, (-0.04, 0.02, 0.06)),
    }
    return Scene(
        name="inertia_of_shapes",
        variant="tumbling",
        summary="A box and a cylinder, their inertia left to the engine, tumble freely.",
        source="Landau & Lifshitz, Mechanics, §§ 32 and 36; Goldstein, Classical Mechanics, ch. 5",
        bodies=tuple(
            of_solids(name, [solid], (Joint(f"{name} free", "free"),)) for name, solid in solids.items()
        ),
        q0=(0.0, 0.0, 0.0, *HUNG, 1.0, 0.2, -0.1, *TURNED),
        v0=(0.5, 0.2, -0.3, 1.5, 0.6, 4.0, -0.2, 0.4, 0.1, -2.0, 3.0, 1.0),
        duration=1.6,
        samples=100,
        truth=free_body.truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.velocity(),
            observables.energy(),
            observables.angular_momentum(),
            observables.unit_norm(),
        ),
        pictures=(pictures.tip("The box's third axis"), pictures.body_cone()),
        ladders={1: (8e-3, 4e-3, 2e-3, 1e-3, 5e-4), 4: (1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3)},
        errors=ERRORS["tumbling"],
    )


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0; of
#: the cone with Pinocchio 4.1.0 for RKMK4, whose errors are smaller than what single precision makes of it.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "cone": {
        "semi-implicit Euler": (3.0, 9.8, 0.13, 0.003, 0.011, 0.0073, 4.9, 0.0, 0.0, 0.0),
        "RKMK4": (53.0, 290.0, 2.2, 1.3, 1.3, 1.3, 11.0, 0.0, 0.0, 0.0),
        "discrete": (27.0, 130.0, 1.2, 0.016, 0.016, 0.016, 150.0, 0.0, 0.0, 0.0),
    },
    "tumbling": every_scheme(
        {
            "semi-implicit Euler": (3.3, 12.0, 0.0, 0.0, 0.6, 0.24, 0.0),
            "implicit gyroscopic": (2.6, 11.0, 0.0, 0.0, 0.57, 0.2, 0.0),
            "RKMK4": (1.2, 3.2, 0.0, 0.0, 0.043, 0.15, 0.0),
        },
        like="implicit gyroscopic",
    ),
}
# On one hinge nothing is gyroscopic: measured alike in all digits kept.
ERRORS["cone"] |= dict.fromkeys(
    ("implicit gyroscopic", "implicitfast"), ERRORS["cone"]["semi-implicit Euler"]
)

SCENES = (
    _twisted("sphere", "A solid sphere", Solid("sphere", (0.13,), 1200.0)),
    _twisted(
        "hollow sphere",
        "A sphere with a hollow",
        Solid("sphere", (0.15,), 1200.0),
        Solid("sphere", (0.1,), 1200.0, taken_away=True),
    ),
    _twisted("shell", "A spherical shell", Solid("shell", (0.15,), 20.0)),
    _twisted("box", "A box", Solid("box", (0.3, 0.2, 0.1), 700.0)),
    _twisted(
        "turned box", "A box turned in its body", Solid("box", (0.3, 0.2, 0.1), 700.0, quaternion=TURNED)
    ),
    _twisted("cylinder", "A cylinder", Solid("cylinder", (0.1, 0.3), 800.0)),
    _twisted("capsule", "A capsule", Solid("capsule", (0.1, 0.3), 500.0)),
    _twisted("ellipsoid", "An ellipsoid", Solid("ellipsoid", (0.1, 0.15, 0.25), 600.0, quaternion=TURNED)),
    _twisted("cone", "A cone of triangles", cone(SIDES, RADIUS, HEIGHT)),
    _twisted("corner", "A cube hung by a corner", Solid("box", (EDGE,) * 3, 750.0, (EDGE / 2,) * 3)),
    _twisted(
        "molecule",
        "A bent molecule of three balls",
        Solid("sphere", (0.12,), 1100.0),
        *(Solid("sphere", (0.07,), 900.0, place) for place in ATOMS),
    ),
    _tumbling(),
)
