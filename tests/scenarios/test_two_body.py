"""Two bodies: rates against the truth's own, and engines that let a force act wrongly."""

import numpy as np
import pytest
from poinsot.scenarios import two_body
from poinsot.scenarios.registry import scenes


@pytest.mark.parametrize("scene", two_body.SCENES, ids=lambda scene: scene.variant)
def test_the_rate_is_the_phase_of_the_truth_over_whole_rounds(scene, own_rate):
    name = "frequency" if scene.variant == "spring" else "mean motion"
    exact = next(o for o in scene.observables if o.name == name).scale(scene, None)
    t = np.array([0.0, 3 * 2 * np.pi / exact])
    motion = scene.truth(scene, t)
    apart = motion.position[:, 0] - motion.position[:, 1]
    # Three rounds end where they began, but for rounding.
    assert apart[1] == pytest.approx(apart[0], abs=1e-13)
    # A wobble of at most half a turn shifts the slope of n rounds by at most 12π/(2π n²) of the rate.
    assert abs(abs(own_rate(scene, name, 50 * 2 * np.pi / exact, 20001)) / exact - 1) < 6 / 50**2


@pytest.mark.parametrize("e", [0.1, 0.9])
def test_the_eccentricity_vector_is_as_long_as_the_eccentricity(e):
    scene = scenes()[f"two_body[kepler e={e}]"]
    (vector,) = (o for o in scene.observables if o.name == "eccentricity vector")
    motion = scene.truth(scene, scene.sample_times())
    assert vector.distance(scene, motion, motion).max() < 1e-13
    found = np.linalg.norm(two_body._eccentricity(scene, motion), axis=1)
    assert found == pytest.approx(e, abs=1e-13)


def _wrong(monkeypatch, push):
    """MuJoCo with other forces: ``push(mujoco, self, model, data, places, forces)`` hands them over."""
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Wrong(mujoco_.Forces):
        def _push(self, model, data):
            places = data.xipos[self._bodies]
            for forced in zip(self._bodies, places, self._total(places, self._velocity), strict=True):
                point, force = push(model, data, *forced)
                torque = np.zeros(3)
                self._mujoco.mj_applyFT(model, data, force, torque, point, forced[0], data.qfrc_passive)

    monkeypatch.setattr(mujoco_, "Forces", Wrong)
    return mujoco_.MuJoCo


def _right(model, data, body, place, force):
    return place, force


def _in_body_axes(model, data, body, place, force):
    return place, data.xmat[body].reshape(3, 3) @ force


def _beside(model, data, body, place, force):
    return place + 1e-6, force


def _on_one(model, data, body, place, force):
    return place, force * (body == 1)


@pytest.mark.parametrize(
    ("push", "seen"),
    [
        (_in_body_axes, ("truth", "position")),
        (_beside, ("invariant", "turning")),
        (_on_one, ("invariant", "momentum")),
    ],
)
@pytest.mark.parametrize("variant", ["spring", "kepler e=0.1"])
def test_a_force_that_acts_wrongly_is_seen(push, seen, variant, failed, monkeypatch):
    scene = scenes()[f"two_body[{variant}]"]
    assert seen in failed(_wrong(monkeypatch, push), scene)


def test_the_same_forces_acting_rightly_fail_nothing(failed, monkeypatch):
    assert not failed(_wrong(monkeypatch, _right), scenes()["two_body[spring]"])


def test_a_force_that_stands_still_over_a_step_is_not_of_fourth_order(failed, monkeypatch):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Frozen(mujoco_.MuJoCo):
        """Hands the forces over as ``xfrc_applied``, once a step."""

        def step(self, n):
            for _ in range(n):
                forces = self._forced.__self__
                state = self.state()
                self._data.xfrc_applied[self._bodies, :3] = forces._total(state.position, state.velocity)
                mujoco_.mujoco.mj_step(self._model, self._data)
                self._steps += 1

    assert ("order", "position") in failed(Frozen, scenes()["two_body[spring]"], "RKMK4")
