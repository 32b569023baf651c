"""Families of extreme scenes: each a scene at every value, its truth a motion, its theory a law."""

import numpy as np
import pytest
from poinsot.reference import normal_modes, schemes, top_schemes
from poinsot.reference.errors import InputError
from poinsot.scenarios import extreme_chains, extreme_damper, extreme_gimbal, extreme_tops, mechanics
from poinsot.scenarios.families import FAMILIES, select
from poinsot.scenarios.stiff_spring import on_spring
from scipy.integrate import solve_ivp

TWINS = ("semi-implicit Euler", "implicit gyroscopic", "RKMK4", "discrete", "implicitfast")
EVERY = pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)


@EVERY
def test_every_scene_is_called_by_its_family_and_value(family):
    names = [family.scene(value).full_name for value in family.values]
    assert len(set(names)) == len(names)
    assert all(name.startswith(f"{family.name}[") for name in names)
    steps = np.log(family.steps)
    # The map counts on steps that are even in their logarithm.
    np.testing.assert_allclose(np.diff(steps), np.diff(steps).mean(), rtol=0.02)


@EVERY
def test_truth_starts_as_the_scene_does_and_keeps_its_energy(family):
    for value in (family.values[0], family.values[-1]):
        scene = family.scene(value)
        motion = scene.truth(scene, np.linspace(0.0, scene.duration, 50))
        assert motion.first_not_finite() is None
        energy = mechanics.energy(scene, motion)
        if "damper" in scene.features:
            assert (np.diff(energy) < 0).all()
            continue
        # Near gimbal lock ω comes from hinge rates that are larger by the inverse distance.
        np.testing.assert_allclose(energy, energy[0], rtol=1e-9)


def test_mass_ratios_move_as_their_equations_say():
    for make in (extreme_chains.heavy_inside, extreme_chains.heavy_outside):
        scene = make(100.0)
        m1, m2 = (body.mass for body in scene.bodies)
        k = scene.joints[0].stiffness
        start = [*np.cumsum(scene.q0), *np.cumsum(scene.v0)]

        def rates(_, y, m1=m1, m2=m2, k=k):
            return [y[2], y[3], (-2 * k * y[0] + k * y[1]) / m1, (k * y[0] - k * y[1]) / m2]

        t = np.linspace(0.0, scene.duration, 20)
        found = solve_ivp(rates, (0.0, t[-1]), start, "DOP853", t, rtol=1e-12, atol=1e-14).y
        truth = scene.truth(scene, t)
        np.testing.assert_allclose(truth.position[:, :, 0] - [1.0, 2.0], found[:2].T, atol=1e-11)
        np.testing.assert_allclose(truth.velocity[:, :, 0], found[2:].T, atol=1e-9)


@pytest.mark.parametrize("ratio", [1.0, 1e4, 1e8])
def test_fastest_mode_of_a_chain_is_that_of_its_light_mass(ratio):
    k = extreme_chains.STIFFNESS
    for make, limit in ((extreme_chains.heavy_outside, 2 * k), (extreme_chains.heavy_inside, k)):
        scene = make(ratio)
        omega = 2 / scene.stable_step(scene, "semi-implicit Euler")
        exact, _ = normal_modes.normal_modes(
            np.diag([body.mass for body in scene.bodies]), k * np.array([[2.0, -1.0], [-1.0, 1.0]])
        )
        assert omega == pytest.approx(exact[-1], rel=1e-12)
        if ratio > 1:
            assert omega == pytest.approx(np.sqrt(limit), rel=1 / ratio)


@pytest.mark.parametrize("distance", [1e-1, 1e-4, 1e-8, 1e-12])
def test_gimbal_passes_its_lock_at_the_distance(distance):
    scene = extreme_gimbal.near_gimbal_lock(distance)
    first, last = 0.0, scene.duration
    for _ in range(6):  # ever more closely around where e3 is nearest to the vertical
        t = np.linspace(first, last, 2001)
        angles = np.abs(scene.truth(scene, np.append(0.0, t)).joint_position[1:, 1])
        nearest = int(angles.argmin())
        first, last = t[max(0, nearest - 2)], t[min(2000, nearest + 2)]
    # The start is rounded to 1e-16 of its 0.5 rad, which is 1e-4 of the smallest distance.
    assert angles.min() == pytest.approx(distance, rel=1e-4)
    assert np.abs(scene.v0).max() < 10


