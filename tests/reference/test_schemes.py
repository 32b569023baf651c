"""A scheme's own solution against the scheme run step by step, in long arithmetic and in double."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference.errors import InputError
from poinsot.reference.normal_modes import motion
from poinsot.reference.schemes import SCHEMES, linear_motion, uniform_acceleration

T = np.array([[2.0, 0.3], [0.3, 0.5]])
V = np.array([[50.0, -20.0], [-20.0, 30.0]])
C = np.array([[0.3, 1.1], [-0.9, 0.2]])  # damped and gyroscopic
FORCE = np.array([0.7, -1.9])
Q0, V0 = np.array([0.3, -0.2]), np.array([1.0, 0.4])


def one_step(scheme, M, K, D, f, q, v, h):
    """The textbook step, written out; M, K, D, f, q, v are mpmath matrices."""

    def a(q, v):
        return M**-1 * (f - K * q - D * v)

    if scheme == "explicit_euler":
        return q + h * v, v + h * a(q, v)
    if scheme == "semi_implicit_euler":
        new = v + h * a(q, v)
        return q + h * new, new
    if scheme == "implicit_damping":
        # M (v' − v) = h (f − Kq − Dv')
        new = (M + h * D) ** -1 * (M * v + h * (f - K * q))
        return q + h * new, new
    if scheme == "implicit_euler":
        # v' = v + h a(q', v'), q' = q + h v'
        new = (M + h * D + h**2 * K) ** -1 * (M * v + h * (f - K * q))
        return q + h * new, new
    if scheme == "implicit_midpoint":
        # m the midpoint: v_m = v + h/2 a(q_m, v_m), q_m = q + h/2 v_m; the end is 2m − start.
        middle = (M + h / 2 * D + h**2 / 4 * K) ** -1 * (M * v + h / 2 * (f - K * q))
        return q + h * middle, 2 * middle - v
    k1, l1 = v, a(q, v)
    k2, l2 = v + h / 2 * l1, a(q + h / 2 * k1, v + h / 2 * l1)
    k3, l3 = v + h / 2 * l2, a(q + h / 2 * k2, v + h / 2 * l2)
    k4, l4 = v + h * l3, a(q + h * k3, v + h * l3)
    return q + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)


def stepped(scheme, dt, steps, M=T, K=V, D=C, f=FORCE, q0=Q0, v0=V0):
    with mpmath.workdps(40):
        M, K, D, f, q, v = (mpmath.matrix(np.asarray(x).tolist()) for x in (M, K, D, f, q0, v0))
        for _ in range(steps):
            q, v = one_step(scheme, M, K, D, f, q, v, mpmath.mpf(dt))
        return np.array([float(x) for x in q]), np.array([float(x) for x in v])


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize(("dt", "steps"), [(0.013, 1), (0.013, 37), (0.2, 12)])
def test_power_is_the_scheme_run_step_by_step(scheme, dt, steps):
    expected_q, expected_v = stepped(scheme, dt, steps)
    q, v = linear_motion(scheme, T, V, Q0, V0, dt, [0, steps], C, FORCE)
    np.testing.assert_array_equal([q[0], v[0]], [Q0, V0])
    # The answer's own rounding, on the scale of the state.
    size = np.abs([expected_q, expected_v]).max()
    np.testing.assert_allclose(q[1], expected_q, rtol=0, atol=4e-16 * size)
    np.testing.assert_allclose(v[1], expected_v, rtol=0, atol=4e-16 * size)


def exact_power(scheme, dt, steps, square, damping):
    """(q, v) of one oscillator after any number of steps, from (1, ½): a 2 × 2 power at 50 digits."""
    with mpmath.workdps(50):
        parts = [mpmath.matrix([[x]]) for x in (1, square, damping, 0)]
        columns = []
        for start in ((1, 0), (0, 1)):
            q, v = one_step(scheme, *parts, *(mpmath.matrix([[x]]) for x in start), mpmath.mpf(dt))
            columns.append([q[0], v[0]])
        q, v = mpmath.matrix(columns).T ** steps * mpmath.matrix([1, 0.5])
        return np.array([float(q), float(v)])


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize(
    ("dt", "steps"), [(1e-2, 1000), (1e-4, 100_000), (1e-5, 1_000_000), (1e-4, 10_000_000), (0.37, 50)]
)
@pytest.mark.parametrize("damping", [0.0, 0.07])
def test_powers_are_round_off_exact_over_ten_million_steps(scheme, dt, steps, damping):
    expected = exact_power(scheme, dt, steps, 23.4, damping)
    got = np.ravel(linear_motion(scheme, [[1.0]], [[23.4]], [1.0], [0.5], dt, [steps], [[damping]]))
    # Relative even where all but 1e-16 has decayed, or has grown to 1e15; 5 ωt·2⁻⁶⁴ is below it.
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-15 * np.abs(expected).max())


@pytest.mark.parametrize("scheme", SCHEMES)
def test_slow_step_of_a_stiff_chain(scheme):
    # Frequencies 1e-3 and 1e3: the fast one must not cost the slow one its digits.
    K = np.diag([1e-6, 1e6])
    q, _ = linear_motion(scheme, np.eye(2), K, [1.0, 1.0], [0.0, 0.0], 1e-4, [100_000])
    alone, _ = linear_motion(scheme, [[1.0]], [[1e-6]], [1.0], [0.0], 1e-4, [100_000])
    assert abs(q[0, 0] - alone[0, 0]) < 1e-15


ORDERS = dict.fromkeys(("semi_implicit_euler", "implicit_damping", "implicit_euler", "explicit_euler"), 1)
ORDERS |= {"implicit_midpoint": 2, "rk4": 4}


@pytest.mark.parametrize("scheme", SCHEMES)
def test_schemes_approach_the_truth_at_their_order(scheme):
    q_true, v_true = (x[0] for x in motion(T, V, Q0, V0, [1.0]))
    errors = []
    first = 256 if scheme == "rk4" else 4096
    for steps in (first, 2 * first):
        q, v = linear_motion(scheme, T, V, Q0, V0, 1.0 / steps, [steps])
        errors.append(max(np.abs(q[0] - q_true).max(), np.abs(v[0] - v_true).max()))
    # Next to the leading term of the error stands one smaller by some ωdt.
    assert np.log2(errors[0] / errors[1]) == pytest.approx(ORDERS[scheme], abs=0.02)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_uniform_acceleration_is_the_motion_without_springs(scheme):
    a, x0, v0, dt = np.array([1.3, -9.81]), np.array([0.2, 3.0]), np.array([4.0, -1.0]), 1e-3
    steps = [0, 1, 2, 7, 100_000]
    q, v = linear_motion(scheme, T, 0 * V, x0, v0, dt, steps, force=T @ a)
    x, u = uniform_acceleration(scheme, x0, v0, a, dt, steps)
    # T @ a is rounded to double.
    np.testing.assert_allclose(x, q, rtol=1e-15)
    np.testing.assert_allclose(u, v, rtol=2e-15)


def test_free_fall_is_off_by_half_a_step_of_the_end_speed():
    g, dt, steps = -9.81, 1e-3, np.array([0, 1, 1000, 100_000])
    t = dt * steps
    truth = 100 + 2 * t + g * t**2 / 2
    expected = {
        "semi_implicit_euler": g * dt * t / 2,
        "implicit_damping": g * dt * t / 2,
        "implicit_euler": g * dt * t / 2,
        "explicit_euler": -g * dt * t / 2,
        "implicit_midpoint": 0 * t,
        "rk4": 0 * t,
    }
    for scheme in SCHEMES:
        x, v = uniform_acceleration(scheme, [100.0], [2.0], [g], dt, steps)
        # One ulp of the height reached.
        np.testing.assert_allclose(
            x[:, 0] - truth, expected[scheme], rtol=0, atol=4e-16 * np.abs(truth).max()
        )
        np.testing.assert_allclose(v[:, 0], 2 + g * t, rtol=1e-15)


@given(st.sampled_from(SCHEMES), st.integers(0, 5000), st.integers(0, 5000))
def test_steps_compose(scheme, first, second):
    q, v = linear_motion(scheme, T, V, Q0, V0, 1e-3, [first, first + second])
    q2, v2 = linear_motion(scheme, T, V, q[0], v[0], 1e-3, [second])
    # The state between is rounded; ten seconds of explicit Euler magnify that by less than 10.
    size = np.abs([q, v]).max()
    np.testing.assert_allclose([q2[0], v2[0]], [q[1], v[1]], rtol=0, atol=2e-15 * size)


def test_semi_implicit_euler_keeps_its_own_energy_and_the_midpoint_rule_the_true_one():
    steps, dt = np.arange(0, 100_000, 997), 0.01
    q, v = linear_motion("semi_implicit_euler", T, V, Q0, V0, dt, steps)
    energy = np.einsum("ti,ij,tj->t", v, T, v) + np.einsum("ti,ij,tj->t", q, V, q)
    shadow = energy - dt * np.einsum("ti,ij,tj->t", v, V, q)
    np.testing.assert_allclose(shadow, shadow[0], rtol=1e-14)
    assert np.ptp(energy) > 1e-3 * energy[0]
    q, v = linear_motion("implicit_midpoint", T, V, Q0, V0, dt, steps)
    energy = np.einsum("ti,ij,tj->t", v, T, v) + np.einsum("ti,ij,tj->t", q, V, q)
    np.testing.assert_allclose(energy, energy[0], rtol=1e-14)


def test_growth_past_the_largest_double_is_refused():
    with pytest.raises(InputError, match="semi_implicit_euler grows past the largest double within 100000"):
        linear_motion("semi_implicit_euler", [[1.0]], [[1e6]], [1.0], [0.0], 0.01, [3, 100_000])


def test_step_without_a_solution_is_refused():
    with pytest.raises(InputError, match="no solution"):
        linear_motion("implicit_euler", [[1.0]], [[-4.0]], [1.0], [0.0], 0.5, [1])


GOOD = {"T": T, "V": V, "q0": Q0, "v0": V0, "dt": 0.1, "steps": [1], "damping": C, "force": FORCE}


@pytest.mark.parametrize(
    ("argument", "value"),
    [
        ("T", -T),
        ("T", np.eye(3)),
        ("V", [[1.0, 2.0], [0.0, 1.0]]),
        ("q0", [1.0]),
        ("v0", [1.0, np.inf]),
        ("dt", 0.0),
        ("dt", -0.1),
        ("dt", np.nan),
        ("steps", [[3]]),
        ("steps", [1.5]),
        ("steps", [-1]),
        ("steps", [2.0**54]),
        ("damping", np.eye(3)),
        ("damping", [[np.nan, 0], [0, 0]]),
        ("force", [1.0]),
    ],
)
def test_bad_arguments_are_refused(argument, value):
    with pytest.raises(InputError):
        linear_motion("rk4", **(GOOD | {argument: value}))


def test_bad_arguments_of_a_fall_are_refused():
    for arguments in (
        ([0.0], [0.0], [1.0, 2.0], 0.1, [1]),
        ([0.0], [0.0, 1.0], [1.0], 0.1, [1]),
        ([0.0], [0.0], [1.0], 0.0, [1]),
        ([0.0], [0.0], [1.0], 0.1, [0.5]),
    ):
        with pytest.raises(InputError):
            uniform_acceleration("rk4", *arguments)
    for call in (
        lambda s: uniform_acceleration(s, [0.0], [0.0], [1.0], 0.1, [1]),
        lambda s: linear_motion(s, **GOOD),
    ):
        with pytest.raises(InputError, match="semi_implicit_euler, implicit_damping"):
            call("euler")
