"""L and T of the centre and about it: which are constant, and a weight that acts beside the centre."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters.simulate import simulate
from poinsot.reference import orbit_and_spin as split
from poinsot.reference import quaternions
from poinsot.scenarios import mechanics, orbit_and_spin
from poinsot.scenarios.registry import scenes

FLYING, FALLING, ORBITING = (
    scenes()[f"orbit_and_spin[{variant}]"] for variant in ("flying", "falling", "orbiting")
)
PARTS = {
    "L_orbital": orbit_and_spin._orbital,
    "L_spin": orbit_and_spin._spin,
    "T_orbital": orbit_and_spin._energy_of_centre,
    "T_spin": orbit_and_spin._energy_about_it,
}


def exact(scene):
    return scene.truth(scene, scene.sample_times())


@pytest.mark.parametrize("scene", [FLYING, FALLING, ORBITING])
def test_the_parts_are_those_of_the_books_and_add_up(scene):
    motion, body = exact(scene), scene.bodies[0]
    arrays = (motion.position, motion.velocity, motion.quaternion, motion.omega)
    books = split.of_body(body.mass, body.inertia_array, *(array[:, 0] for array in arrays))._asdict()
    own = {name: part(scene, motion) for name, part in PARTS.items()}
    for name, values in own.items():
        assert values == pytest.approx(books[name], rel=1e-13)
    assert own["L_orbital"] + own["L_spin"] == pytest.approx(mechanics.angular_momentum_world(scene, motion))
    assert own["T_orbital"] + own["T_spin"] == pytest.approx(mechanics.kinetic_energy(scene, motion))


@pytest.mark.parametrize(
    ("scene", "constant"),
    [
        (FLYING, set(PARTS)),
        (FALLING, {"L_spin", "T_spin"}),
        (ORBITING, {"L_orbital", "L_spin", "T_spin"}),
    ],
    ids=["flying", "falling", "orbiting"],
)
def test_which_parts_are_constant(scene, constant):
    motion = exact(scene)
    for name, part in PARTS.items():
        values = part(scene, motion)
        moved = np.abs(values - values[0]).max() / np.abs(values).max()
        assert (moved < 1e-13) if name in constant else (moved > 0.1), name


def test_the_centre_falls_as_the_torque_of_the_weight_says():
    motion, h = FALLING.truth(FALLING, np.linspace(0.0, 1.6, 1601)), 1e-3
    torque = np.cross(motion.position[:, 0], orbit_and_spin.MASS * np.array(FALLING.gravity))
    L = orbit_and_spin._orbital(FALLING, motion)
    # L is quadratic in t: central differences are exact.
    assert (L[2:] - L[:-2]) / (2 * h) == pytest.approx(torque[1:-1], abs=1e-10)
    assert orbit_and_spin._fall(FALLING, motion) == pytest.approx(-9.81, rel=1e-12)


def test_the_rate_is_that_of_the_ellipse():
    (circling,) = (o for o in ORBITING.observables if o.name == "circling")
    motion = ORBITING.truth(ORBITING, np.array([0.0, 5 * 2 * np.pi / circling.scale(ORBITING, None)]))
    assert motion.position[1] == pytest.approx(motion.position[0], rel=1e-13)
    assert motion.velocity[1] == pytest.approx(motion.velocity[0], rel=1e-13)


def test_an_engine_whose_weight_acts_beside_the_centre_of_mass(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Beside(mujoco_.MuJoCo):
        """The weight pulls at a point 0.1 mm from the centre of mass."""

        def step(self, n):
            weight = self._scene.bodies[0].mass * np.array(self._scene.gravity)
            for _ in range(n):
                turn = np.roll(self._data.qpos[3:7], -1)
                moment = np.cross([1e-4, 0.0, 0.0], quaternions.rotated(quaternions.conjugate(turn), weight))
                self._data.qfrc_applied[3:] = moment
                super().step(1)

    found = failed(Beside, FALLING)
    assert {("invariant", "L about the centre"), ("truth", "orientation, limit")} <= found
    assert not {("truth", "position"), ("truth", "velocity"), ("truth", "fall")} & found
    assert not failed(Beside, FLYING, duration=0.4)


def test_an_engine_that_pulls_beside_the_centre_of_mass_keeps_l_as_a_whole(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Beside(mujoco_.MuJoCo):
        """Has the centre of mass a little off the point that the springs hold."""

        def build(self, scene, scheme, dt):
            bodies = (replace(scene.bodies[0], center_of_mass=(5e-3, 0.0, 0.0)),)
            super().build(replace(scene, bodies=bodies), scheme, dt)

    found = failed(Beside, ORBITING)
    assert {("invariant", f"{part} centre") for part in ("L of the", "L about the", "T about the")} <= found
    rk4 = next(scheme for scheme in Beside.schemes if scheme.name == "RK4")
    motion = simulate(ORBITING, Beside, rk4, 1e-3)[0]
    whole = mechanics.angular_momentum_world(ORBITING, motion)
    assert np.abs(whole - whole[0]).max() < 1e-8
    assert np.ptp(PARTS["L_spin"](ORBITING, motion), axis=0).max() > 1e-3
