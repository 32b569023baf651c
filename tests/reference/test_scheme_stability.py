"""What a step does to an oscillation, against the schemes themselves and the books' limits."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference.errors import InputError
from poinsot.reference.scheme_stability import (
    decay_factor,
    largest_decaying_step,
    largest_stable_step,
    step_factor,
)
from poinsot.reference.schemes import SCHEMES, linear_motion


@given(st.sampled_from(SCHEMES), st.floats(1e-3, 4), st.integers(1, 40))
def test_factor_is_an_eigenvalue_of_the_step(scheme, z, steps):
    # With ω = 1 the step matrix is what one step does to (1, 0) and (0, 1).
    columns = [linear_motion(scheme, [[1.0]], [[1.0]], [q], [v], z, [1]) for q, v in ((1.0, 0.0), (0.0, 1.0))]
    eigenvalues = np.linalg.eigvals(np.hstack([np.vstack([q, v]) for q, v in columns]))
    factor = step_factor(scheme, z)
    # Eigenvalues of a matrix near its double root (z = 2) are good to √eps.
    assert np.abs(eigenvalues - factor).min() < 1e-7
    assert abs(factor) == pytest.approx(np.abs(eigenvalues).max(), abs=1e-7)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_factor_runs_forward_and_approaches_the_truth(scheme):
    # Semi-implicit Euler's frequency is of second order: it is a shifted leapfrog.
    order = {"explicit_euler": 1, "implicit_euler": 1, "rk4": 4}.get(scheme, 2)
    z = 1e-2
    error = abs(step_factor(scheme, z) - np.exp(1j * z))
    assert step_factor(scheme, z).imag > 0
    # The local error, one order above the global one.
    assert 1e-3 * z ** (order + 1) < error < z ** (order + 1)


def test_growth_and_phase_laws_of_the_books():
    z = 0.7
    growth = {
        "explicit_euler": np.sqrt(1 + z**2),
        "implicit_euler": 1 / np.sqrt(1 + z**2),
        "implicit_midpoint": 1,
        "semi_implicit_euler": 1,
        "rk4": np.sqrt(1 - z**6 / 72 + z**8 / 576),
    }
    for scheme, expected in growth.items():
        assert abs(step_factor(scheme, z)) == pytest.approx(expected, rel=1e-15, abs=0)
    phase = {
        "explicit_euler": np.arctan(z),
        "implicit_euler": np.arctan(z),
        "implicit_midpoint": 2 * np.arctan(z / 2),
        "semi_implicit_euler": 2 * np.arcsin(z / 2),
    }
    for scheme, expected in phase.items():
        assert np.angle(step_factor(scheme, z)) == pytest.approx(expected, rel=1e-15, abs=0)


@pytest.mark.parametrize(
    ("scheme", "limit"),
    [
        ("semi_implicit_euler", 2.0),
        ("implicit_damping", 2.0),
        ("rk4", 2.8284271247461903),
        ("implicit_euler", np.inf),
        ("implicit_midpoint", np.inf),
        ("explicit_euler", 0.0),
    ],
)
def test_limits_are_where_growth_begins(scheme, limit):
    assert largest_stable_step(scheme, 1.0) == pytest.approx(limit, rel=1e-15, abs=0)
    assert largest_stable_step(scheme, 50.0) == pytest.approx(limit / 50, rel=1e-15, abs=0)
    if 0 < limit < np.inf:
        assert abs(step_factor(scheme, limit * (1 - 1e-6))) <= 1 + 1e-15
        assert abs(step_factor(scheme, limit * (1 + 1e-6))) > 1 + 1e-9
    elif limit == 0:
        assert abs(step_factor(scheme, 1e-3)) > 1
    else:
        assert abs(step_factor(scheme, 1e6)) <= 1 + 1e-15


def test_long_runs_stay_or_grow_as_the_limit_says():
    for scheme, limit in (("semi_implicit_euler", 2.0), ("rk4", 2 * np.sqrt(2))):
        for share, grows in ((0.999, False), (1.001, True)):
            q, _ = linear_motion(scheme, [[1.0]], [[1.0]], [1.0], [0.3], share * limit, [2000])
            assert (np.abs(q).max() > 1e2) == grows


def test_refuses_other_schemes_and_signs():
    for call in (step_factor, largest_stable_step):
        with pytest.raises(InputError, match="rk4"):
            call("leapfrog", 1.0)
        with pytest.raises(InputError):
            call("rk4", -1.0)
    with pytest.raises(InputError):
        largest_stable_step("rk4", 0.0)


@given(st.sampled_from(SCHEMES), st.floats(1e-3, 4))
def test_decay_is_what_a_damper_does_in_a_step(scheme, z):
    _, v = linear_motion(scheme, [[1.0]], [[0.0]], [0.3], [1.0], z, [1], damping=[[1.0]])
    assert decay_factor(scheme, z) == pytest.approx(v[0, 0], rel=1e-13, abs=1e-13)


@pytest.mark.parametrize(
    ("scheme", "limit"),
    [
        ("semi_implicit_euler", 2.0),
        ("explicit_euler", 2.0),
        ("rk4", 2.7852935634052816),
        ("implicit_damping", np.inf),
        ("implicit_euler", np.inf),
        ("implicit_midpoint", np.inf),
    ],
)
def test_decay_ends_where_growth_begins(scheme, limit):
    assert largest_decaying_step(scheme, 1.0) == pytest.approx(limit, rel=1e-15, abs=0)
    assert largest_decaying_step(scheme, 50.0) == pytest.approx(limit / 50, rel=1e-15, abs=0)
    if limit < np.inf:
        assert (
            abs(decay_factor(scheme, limit * (1 - 1e-9))) < 1 < abs(decay_factor(scheme, limit * (1 + 1e-9)))
        )
    else:
        assert abs(decay_factor(scheme, 1e9)) < 1


def test_decay_refuses_other_schemes_and_signs():
    for call in (decay_factor, largest_decaying_step):
        with pytest.raises(InputError, match="rk4"):
            call("leapfrog", 1.0)
        with pytest.raises(InputError):
            call("rk4", -1.0)
