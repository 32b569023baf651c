"""Effective gravity and hanging pendulums: balances of forces in the room, limits, published figures."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference.errors import InputError
from poinsot.reference.plumb_line import effective_gravity, pendulum_on_a_planet, pendulum_on_a_turntable

EARTH = (9.82, 7.292115e-5, 6.371e6)


def test_the_figures_of_the_earth():
    # Taylor, sect. 9.6: 0.0017 rad at 45°, and g smaller by 0.3 % at the equator.
    assert effective_gravity(*EARTH, np.pi / 4).deflection == pytest.approx(0.0017, abs=5e-5)
    equator = effective_gravity(*EARTH, np.pi / 2)
    assert 1 - equator.radial / EARTH[0] == pytest.approx(0.003, abs=5e-4)
    assert equator.deflection == pytest.approx(0, abs=1e-18)


@pytest.mark.parametrize("colatitude", [0.0, 0.4, np.pi / 4, 1.2, 2.0, np.pi])
def test_effective_gravity_is_the_pull_and_the_centrifugal_force(colatitude):
    g0, Omega, R = 9.82, 6e-4, 6.371e6
    up = np.array([np.sin(colatitude), np.cos(colatitude)])  # away from the axis, along it
    total = -g0 * up + np.array([Omega**2 * R * np.sin(colatitude), 0])
    got = effective_gravity(g0, Omega, R, colatitude)
    to_equator = np.array([np.cos(colatitude), -np.sin(colatitude)]) * np.sign(np.pi / 2 - colatitude)
    assert got.radial == pytest.approx(-total @ up, rel=1e-14)
    assert got.tangential == pytest.approx(total @ to_equator, rel=1e-13, abs=1e-15)
    assert got.magnitude == pytest.approx(np.linalg.norm(total), rel=1e-15)
    assert np.tan(got.deflection) == pytest.approx(got.tangential / got.radial, rel=1e-14)


@given(
    st.floats(0, np.pi / 2),
    st.floats(0, 0.99),
    st.floats(1e-9, 0.4),
)
def test_a_pendulum_on_a_planet_is_pulled_towards_the_axis_as_fast_as_it_turns(colatitude, speed, length):
    g0, R = 9.82, 1.0
    Omega = speed * np.sqrt(g0 / (R + length))
    delta = pendulum_on_a_planet(g0, Omega, R, colatitude, length)
    s, c = np.sin(colatitude), np.cos(colatitude)
    string = np.array([-s, -c]) * np.cos(delta) + np.array([c, -s]) * np.sin(delta)  # pivot to bob
    rho = R * s + length * string[0]
    needed = np.array([-(Omega**2) * rho, 0]) - g0 * np.array([-s, -c])  # tension per mass
    # Across the string nothing is left: rounding of three numbers of order g.
    assert abs(needed[0] * string[1] - needed[1] * string[0]) < 1e-14 * g0
    assert needed @ string < 0
    mirrored = pendulum_on_a_planet(g0, Omega, R, np.pi - colatitude, length)
    assert mirrored == pytest.approx(delta, rel=1e-12, abs=1e-15)


def test_a_short_pendulum_shows_the_plumb_line_and_a_long_one_less():
    plumb = effective_gravity(*EARTH, 0.8).deflection
    assert pendulum_on_a_planet(*EARTH, 0.8, 0.0) == pytest.approx(plumb, rel=1e-15)
    # The bob is nearer the axis by L sinθ of R sinθ: less by L/R to first order.
    assert pendulum_on_a_planet(*EARTH, 0.8, 6371.0) == pytest.approx(plumb * (1 - 1e-3), rel=1e-5)


def test_tiny_deflections_keep_their_digits():
    # Ω²R sinθ cosθ/g0 with corrections of relative order 1e-16.
    assert pendulum_on_a_planet(10.0, 1e-12, 1e6, np.pi / 4, 1.0) == pytest.approx(
        1e-24 * (1e6 - 1) * 0.5 / 10, rel=1e-15
    )
    assert pendulum_on_a_turntable(10.0, 1e-100, 2.0, 1.0) == pytest.approx(2e-201, rel=1e-15)


@given(st.floats(0.01, 10), st.floats(1e-12, 5), st.floats(0.05, 5))
def test_a_pendulum_on_a_turntable_balances(Omega, distance, length):
    g = 9.81
    phi = pendulum_on_a_turntable(g, Omega, distance, length)
    assert 0 < phi < np.pi / 2
    pull = Omega**2 * (distance + length * np.sin(phi))
    assert g * np.sin(phi) == pytest.approx(pull * np.cos(phi), rel=1e-12, abs=1e-14)


def test_the_conical_pendulum():
    # cosφ = g/(Ω²L): 60° where Ω² = 2g/L; hanging straight at the threshold and below it.
    g, L = 9.81, 0.7
    assert pendulum_on_a_turntable(g, np.sqrt(2 * g / L), 0.0, L) == pytest.approx(np.pi / 3, rel=1e-15)
    assert pendulum_on_a_turntable(g, -np.sqrt(2 * g / L), 0.0, L) == pytest.approx(np.pi / 3, rel=1e-15)
    assert pendulum_on_a_turntable(g, 0.999 * np.sqrt(g / L), 0.0, L) == 0
    assert pendulum_on_a_turntable(1.0, 1.0, 0.0, 1.0) == 0
    tiny = 2.0**-40  # Ω²L = g(1 + 2δ + δ²): φ² = 4δ to first order
    assert pendulum_on_a_turntable(1.0, 1 + tiny, 0.0, 1.0) == pytest.approx(2 * np.sqrt(tiny), rel=1e-11)
    # A pivot next to the axis changes nothing far above the threshold.
    near = pendulum_on_a_turntable(g, np.sqrt(2 * g / L), 1e-13, L)
    assert near == pytest.approx(np.pi / 3, rel=1e-12)


@pytest.mark.parametrize(
    "call",
    [
        lambda: effective_gravity(0.0, 1e-4, 6e6, 1.0),
        lambda: effective_gravity(9.8, 1e-4, -6e6, 1.0),
        lambda: effective_gravity(9.8, 1e-4, 6e6, 3.2),
        lambda: effective_gravity(9.8, 2.0, 6e6, 1.0),
        lambda: pendulum_on_a_planet(9.8, 1e-4, 6e6, 1.0, -1.0),
        lambda: pendulum_on_a_planet(9.8, 1.0, 9.0, 1.0, 1.0),
        lambda: pendulum_on_a_planet(9.8, 0.1, 1.0, 1.0, 2.0),
        lambda: pendulum_on_a_turntable(9.8, 1.0, -1.0, 1.0),
        lambda: pendulum_on_a_turntable(9.8, 1.0, 1.0, 0.0),
        lambda: pendulum_on_a_turntable(9.8, np.inf, 1.0, 1.0),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()
