"""Chains of beads: closed-form modes against the truth, and engines that treat a far bead otherwise."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reference import bead_chain
from poinsot.reference import normal_modes as by_eigenvalues
from poinsot.scenarios import normal_modes
from poinsot.scenarios.registry import scenes

CHAINS = [(4, "wall"), (16, "wall"), (64, "wall"), (16, "free"), (6, "ring")]


def chain(beads, ends):
    return scenes()[f"normal_modes[{beads}_{ends}]"]


@pytest.mark.parametrize(("beads", "ends"), CHAINS)
def test_shapes_and_frequencies_diagonalise_both_energies(beads, ends):
    T, V = bead_chain.energies(beads, normal_modes.MASS, normal_modes.STIFFNESS, ends)
    A = np.column_stack([normal_modes.shape(beads, ends, mode) for mode in range(beads)])
    omega, found = by_eigenvalues.normal_modes(T, V)
    np.testing.assert_allclose(A.T @ T @ A, np.eye(beads), rtol=0, atol=1e-13)
    np.testing.assert_allclose(A.T @ V @ A, np.diag(omega**2), rtol=0, atol=1e-11)
    # Modes of equal frequency may be any turn of each other: what counts is the plane that they span.
    same = np.isclose(omega[:, None], omega, rtol=1e-12, atol=1e-12)
    overlap = A.T @ T @ found
    np.testing.assert_allclose(overlap[~same], 0.0, rtol=0, atol=1e-12)
    np.testing.assert_allclose(overlap @ overlap.T, np.eye(beads), rtol=0, atol=1e-12)


@pytest.mark.parametrize(("beads", "ends"), CHAINS)
def test_the_truth_is_that_of_the_eigenvalue_equation(beads, ends):
    scene = chain(beads, ends)
    t, T_V = scene.sample_times(), bead_chain.energies(beads, 1.0, 100.0, ends)
    q, v = by_eigenvalues.motion(*T_V, np.cumsum(scene.q0), np.cumsum(scene.v0), t)
    motion, rest = scene.truth(scene, t), normal_modes.SPACING * np.arange(1, beads + 1)
    np.testing.assert_allclose(motion.position[:, :, 0] - rest, q, rtol=0, atol=1e-14)
    np.testing.assert_allclose(motion.velocity[:, :, 0], v, rtol=0, atol=1e-13)


@pytest.mark.parametrize(("beads", "ends"), CHAINS)
def test_the_phase_of_the_truth_turns_at_the_closed_form(beads, ends):
    scene = chain(beads, ends)
    t = scene.sample_times()
    motion = scene.truth(scene, t)
    held = replace(
        motion,
        **{
            name: np.broadcast_to(getattr(motion, name)[:1], getattr(motion, name).shape)
            for name in ("position", "velocity")
        },
    )
    rates = [observable for observable in scene.observables if observable.kind == "rate"]
    assert rates
    for rate in rates:
        slope = rate.difference(scene, motion, held)[0, 0]
        assert slope == pytest.approx(rate.scale(scene, motion), rel=1e-11)


def test_free_beads_drift_as_one():
    scene = chain(16, "free")
    t = scene.sample_times()
    middle = scene.truth(scene, t).position[:, :, 0].mean(axis=1)
    speed = normal_modes.AMPLITUDE / np.sqrt(16 * normal_modes.MASS)
    assert middle - middle[0] == pytest.approx(speed * t, abs=1e-15)


def test_the_chain_steps_as_semi_implicit_euler_by_hand():
    scene, dt = chain(16, "wall"), 1e-2
    x, v = np.cumsum(scene.q0), np.cumsum(scene.v0)
    for _ in range(5):
        pulled = normal_modes.STIFFNESS * np.diff(x, prepend=0.0)
        v = v + dt * (np.append(pulled[1:], 0.0) - pulled) / normal_modes.MASS
        x = x + dt * v
    found = scene.scheme_motion(scene, "semi-implicit Euler", dt, np.array([5 * dt]))
    rest = normal_modes.SPACING * np.arange(1, 17)
    assert found.position[0, :, 0] == pytest.approx(x + rest, abs=1e-14)
    assert found.velocity[0, :, 0] == pytest.approx(v, abs=1e-13)
    assert scene.scheme_motion(scene, "leapfrog", dt, np.array([0.0])) is None


def test_a_ring_is_stepped_as_semi_implicit_euler_by_hand_by_all_that_treat_no_force_implicitly():
    scene, dt = chain(6, "ring"), 1e-2
    x, v = np.cumsum(scene.q0), np.cumsum(scene.v0)
    for _ in range(5):
        v = v + dt * normal_modes.STIFFNESS * (np.roll(x, 1) - 2 * x + np.roll(x, -1)) / normal_modes.MASS
        x = x + dt * v
    for twin in ("semi-implicit Euler", "implicit gyroscopic", "discrete"):
        found = scene.scheme_motion(scene, twin, dt, np.array([5 * dt]))
        assert found.position[0, :, 0] - normal_modes.SPACING * np.arange(1, 7) == pytest.approx(x, abs=1e-14)


def test_an_engine_that_splits_a_pair_of_modes_is_seen_by_the_wave_that_no_longer_runs_round(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Split(mujoco_.MuJoCo):
        def build(self, scene, scheme, dt):
            first, *others = scene.forces
            weak = replace(first, stiffness=first.stiffness * (1 - 1e-6))
            super().build(replace(scene, forces=(weak, *others)), scheme, dt)

    seen = failed(Split, chain(6, "ring"))
    assert ("invariant", "momentum round the ring of modes 2 and 3") in seen
    assert not failed(mujoco_.MuJoCo, chain(6, "ring"))


def test_an_engine_whose_springs_slacken_down_the_chain_is_seen(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Slack(mujoco_.MuJoCo):
        def build(self, scene, scheme, dt):
            last = scene.bodies[-1]
            weak = replace(last.joints[0], stiffness=0.999 * last.joints[0].stiffness)
            bodies = (*scene.bodies[:-1], replace(last, joints=(weak,)))
            super().build(replace(scene, bodies=bodies), scheme, dt)

    seen = failed(Slack, chain(16, "wall"))
    assert {("truth", "position"), ("truth", "frequency of mode 1")} <= seen
    assert not failed(mujoco_.MuJoCo, chain(16, "wall"))
