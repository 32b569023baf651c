"""The double pendulum: frequencies at no amplitude, and an engine whose links are deaf to velocities."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.scenarios import double_pendulum
from poinsot.scenarios.registry import scenes

SMALL, LARGE = (scenes()[f"double_pendulum[{variant}]"] for variant in ("small", "large"))


def of_size(part):
    scene = replace(SMALL, q0=tuple(part * x for x in SMALL.q0), v0=tuple(part * x for x in SMALL.v0))
    return scene.truth(scene, scene.sample_times())


def test_its_frequencies_are_the_books():
    for name, factor in (("slow frequency", 2 - np.sqrt(2)), ("fast frequency", 2 + np.sqrt(2))):
        (observable,) = (o for o in SMALL.observables if o.name == name)
        expected = np.sqrt(factor * double_pendulum.G / double_pendulum.LENGTH)
        assert observable.scale(SMALL, None) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("mode", [0, 1])
def test_the_extrapolated_frequencies_of_the_truth_meet_them(mode):
    exact = np.sqrt((2 + (-np.sqrt(2), np.sqrt(2))[mode]) * double_pendulum.G / double_pendulum.LENGTH)
    whole, half = (double_pendulum.frequency(of_size(part), mode) / exact - 1 for part in (1.0, 0.5))
    # What is left goes as the fourth power of the amplitude, here 0.1 rad.
    assert abs(whole) < 1e-5
    assert whole / half == pytest.approx(16.0, rel=0.1)


def test_one_amplitude_alone_misses_them_by_its_square():
    slow = np.sqrt((2 - np.sqrt(2)) * double_pendulum.G / double_pendulum.LENGTH)
    off = [double_pendulum._fitted(of_size(1.0), which, 0) / slow - 1 for which in (0, 1)]
    assert off[0] < -1e-4
    assert off[1] / off[0] == pytest.approx(4.0, rel=0.02)


def test_an_engine_whose_links_do_not_feel_each_others_velocity(failed):
    pinocchio_ = pytest.importorskip("poinsot.adapters.pinocchio_")

    class Quiet(pinocchio_.Pinocchio):
        """Leaves out the forces that go as products of velocities."""

        def _described_to_schemes(self):
            mechanism, pin, data = super()._described_to_schemes(), pinocchio_.pin, self._model.createData()

            def force(q, v):
                swung = pin.nonLinearEffects(self._model, data, q, v)
                return mechanism.force(q, v) + swung - pin.computeGeneralizedGravity(self._model, data, q)

            return replace(mechanism, force=force)

    assert {("truth", "orientation, limit"), ("invariant", "energy")} <= failed(Quiet, LARGE)
    # The slow frequency, extrapolated to no amplitude, is right without them.
    found = failed(Quiet, SMALL)
    assert ("truth", "orientation") in found
    assert ("truth", "slow frequency") not in found
