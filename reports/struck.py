"""Where a blow explains what a run does wrong: it has another force than asked, or acts at another time."""

from dataclasses import replace

import numpy as np

from ..reference.checked import Array
from ..scenarios.blows import Blow, at_work
from ..scenarios.forces import Constant
from .evidence import NOTHING, Evidence
from .fitting import size
from .intervals import Intervals, Places

#: Rounds of a secant, whose residual is a straight line but for terms of higher order in the step.
ROUNDS = 4
#: Shares of a blow that are one and the same.
ALIKE = 1e-6


def struck_otherwise(evidence: Evidence) -> str:
    """What a scene's only blow does wrong; empty if that does not explain every interval that is wrong.

    Elsewhere few wrong intervals are a sample told wrongly, or a jump.
    """
    blows = [force for force in evidence.scene.forces if isinstance(force, Blow)]
    if len(blows) != 1 or evidence.scheme == "exact":
        return ""
    cut = evidence.intervals
    if cut is None:
        return ""
    bad = np.flatnonzero(evidence.per_interval > NOTHING)
    if not 0 < len(bad) <= len(evidence.per_interval) // 4:
        return ""
    given = [_share(evidence, cut, blows[0], int(at)) for at in bad]
    return "" if None in given else _words(evidence, blows[0], bad, np.array(given, dtype=np.float64))


def _words(evidence: Evidence, blow: Blow, bad: Places, given: Array) -> str:
    t = evidence.told.t
    asked = np.array([bool(at_work([blow], between)) for between in (t[:-1] + t[1:]) / 2])
    if (
        set(bad.tolist()) == set(np.flatnonzero(asked).tolist())
        and np.ptp(given) < ALIKE * np.abs(given).max()
    ):
        return f"the blow on {blow.body!r} has {given[0]:.6g} times its force"
    at = int(bad[0])
    whole = "all" if asked[at] else "nothing"
    return (
        f"the blow on {blow.body!r} acts at another time: from t = {t[at]:g} s to {t[at + 1]:g} s it gives "
        f"{given[0]:.3g} of its force, where {whole} of it is asked"
    )


def _share(evidence: Evidence, cut: Intervals, blow: Blow, at: int) -> float | None:
    """The part of the blow that this interval shows; ``None`` if none explains it."""
    others = tuple(force for force in evidence.model.forces if force is not blow)
    before = float(evidence.per_interval[at])

    def left(share: float) -> Array:
        x, y, z = (share * np.array(blow.force)).tolist()
        model = replace(evidence.model, forces=(*others, Constant(blow.body, (x, y, z))))
        return cut.residual(model, evidence.scheme, np.array([at])).ravel()

    tried, last, share = left(0.0), 0.0, 1.0
    for _ in range(ROUNDS):
        now = left(share)
        slope = (now - tried) / (share - last)
        if size(now) <= NOTHING or not slope @ slope > 0:
            break
        tried, last, share = now, share, share - float(slope @ now) / float(slope @ slope)
        if share == last:
            break
    return share if evidence.explained(size(left(share)), before) else None
