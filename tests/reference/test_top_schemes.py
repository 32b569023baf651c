"""Body rates that a scheme gives a symmetric top, against the scheme run on Euler's equations."""

import mpmath
import numpy as np
import pytest
from poinsot.reference.errors import InputError
from poinsot.reference.top_schemes import body_rates, largest_stable_step


def acceleration(moments, w):
    """Euler's equations, from the torque −ω × Iω."""
    I1, I2, I3 = moments
    return np.array(
        [(I2 - I3) * w[1] * w[2] / I1, (I3 - I1) * w[2] * w[0] / I2, (I1 - I2) * w[0] * w[1] / I3]
    )


def stepped(scheme, I1, I3, omega0, dt, steps):
    """The nonlinear scheme at 30 digits."""
    with mpmath.workdps(30):
        moments = [mpmath.mpf(x) for x in (I1, I1, I3)]
        w, h = np.array([mpmath.mpf(x) for x in omega0]), mpmath.mpf(dt)

        def a(w):
            return acceleration(moments, w)

        for _ in range(steps):
            if scheme == "explicit":
                w = w + h * a(w)
            elif scheme == "rk4":
                k1 = a(w)
                k2 = a(w + h / 2 * k1)
                k3 = a(w + h / 2 * k2)
                w = w + h / 6 * (k1 + 2 * k2 + 2 * k3 + a(w + h * k3))
            else:
                # a is quadratic, so a symmetric difference of any size is its exact Jacobian.
                slopes = [(a(w + e) - a(w - e)) / 2 for e in np.eye(3, dtype=int)]
                jacobian = mpmath.matrix(3)
                for j, slope in enumerate(slopes):
                    for i in range(3):
                        jacobian[i, j] = slope[i]
                change = (mpmath.eye(3) - h * jacobian) ** -1 * mpmath.matrix(list(h * a(w)))
                w = w + np.array(list(change))
        return w.astype(float)


@pytest.mark.parametrize("scheme", ["explicit", "implicit", "rk4"])
@pytest.mark.parametrize(("I1", "I3"), [(0.01, 0.02), (0.03, 0.002), (0.7, 0.7)])
@pytest.mark.parametrize(("dt", "steps"), [(0.01, 50), (0.3, 20), (1e-9, 3)])
def test_rates_are_those_of_the_scheme_run_step_by_step(scheme, I1, I3, dt, steps):
    omega0 = [1.0, -0.4, 5.0]
    expected = stepped(scheme, I1, I3, omega0, dt, steps)
    got = body_rates(scheme, I1, I3, omega0, dt, [0, steps])
    np.testing.assert_allclose(got[0], omega0, rtol=0, atol=1e-16)
    np.testing.assert_allclose(got[1], expected, rtol=0, atol=4e-16 * np.abs(expected).max())


def test_gain_and_loss_per_step():
    I1, I3, omega3, dt = 0.01, 0.02, 5.0, 0.01
    z = omega3 * (I3 - I1) / I1 * dt
    steps = np.array([0, 1000])
    for scheme, power in (("explicit", 0.5), ("implicit", -0.5)):
        w = body_rates(scheme, I1, I3, [1.0, 0.0, omega3], dt, steps)
        assert np.hypot(*w[1, :2]) == pytest.approx((1 + z * z) ** (power * 1000), rel=1e-12, abs=0)


@pytest.mark.parametrize(("scheme", "order"), [("explicit", 1), ("implicit", 1), ("rk4", 4)])
def test_free_precession_is_approached_at_the_order(scheme, order):
    rate = 5.0 * (0.02 - 0.01) / 0.01
    truth = np.array([np.cos(rate), np.sin(rate), 5.0])
    errors = [
        np.abs(body_rates(scheme, 0.01, 0.02, [1.0, 0.0, 5.0], 1 / n, [n])[0] - truth).max()
        for n in (1000, 2000)
    ]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.05)


def test_measured_error_of_engines_with_explicit_and_implicit_gyroscopic_terms():
    # Free top (.01, .01, .02), ω = (1, 0, 5), 10 s at dt 1e-3: 1.33e-1 and 1.18e-1 were measured.
    truth = np.array([np.cos(50.0), np.sin(50.0), 5.0])
    for scheme, measured in (("explicit", 1.33e-1), ("implicit", 1.18e-1)):
        got = body_rates(scheme, 0.01, 0.02, [1.0, 0.0, 5.0], 1e-3, np.arange(10_001))
        t = 1e-3 * np.arange(10_001)
        path = np.column_stack([np.cos(5 * t), np.sin(5 * t), np.full(len(t), 5.0)])
        assert np.linalg.norm(got - path, axis=1).max() == pytest.approx(measured, rel=0.01, abs=0)
        assert got[-1, 2] == truth[2]


def test_refuses_what_is_no_top_or_no_step():
    good = {"scheme": "rk4", "I1": 1.0, "I3": 1.5, "omega0": [1.0, 0.0, 5.0], "dt": 0.1, "steps": [1]}
    bad = [("scheme", "euler"), ("I3", 2.5), ("I1", -1.0), ("omega0", [1.0, 2.0]), ("dt", 0.0)]
    for argument, value in [*bad, ("steps", [0.5]), ("steps", [-1])]:
        with pytest.raises(InputError):
            body_rates(**(good | {argument: value}))
    with pytest.raises(InputError, match="past the largest double"):
        body_rates("explicit", 1.0, 1.5, [1.0, 0.0, 5.0], 1.0, [10_000])


@pytest.mark.parametrize(("I1", "I3", "omega3"), [(0.01, 0.02, 5.0), (0.02, 1e-6, -300.0), (1.0, 1.5, 1e-3)])
def test_largest_stable_step_is_where_the_rates_begin_to_grow(I1, I3, omega3):
    limit = largest_stable_step("rk4", I1, I3, omega3)
    assert limit == pytest.approx(np.sqrt(8) * I1 / abs((I3 - I1) * omega3), rel=1e-14)
    sizes = [
        np.hypot(*body_rates("rk4", I1, I3, [1.0, 0.0, omega3], share * limit, [500])[0, :2])
        for share in (0.999, 1.001)
    ]
    assert sizes[0] < 1 < sizes[1]
    # At a thousandth of it, explicit Euler grows and the implicit scheme dies down.
    for scheme, grows, expected in (("explicit", True, 0.0), ("implicit", False, np.inf)):
        assert largest_stable_step(scheme, I1, I3, omega3) == expected
        after = body_rates(scheme, I1, I3, [1.0, 0.0, omega3], 1e-3 * limit, [500])[0, :2]
        assert (np.hypot(*after) > 1) == grows


def test_nothing_grows_in_a_body_without_precession():
    for scheme in ("explicit", "implicit", "rk4"):
        assert largest_stable_step(scheme, 1.0, 1.0, 5.0) == np.inf
        assert largest_stable_step(scheme, 1.0, 1.5, 0.0) == np.inf
    with pytest.raises(InputError, match="rk4"):
        largest_stable_step("euler", 1.0, 1.5, 1.0)
    with pytest.raises(InputError):
        largest_stable_step("rk4", 1.0, 2.5, 1.0)
