"""The path of L in the body: the right axes, Landau & Lifshitz's constants, Euler's equations."""

import numpy as np
import pytest
from poinsot.reference.polhode import direction, in_body_axes, is_point, polhode
from poinsot.reference.precise import mp

MOMENTS = np.array([1.0, 2.0, 2.5])
ORDERS = [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)]
STARTS = [
    [0.5, 0.7, 2.0],
    [-0.5, 0.7, -2.0],
    [2.0, 0.3, 0.4],
    [-2.0, -0.3, 0.4],
    [0.0, 0.4, 2.0],
    [2.0, 0.0, -0.1],
]


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("start", STARTS)
def test_the_circled_axis_is_that_of_dn_and_the_middle_one_that_of_sn(order, start):
    order = list(order)
    moments, omega = MOMENTS[order], np.array(start)[order]
    curve = polhode(moments, omega)
    beyond = np.sum(moments**2 * omega**2) - 2.0 * np.sum(moments * omega**2)
    assert [float(x) for x in curve.moments] == ([1.0, 2.0, 2.5] if beyond > 0 else [2.5, 2.0, 1.0])
    assert [moments[a] for a in curve.axes] == [float(x) for x in curve.moments]
    frame = np.zeros((3, 3))
    frame[[0, 1, 2], curve.axes] = curve.directions
    assert np.linalg.det(frame) == 1.0


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("start", STARTS)
def test_n_starts_as_L_and_follows_euler_s_equations(order, start):
    order = list(order)
    moments, omega = MOMENTS[order], np.array(start)[order]
    curve = polhode(moments, omega)
    L = moments * omega
    step = 1e-5
    n, _ = direction(curve, np.array([-step, 0.0, step]))
    assert np.all(n[2] > 0)
    assert n[0, 1] >= -1e-16
    n = in_body_axes(curve, n).T
    assert np.abs(n[1] - L / np.linalg.norm(L)).max() < 4e-16
    # dL/dt = L × ω; a central difference of step h is good to h².
    assert np.abs((n[2] - n[0]) / (2 * step) - np.cross(n[1], omega)).max() < 1e-9


@pytest.mark.parametrize("start", STARTS)
def test_the_constants_are_the_book_s(start):
    """Landau & Lifshitz § 37 in fifty digits, where nothing cancels much; 1, 2, 3 exchanged below 2E·I2."""
    I1, I2, I3 = (mp.mpf(x) for x in MOMENTS.tolist())
    w = [mp.mpf(x) for x in start]
    M2 = (I1 * w[0]) ** 2 + (I2 * w[1]) ** 2 + (I3 * w[2]) ** 2
    E2 = I1 * w[0] ** 2 + I2 * w[1] ** 2 + I3 * w[2] ** 2
    if M2 < E2 * I2:
        I1, I3 = I3, I1
    curve = polhode(MOMENTS, np.array(start))
    assert abs(curve.L**2 - M2) < 1e-45
    assert abs(2 * curve.T - E2) < 1e-45
    k2 = (I2 - I1) * (E2 * I3 - M2) / ((I3 - I2) * (M2 - E2 * I1))
    assert abs(curve.modulus.m - k2) < 1e-45
    assert abs(curve.modulus.m1 - (1 - k2)) < 1e-45
    assert abs(curve.rate**2 - (I3 - I2) * (M2 - E2 * I1) / (I1 * I2 * I3)) < 1e-45
    squares = [
        (E2 * I3 - M2) / (I1 * (I3 - I1)),
        (E2 * I3 - M2) / (I2 * (I3 - I2)),
        (M2 - E2 * I1) / (I3 * (I3 - I1)),
    ]
    for amplitude, moment, square in zip(curve.amplitudes, (I1, I2, I3), squares, strict=True):
        assert abs((amplitude * curve.L / moment) ** 2 - square) < 1e-45


def test_the_complement_of_the_modulus_is_exact_next_to_the_separatrix():
    """On 1, 2, 2.25 with ω1 : ω3 = 3 : 4 it is 0; an ulp of ω3 beside it, all its digits hold."""
    moments, last = np.array([1.0, 2.0, 2.25]), np.nextafter(4.0, 5.0)
    assert polhode(moments, np.array([3.0, 0.0, 4.0])).modulus.m1 == 0
    modulus = polhode(moments, np.array([3.0, 0.0, last])).modulus
    w3 = mp.mpf(last)
    beyond = mp.mpf(9) / 16 * (w3 - 4) * (w3 + 4)  # I3(I3 − I2)ω3² − I1(I2 − I1)ω1²
    expected = mp.mpf(5) / 4 * beyond / (mp.mpf(1) / 4 * (mp.mpf(45) / 16 * w3**2))
    assert abs(modulus.m1 / expected - 1) < 1e-45
    assert modulus.m1 < 1e-14


@pytest.mark.parametrize(
    ("moments", "omega", "still"),
    [
        ([1.0, 2.0, 2.5], [0.0, 3.0, 0.0], True),
        ([1.0, 2.0, 2.5], [0.0, 0.0, 0.0], True),
        ([1.0, 1.0, 1.0], [1.0, 2.0, 3.0], True),
        ([1.0, 2.0, 2.0], [0.0, 2.0, 3.0], True),
        ([2.0, 1.0, 2.0], [1.0, 0.0, 3.0], True),
        ([2.0, 2.0, 1.0], [1.0, 2.0, 0.0], True),
        ([1.0, 2.0, 2.0], [1e-300, 2.0, 3.0], False),
        ([1.0, 2.0, 2.5], [0.0, 3.0, 1e-300], False),
        ([1.0, 2.0, 2.5], [1e-300, 3.0, 0.0], False),
        ([1.0, 2.0, 2.5], [1e-300, 0.0, 3.0], False),
        ([1.0, 1.0, 1.0 + 2e-16], [1.0, 2.0, 3.0], False),
    ],
)
def test_a_polhode_is_a_point_where_omega_is_along_L(moments, omega, still):
    assert is_point(np.array(moments), np.array(omega)) is still
