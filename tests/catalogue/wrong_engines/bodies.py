"""Bodies that are built wrong: masses, centres, moments and products of inertia."""

import numpy as np
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.adapters.pybullet_ import PyBullet
from poinsot.scenarios.body import diagonal

from .entry import (
    CHAIN,
    ENERGY,
    EQUATIONS,
    FREE,
    LIMITS,
    MOMENTUM,
    RK,
    SE,
    SPIN,
    TOP,
    TUMBLING,
    TURNING,
    TWIN,
    Family,
    Feigning,
    Lying,
    Sight,
    Wrong,
    alone,
    building,
    first_body,
)


def tensor(scene, change):
    """The scene with ``change`` of its first body's inertia (3, 3)."""
    inertia = change(scene.bodies[0].inertia_array.copy())
    return first_body(scene, inertia=tuple(tuple(row) for row in inertia.tolist()))


class LargeMoment(Pinocchio):
    def build(self, scene, scheme, dt):
        I1, I2, I3 = np.diag(scene.bodies[0].inertia_array)
        super().build(first_body(scene, inertia=diagonal(I1 * 1.001, I2, I3)), scheme, dt)


class LyingLargeMoment(Lying, LargeMoment):
    pass


def heavy(size, lie=Lying):
    """The first mass larger by a part of itself."""
    return building(lambda scene: first_body(scene, mass=scene.bodies[0].mass * (1 + size)), Pinocchio, lie)


def farther(size):
    """The centre of mass farther out by a part of its distance."""
    return building(
        lambda scene: first_body(
            scene, center_of_mass=tuple(x * (1 + size) for x in scene.bodies[0].center_of_mass)
        ),
        MuJoCo,
    )


def aside(distance):
    """The centre of mass beside the axis by this [m]."""

    def moved(scene):
        x, y, z = scene.bodies[0].center_of_mass
        return first_body(scene, center_of_mass=(x + distance, y, z))

    return building(moved, MuJoCo)


def entry(i, j, size, lie=Lying):
    """A moment larger by a part of itself, or a product larger by a part of I1."""

    def changed(inertia):
        larger = size * inertia[0, 0] if i != j else size * inertia[i, i]
        inertia[i, j] += larger
        if i != j:
            inertia[j, i] += larger
        return inertia

    return building(lambda scene: tensor(scene, changed), MuJoCo, lie)


def scaled(size):
    """The whole inertia larger by a part of itself: a body that nothing turns moves as before."""
    return building(lambda scene: tensor(scene, lambda inertia: inertia * (1 + size)), Pinocchio)


def _permuted(scene):
    return tensor(scene, lambda inertia: np.diag(np.roll(np.diag(inertia), -1)))


def _unturned(scene):
    return tensor(scene, lambda inertia: np.diag(np.linalg.eigvalsh(inertia)))


def _turned_back(inertia):
    moments, axes = np.linalg.eigh(inertia)
    turned = axes.T @ np.diag(moments) @ axes
    return (turned + turned.T) / 2


def _about_origin(scene):
    body = scene.bodies[0]
    arm = np.array(body.center_of_mass)
    return tensor(scene, lambda inertia: inertia + body.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm)))


LIMIT = "truth orientation, limit"
SIZES = {1e-2: "1e-2", 1e-4: "1e-4", 1e-6: "1e-6"}
#: The same in percent, as they are said.
PERCENT = {1e-2: "1", 1e-4: r"0\.01", 1e-6: r"0\.0001"}
TUMBLES = alone(TUMBLING, SE, EQUATIONS, LIMIT)
MASS = Family("mass", heavy, alone(CHAIN, SE, EQUATIONS, "truth position, scheme's own"))
FEIGNED_MASS = Family(
    "mass, in the run alone", lambda size: heavy(size, Feigning),
    alone(CHAIN, SE, "truth position, scheme's own"),
)  # fmt: skip
FARTHER = Family("distance of the centre of mass", farther, alone(TOP, SE, EQUATIONS, LIMIT))
ASIDE = Family("centre of mass beside the axis [m]", aside, alone(TOP, SE, EQUATIONS, LIMIT))
MOMENTS = [Family(f"moment I{i + 1}", lambda size, i=i: entry(i, i, size), TUMBLES) for i in range(3)]
PRODUCTS = [
    Family(f"product I{i + 1}{j + 1}, a part of I1", lambda size, i=i, j=j: entry(i, j, size), TUMBLES)
    for i, j in ((0, 1), (0, 2), (1, 2))
]
FEIGNED_MOMENT = Family(
    "moment I2, in the run alone", lambda size: entry(1, 1, size, Feigning), alone(TUMBLING, SE, LIMIT)
)
SCALED = Family("whole inertia", scaled, alone(TOP, SE, EQUATIONS, LIMIT))

