"""Each law of growth is told from data that follow it, under oscillations and noise, and from no other."""

from collections import Counter

import numpy as np
import pytest
from poinsot.reference.errors import InputError
from poinsot.reports.drift import BOUNDED, EXPONENTIAL, LINEAR, RESTED, ROOT, Drift, drift

N, RUNS = 1600, 100
T = np.linspace(0.0, 1e4, N)
U = T / T[-1]


def bounded(rng):
    """An oscillation of some period, sampled too rarely to be seen as one, and noise."""
    period, phase = rng.uniform(0.1, 300), rng.uniform(0, 2 * np.pi)
    return 1e-6 * (np.sin(2 * np.pi * T / period + phase) - np.sin(phase) + 0.1 * rng.normal(size=N))


def walk(rng):
    return 1e-15 * np.cumsum(rng.normal(size=N))


def noisy_walk(rng):
    return walk(rng) + 2e-15 * rng.normal(size=N)


def linear(rng):
    return 1e-9 * U * rng.choice([-1, 1]) + 1e-10 * rng.normal(size=N)


def linear_below_a_swing(rng):
    """What is gained in all is twice what an oscillation swings by."""
    return bounded(rng) + 4e-6 * U


def line_and_walk(rng):
    return 1e-12 * U + walk(rng)


def exponential(rng):
    return 1e-6 * np.expm1(rng.uniform(3, 60) * U) * rng.choice([-1, 1]) + 1e-7 * rng.normal(size=N)


def settled(rng):
    """Lost at a rate that dies out, as an implicit scheme loses energy."""
    return -0.78 * -np.expm1(-rng.uniform(10, 100) * U) + 1e-4 * rng.normal(size=N)


LAWS = {
    bounded: BOUNDED, settled: RESTED, walk: ROOT, noisy_walk: ROOT, linear: LINEAR,
    linear_below_a_swing: LINEAR, line_and_walk: LINEAR, exponential: EXPONENTIAL,
}  # fmt: skip


@pytest.mark.parametrize("make", LAWS, ids=lambda make: make.__name__)
def test_each_law_is_told_from_its_data(make):
    found = Counter(drift(T, make(np.random.default_rng(seed))).law for seed in range(RUNS))
    assert found[LAWS[make]] >= 0.97 * RUNS, found


@pytest.mark.parametrize("scale", [1e-12, 1e12])
def test_units_change_no_law(scale):
    for make, law in LAWS.items():
        error = make(np.random.default_rng(1))
        assert drift(T * scale, error * scale).law == drift(T, error).law == law


def test_rates_are_those_that_went_in():
    rng = np.random.default_rng(0)
    assert drift(T, 3e-10 * T).rate == pytest.approx(3e-10)
    assert drift(T, -3e-10 * T).rate == pytest.approx(-3e-10)
    assert drift(T, np.expm1(2e-3 * T)).rate == pytest.approx(2e-3, rel=0.03)  # the grid's own grain
    assert drift(T, bounded(rng)).rate == 0.0
    walks = [drift(T, walk(np.random.default_rng(seed))).rate for seed in range(50)]
    assert np.median(walks) == pytest.approx(1e-15 / np.sqrt(T[1]), rel=0.1)


def test_no_error_at_all_is_bounded():
    assert drift(T, np.zeros(N)) == Drift(BOUNDED, 0.0, 0.0)


@pytest.mark.parametrize(
    ("t", "error"),
    [
        (T[:100], np.zeros(100)),
        (T**2, np.zeros(N)),
        (-T, np.zeros(N)),
        (T, np.zeros(N - 1)),
        (T, np.full(N, np.nan)),
        (T, np.append(np.zeros(N - 1), np.inf)),
    ],
)
def test_what_says_nothing_of_a_law_is_refused(t, error):
    with pytest.raises(InputError):
        drift(t, error)