def test_gimbal_turns_about_a_steady_axis():
    # Free of torque: ω across e3 of a symmetric body is steady in the body as well as in the room.
    scene = extreme_gimbal.near_gimbal_lock(1e-3)
    motion = scene.truth(scene, np.linspace(0.0, scene.duration, 30))
    momentum = mechanics.angular_momentum_world(scene, motion)
    np.testing.assert_allclose(momentum, np.tile(momentum[0], (30, 1)), atol=1e-15)


@pytest.mark.parametrize("moments_of", [extreme_tops.spin, lambda w: extreme_tops.inertia_ratio(0.1)])
def test_tops_begin_to_grow_where_theory_says(moments_of):
    scene = moments_of(100.0)
    I1, I3 = scene.bodies[0].inertia[0][0], scene.bodies[0].inertia[2][2]
    omega0 = scene.v0[3:]
    limit = scene.stable_step(scene, "RKMK4")
    for share, grows in ((0.999, False), (1.001, True)):
        rates = top_schemes.body_rates("rk4", I1, I3, omega0, share * limit, [2000])
        assert (np.hypot(*rates[0, :2]) > np.hypot(*omega0[:2])) == grows
    assert scene.stable_step(scene, "semi-implicit Euler") == 0
    assert scene.stable_step(scene, "implicit gyroscopic") == np.inf
    assert scene.stable_step(scene, "another") is None


def test_theory_of_the_spring_is_that_of_its_step_matrix():
    scene = on_spring(1e6)
    for twin, scheme in (("semi-implicit Euler", "semi_implicit_euler"), ("RKMK4", "rk4")):
        limit = scene.stable_step(scene, twin)
        for share, grows in ((0.999, False), (1.001, True)):
            q, _ = schemes.linear_motion(scheme, [[1.0]], [[1e6]], scene.q0, scene.v0, share * limit, [3000])
            assert (np.abs(q).max() > 1e4 * abs(scene.q0[0])) == grows


def test_damper_brings_to_rest_a_reach_from_the_start():
    scene = extreme_damper.stiff_damper(1e3)
    t = np.linspace(0.0, scene.duration, 400)
    truth = scene.truth(scene, t)
    speed = truth.velocity[:, 0, 0]
    np.testing.assert_allclose(
        np.gradient(truth.position[:, 0, 0], t)[1:-1], speed[1:-1], rtol=2e-3, atol=1e-9
    )
    np.testing.assert_allclose(np.log(speed / speed[0]), -1e3 * t, rtol=1e-12)
    assert truth.joint_position[-1, 0] == pytest.approx(extreme_damper.REACH / 2, rel=1e-12)
    assert scene.stable_step(scene, "implicit gyroscopic") == np.inf
    assert scene.stable_step(scene, "semi-implicit Euler") == 2e-3
    assert scene.stable_step(scene, "another") is None


def test_no_body_beyond_a_plate():
    extreme_tops.inertia_ratio(2.0)
    with pytest.raises(InputError, match="inertia"):
        extreme_tops.inertia_ratio(2.0 * (1 + 1e-6))


def test_near_the_separatrix_the_body_flips():
    scene = extreme_tops.near_separatrix(1e-10)
    spin = scene.truth(scene, scene.sample_times()).omega[:, 0, 0]
    assert spin[0] == pytest.approx(6.0)
    assert spin.min() < -5.9


def test_select():
    assert select([]) == list(FAMILIES)
    assert [family.name for family in select(["spin", "stiff_spring", "spin"])] == ["spin", "stiff_spring"]
    with pytest.raises(InputError, match="stiff_spring"):
        select(["stiff"])
