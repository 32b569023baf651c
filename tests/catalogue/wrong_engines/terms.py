"""Terms of the equations of motion that are missing, doubled or of the wrong sign."""

from dataclasses import replace

import numpy as np
from poinsot.adapters.pinocchio_ import Pinocchio, pin

from .entry import (
    EQUATIONS,
    FREE,
    MOMENTUM,
    SE,
    SPIN,
    TUMBLING,
    TURNING,
    TWIN,
    Family,
    Lying,
    Sight,
    Wrong,
    alone,
)


def gyroscopic(times, of=slice(None)):
    """Gyroscopic, centrifugal and Coriolis terms multiplied by ``times``, in some of the velocities."""

    class Gyroscopic(Lying, Pinocchio):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            model, data, more = self._model, self._data, np.zeros(self._model.nv)
            more[of] = 1 - times

            def added(q, v):
                return more * (pin.nle(model, data, q, v) - pin.computeGeneralizedGravity(model, data, q))

            self._mechanism = replace(self._mechanism, force=added)

    return Gyroscopic


NoGyroscopicTerm = gyroscopic(0.0)
TERM = Family("gyroscopic term", lambda size: gyroscopic(1 + size), alone(TUMBLING, SE, EQUATIONS))
_SEEN = (alone(TUMBLING, SE, EQUATIONS, "truth omega", "invariant angular momentum"),)
_HINGED = (alone("double_pendulum[large]", SE, EQUATIONS, "truth omega", "invariant energy"),)
WRONG = (
    Wrong(
        "gyroscopic term is missing", "gyroscopic term", NoGyroscopicTerm,
        (
            Sight(
                FREE, SE, TURNING | SPIN | MOMENTUM | TWIN | {EQUATIONS},
                "truth Omega_b", "difference from the exact rate",
            ),
        ),
        located=r"gyroscopic term is missing",
    ),
    Wrong(
        "gyroscopic term is doubled", "gyroscopic term", gyroscopic(2.0), _SEEN,
        located=r"^gyroscopic term is doubled$",
    ),
    Wrong(
        "gyroscopic term has the wrong sign", "gyroscopic term", gyroscopic(-1.0), _SEEN,
        located=r"^gyroscopic term is of the wrong sign$",
    ),
    *TERM.sizes(
        "gyroscopic term", {1e-6: ("gyroscopic term is 1e-6 high", r"^gyroscopic term is 0\.0001 % high$")}
    ),
    Wrong(
        "Coriolis terms of hinges are missing", "Coriolis term", gyroscopic(0.0), _HINGED,
        located=r"Coriolis terms are missing$",
    ),
    Wrong(
        "Coriolis term of the lower hinge is missing", "Coriolis term", gyroscopic(0.0, of=1), _HINGED,
        located=r"^Coriolis term along joint 'lower hinge of first' is missing$",
    ),
)  # fmt: skip