WRONG = (
    Wrong(
        "moment I1 is 0.1 % high, and read back so", "moment", LargeMoment,
        (
            Sight(
                FREE, RK,
                TURNING | SPIN | ENERGY | MOMENTUM | TWIN | {"setup body/top/inertia", EQUATIONS},
                "setup body/top/inertia",
                r"the engine has \[\[0.01001, .*, the scene asks for \(\(0.01, ",
            ),
        ), 1e-3,
        located=r"^moment I1 of body 'top' is 0\.1 % high$",
    ),
    Wrong(
        "moment I1 is 0.1 % high", "moment", LyingLargeMoment,
        (
            Sight(
                FREE, RK, TURNING | SPIN | ENERGY | MOMENTUM | TWIN | {EQUATIONS},
                "truth Omega_b", "difference from the exact rate",
            ),
            Sight(
                FREE, SE, LIMITS | SPIN | TWIN | {EQUATIONS},
                "truth orientation, limit", "limit at dt = 0 from the truth", near={"truth omega"},
            ),
        ), 1e-3,
        located=r"^moment I1 of body 'top' is 0\.1 % high$",
    ),
    *MASS.sizes(
        "mass",
        {
            size: (f"first mass is {SIZES[size]} high", f"^mass of body 'left' is {percent} % high$")
            for size, percent in PERCENT.items()
        },
    ),
    *FEIGNED_MASS.sizes(
        "mass",
        {1e-6: ("first mass is 1e-6 high in the run alone", r"^mass of body 'left' is 0\.0001 % high$")},
    ),
    *FARTHER.sizes(
        "centre",
        {
            size: (
                f"centre of mass is {words} too far out",
                rf"^centre of mass of body 'top' is displaced by {0.05 * size:.3g} m along its axis 3$",
            )
            for size, words in SIZES.items()
        },
    ),
    *ASIDE.sizes(
        "centre",
        {
            size: (
                f"centre of mass is {size:.0e} m beside the axis".replace("e-0", "e-"),
                f"^centre of mass of body 'top' is displaced by {size:.3g} m along its axis 1$",
            )
            for size in (1e-3, 1e-5, 1e-7)
        },
    ),
    *(
        wrong
        for i, family in enumerate(MOMENTS, start=1)
        for wrong in family.sizes(
            "moment",
            {
                size: (
                    f"moment I{i} is {SIZES[size]} high",
                    f"^moment I{i} of body 'satellite' is {percent} % high$",
                )
                for size, percent in PERCENT.items()
            },
        )
    ),
    *(
        wrong
        for family, ij in zip(PRODUCTS, ("12", "13", "23"), strict=True)
        for wrong in family.sizes(
            "product",
            {
                size: (
                    f"product I{ij} is {words} of I1",
                    f"^product of inertia I{ij} of body 'satellite' is off by {120 * size:.3g} kg m²$",
                )
                for size, words in SIZES.items()
            },
        )
    ),
    *FEIGNED_MOMENT.sizes(
        "moment",
        {
            size: (
                f"moment I2 is {SIZES[size]} high in the run alone",
                f"^moment I2 of body 'satellite' is {PERCENT[size]} % high$",
            )
            for size in (1e-4, 1e-6)
        },
    ),
    *SCALED.sizes(
        "moment", {1e-6: ("all moments are 1e-6 high", r"inertia of body 'top' is 0\.0001 % high")}
    ),
    Wrong(
        "inertia axes are permuted", "inertia axes", building(_permuted, Pinocchio),
        (alone(TUMBLING, SE, EQUATIONS, "truth omega", "invariant angular momentum"),),
        located=r"^inertia axes of body 'satellite' are permuted$",
    ),
    Wrong(
        "inertia's rotation is lost", "inertia axes", building(_unturned, PyBullet),
        (alone("axis_theorems[rotated]", SE, EQUATIONS, "truth orientation", "invariant angular momentum"),),
        located=r"^rotation of the inertia of body 'whole' is lost$",
    ),
    Wrong(
        "inertia is turned the wrong way", "inertia axes",
        building(lambda scene: tensor(scene, _turned_back), MuJoCo),
        (alone("axis_theorems[rotated]", SE, EQUATIONS, "truth orientation", "invariant angular momentum"),),
        located=r"^rotation of the inertia of body 'whole' is the wrong way round$",
    ),
    Wrong(
        "inertia is about the pivot, not the centre", "inertia axes", building(_about_origin, Pinocchio),
        (alone(TOP, SE, EQUATIONS, "truth omega"),),
        located=r"^inertia of body 'top' is taken about its frame, not its centre of mass$",
    ),
)  # fmt: skip
