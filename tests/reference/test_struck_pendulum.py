"""A struck pendulum in closed form: its equation of motion, and what is left where a blow is a moment's."""

import numpy as np
import pytest
import scipy.integrate
from poinsot.reference import compound_pendulum, struck_pendulum
from poinsot.reference.errors import InputError

MASS, ARM, MOMENT, G = 1.5, 0.28, 0.15, 9.81
CENTRE = compound_pendulum.equivalent_length(MASS, ARM, MOMENT)


@pytest.mark.parametrize(("distance", "force"), [(0.2, 30.0), (CENTRE, -12.0), (0.6, 400.0)])
def test_its_swing_solves_the_equation_of_motion(distance, force):
    t, window = np.linspace(0.0, 1.0, 201), (0.3, 0.34)
    angle, rate = struck_pendulum.swing(MASS, ARM, MOMENT, G, distance, force, *window, -0.35, 1.2, t)

    def rates(push):
        return lambda _, y: (
            y[1],
            float(struck_pendulum.acceleration(MASS, ARM, MOMENT, G, distance, push, y[0])),
        )

    state = (-0.35, 1.2)
    for begin, end, push in ((0.0, 0.3, 0.0), (0.3, 0.34, force), (0.34, 1.0, 0.0)):
        during = (t >= begin) & (t <= end)
        found = scipy.integrate.solve_ivp(
            rates(push), (begin, end), state, "DOP853", dense_output=True, rtol=1e-12, atol=1e-12
        ).sol
        assert angle[during] == pytest.approx(found(t[during])[0], abs=1e-9)
        assert rate[during] == pytest.approx(found(t[during])[1], abs=1e-8)
        state = found(end)


@pytest.mark.parametrize("distance", [0.1, CENTRE, 0.7])
def test_a_blow_of_a_moment_is_the_textbooks(distance):
    # What a blow of J = 1.2 N s leaves, and what the hinge gives of it: the shorter it lasts, the nearer.
    exact = compound_pendulum.struck(MASS, ARM, MOMENT, distance, 1.2)
    off = []
    for lasting in (1e-3, 5e-4):
        t = np.linspace(0.0, lasting, 101)
        swing = struck_pendulum.swing(MASS, ARM, MOMENT, G, distance, 1.2 / lasting, 0, lasting, 0, 0, t)
        borne = struck_pendulum.borne_of_blow(MASS, ARM, MOMENT, distance, 1.2 / lasting, swing[0])
        off.append((swing[1][-1] - exact[0], scipy.integrate.simpson(borne, x=t) - exact[1]))
    assert np.abs(off[0]).max() < 1e-2
    for (before, after), size in zip(np.array(off).T, exact, strict=True):
        assert abs(after) < abs(before) / 1.9 + 1e-14, size


def test_at_the_centre_of_percussion_the_hinge_bears_nothing_at_any_angle():
    angle = np.linspace(-3, 3, 7)
    assert struck_pendulum.borne_of_blow(MASS, ARM, MOMENT, CENTRE, 30.0, angle) == pytest.approx(
        0, abs=1e-13
    )
    above, below = (
        struck_pendulum.borne_of_blow(MASS, ARM, MOMENT, CENTRE * share, 30.0, 0.1) for share in (0.4, 1.5)
    )
    assert above < 0 < below


@pytest.mark.parametrize("window", [(0.3, 0.2), (-0.1, 0.2)])
def test_a_blow_that_ends_before_it_starts_is_refused(window):
    with pytest.raises(InputError, match="start, end: got"):
        struck_pendulum.swing(MASS, ARM, MOMENT, G, 0.3, 1.0, *window, 0.0, 0.0, [1.0])
