"""The wobble of the pole: the 305 days, Euler's equations, and the smallness of the cone in space."""

import numpy as np
import pytest
from poinsot.reference.chandler import motion, pole_path, space_cone_angle, wobble_period, wobble_rate
from poinsot.reference.errors import InputError
from scipy.spatial.transform import Rotation

DAY = 86164.0
SPIN = 2 * np.pi / DAY
EPS = 1 / 305


def test_the_earth_wobbles_in_305_days():
    # Taylor, sect. 10.8 and Goldstein, sect. 5.6: about 300 days; Euler's 305.
    assert wobble_period(EPS, SPIN) / DAY == pytest.approx(305, rel=1e-14)
    assert wobble_rate(EPS, SPIN) == pytest.approx(SPIN / 305, rel=1e-14)
    assert wobble_rate(-0.1, 2.0) == -0.2
    assert wobble_period(-0.1, 2.0) == pytest.approx(10 * np.pi)


@pytest.mark.parametrize("turns", [1.0, 305.0, 3e5, -1000.25])
def test_the_pole_goes_round_a_circle_at_the_rate(turns):
    t = turns * DAY
    alpha, phase = 1e-6, 0.4
    got = pole_path(EPS, SPIN, alpha, t, phase)[0]
    angle = phase + wobble_rate(EPS, SPIN) * t
    # 1 + ε is rounded, and so is I3 − I1: 1e-16 of ω3 in the rate.
    np.testing.assert_allclose(
        got, np.tan(alpha) * np.array([np.cos(angle), np.sin(angle)]), atol=alpha * 1e-9
    )


@pytest.mark.parametrize(("eps", "spin", "alpha"), [(EPS, 1.0, 0.3), (-0.3, -2.0, 0.8), (1.0, 0.5, 1.2)])
def test_eulers_equations_and_the_cone_in_space(eps, spin, alpha):
    h = 1e-3
    q, w = motion(eps, spin, alpha, 2.0 + h * np.array([-2, -1, 0, 1, 2]), 0.7)
    rate = np.array([1, -8, 0, 8, -1]) / (12 * h) @ w
    moments = np.array([1, 1, 1 + eps])
    np.testing.assert_allclose(moments * rate, -np.cross(w[2], moments * w[2]), atol=1e-10)
    turns = Rotation.from_quat(q)
    L = turns.apply(moments * w)
    np.testing.assert_allclose(L, np.broadcast_to(L[0], L.shape), atol=1e-14)
    in_space = turns.apply(w)
    between = np.arccos(np.clip(in_space @ L[0] / np.linalg.norm(w, axis=1) / np.linalg.norm(L[0]), -1, 1))
    np.testing.assert_allclose(between, abs(space_cone_angle(eps, alpha)), atol=1e-8)
    assert np.sign(space_cone_angle(eps, alpha)) == np.sign(eps)


def test_the_start_is_the_one_asked_for():
    q, w = motion(EPS, 2.0, 0.3, 0.0, np.pi / 2)
    np.testing.assert_allclose(np.abs(q[0]), [0, 0, 0, 1], atol=1e-15)
    np.testing.assert_allclose(w[0], [0, 2 * np.tan(0.3), 2.0], atol=1e-15)


def test_in_space_the_axis_hardly_moves():
    assert space_cone_angle(EPS, 1e-6) == pytest.approx(1e-6 * EPS / (1 + EPS), rel=1e-9)
    assert space_cone_angle(0.5, 0.0) == 0
    assert space_cone_angle(0.5, np.pi / 4) == pytest.approx(np.pi / 4 - np.arctan(1 / 1.5), rel=1e-14)


@pytest.mark.parametrize(
    "call",
    [
        lambda: wobble_rate(1.1, 1.0),
        lambda: wobble_rate(-1.0, 1.0),
        lambda: wobble_period(0.0, 1.0),
        lambda: wobble_period(0.1, 0.0),
        lambda: space_cone_angle(0.1, 1.6),
        lambda: motion(0.1, 1.0, np.pi / 2, 1.0),
        lambda: motion(0.1, 1.0, -0.1, 1.0),
        lambda: motion(0.1, 0.0, 0.1, 1.0),
        lambda: pole_path(0.1, 1.0, 0.1, np.nan),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(InputError):
        call()
