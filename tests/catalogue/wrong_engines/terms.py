"""Terms of the equations of motion that are missing, doubled or of the wrong sign."""

from dataclasses import replace

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
    Lying,
    Sight,
    Wrong,
)  # fmt: skip


def gyroscopic(times):
    """Gyroscopic and Coriolis terms multiplied by ``times``."""

    class Gyroscopic(Lying, Pinocchio):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            model, data, more = self._model, self._data, 1 - times

            def added(q, v):
                return more * (pin.nle(model, data, q, v) - pin.computeGeneralizedGravity(model, data, q))

            self._mechanism = replace(self._mechanism, force=added)

    return Gyroscopic


NoGyroscopicTerm = gyroscopic(0.0)
_SEEN = {EQUATIONS, "truth omega", "invariant angular momentum"}
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
        "gyroscopic term is doubled", "gyroscopic term", gyroscopic(2.0),
        (Sight(TUMBLING, SE, _SEEN, near=None, beside=False),),
        located=r"^gyroscopic term is doubled$",
    ),
    Wrong(
        "gyroscopic term has the wrong sign", "gyroscopic term", gyroscopic(-1.0),
        (Sight(TUMBLING, SE, _SEEN, near=None, beside=False),),
        located=r"^gyroscopic term is of the wrong sign$",
    ),
)  # fmt: skip
