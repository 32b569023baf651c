"""The sleeping top: both sides of its threshold, its rates, an engine that takes a small tilt for none."""

import numpy as np
import pytest
from poinsot.scenarios import pivoted_top, sleeping_top
from poinsot.scenarios.registry import scenes

#: √(Mgl/I1) of the top [rad/s]; at a part p of the threshold spin the rates are this, times p ± √(p² − 1).
PENDULUM = np.sqrt(0.5 * 9.81 * 0.05 / 0.002)
FALLING, ASLEEP = ("0.9", "0.99"), ("1.01", "1.1")


def top(variant):
    return scenes()[f"sleeping_top[{variant}]"]


def tilts(variant, duration=20.0):
    scene = top(variant)
    return pivoted_top.tilt(scene, scene.truth(scene, np.linspace(0.0, duration, 20001)))


def test_the_threshold_lies_between_the_variants():
    assert [float(variant) for variant in (*FALLING, *ASLEEP)] == sorted([0.9, 0.99, 1.01, 1.1])
    for variant in (*FALLING, *ASLEEP):
        _, _, (I1, I3), _, _, omega = pivoted_top.arguments(top(variant))
        assert I3 * omega[2] == pytest.approx(float(variant) * 2 * I1 * PENDULUM, rel=1e-13)
    assert tilts("0.99").max() > 0.2 > 5 * tilts("1.01").max()


@pytest.mark.parametrize("variant", FALLING)
def test_a_falling_top_falls_as_fast_as_the_linear_theory_says(variant):
    scene, part = top(variant), float(variant)
    expected = PENDULUM * np.sqrt(1 - part**2)
    assert sleeping_top._growth_rate(scene) == pytest.approx(expected, rel=1e-12)
    found = sleeping_top._growth(scene, scene.truth(scene, scene.sample_times()))
    # Beyond the linear theory the square of the tilt counts, beside the little that is left of 1 − p².
    assert found == pytest.approx(expected, rel=sleeping_top.SMALL**2 / (1 - part**2))


@pytest.mark.parametrize("variant", ASLEEP)
def test_a_sleeping_top_circles_at_both_its_rates(own_rate, variant):
    scene, part = top(variant), float(variant)
    for name, sign in (("slow circling", -1), ("fast circling", 1)):
        expected = PENDULUM * (part + sign * np.sqrt(part**2 - 1))
        (observable,) = (o for o in scene.observables if o.name == name)
        assert observable.scale(scene, None) == pytest.approx(expected, rel=1e-12)
        # Two modes, parted by the linear theory, mix by the square of the tilt over what parts them.
        small = tilts(variant).max() ** 2 / (part**2 - 1)
        assert own_rate(scene, name, 20.0, 20001) == pytest.approx(expected, rel=small)


@pytest.mark.parametrize("variant", ASLEEP)
def test_a_sleeping_tops_largest_tilt_is_seen_in_the_run_and_is_the_turning_point(variant):
    scene = top(variant)
    seen = sleeping_top._largest_tilt(scene, scene.truth(scene, scene.sample_times()))
    assert tilts(variant).max() == pytest.approx(sleeping_top._lowest(scene), rel=1e-6)
    # Between samples 12.8 ms apart.
    assert seen == pytest.approx(sleeping_top._lowest(scene), rel=1e-2)


def test_an_engine_that_takes_a_small_tilt_for_none(failed):
    mujoco_ = pytest.importorskip("poinsot.adapters.mujoco_")

    class Balancing(mujoco_.MuJoCo):
        """Within 1° of the vertical the weight has no moment."""

        def step(self, n):
            weight, arm = self._scene.bodies[0].mass * 9.81, self._scene.bodies[0].center_of_mass[2]
            for _ in range(n):
                w, x, y, z = self._data.qpos
                down_in_body = -np.array([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)])
                moment = np.cross([0.0, 0.0, arm], weight * down_in_body)
                upright = down_in_body[2] < -np.cos(np.radians(1))
                self._data.qfrc_applied[:] = -moment if upright else 0.0
                super().step(1)

    found = failed(Balancing, top("0.9"))
    assert {("truth", "growth rate"), ("truth", "orientation"), ("order", "position")} <= found
    assert ("truth", "slow circling") in failed(Balancing, top("1.1"))
    assert not failed(Balancing, scenes()["regular_precession[slow]"])
