"""What most likely is wrong where checks fail: one sentence, from the logs alone.

No engine is asked and no readback believed. Each hypothesis says what should be seen if it were true; the
one that leaves nothing over but rounding speaks. Where none does, the sentence says so.
"""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from ..reference.checked import Array
from ..reference.errors import InputError
from ..reference.tree_schemes import moved
from .cell import Cell
from .evidence import NOTHING, Evidence, inconsistency
from .fitting import Explanation, Residual, fitted, size
from .intervals import Intervals
from .signs import plain, weaker
from .supposed import Model
from .suspects import alternatives, suspects
from .tellings import tellings
from .verdict import Ladder, Status, Verdict, ladder_of
from .wording import listed

NOT_FOUND = "not localised"
#: Time [s] after which no further ladder is looked into: an engine wrong everywhere is wrong in one way.
LONGEST = 60.0
#: Rounds in which a velocity that its own acceleration depends on settles.
SETTLED = 20


@dataclass(frozen=True)
class Localisation:
    """What most likely is wrong with an engine's scheme in a scene; not ``found`` if nothing explains it."""

    ladder: Ladder
    sentence: str
    found: bool


def localised(cells: Sequence[Cell], verdicts: Iterable[Verdict]) -> list[Localisation]:
    """A sentence for each ladder of ``cells`` in which a check fails; nothing where none does."""
    failed: dict[Ladder, list[Verdict]] = defaultdict(list)
    for verdict in verdicts:
        if verdict.status is Status.FAIL:
            failed[ladder_of(verdict)].append(verdict)
    ladders: dict[Ladder, list[Cell]] = defaultdict(list)
    for cell in cells:
        if ladder_of(cell.provenance) in failed and cell.trajectory.first_not_finite() is None:
            ladders[ladder_of(cell.provenance)].append(cell)
    since, result = perf_counter(), []
    for ladder, mine in ladders.items():
        if perf_counter() - since > LONGEST:
            said = f"{NOT_FOUND}: not looked into, after {len(result)} others"
        else:
            said = sentence(mine, failed[ladder])
        result.append(Localisation(ladder, said, not said.startswith(NOT_FOUND)))
    return result


def sentence(cells: Sequence[Cell], failed: Sequence[Verdict]) -> str:
    """What most likely is wrong with the runs of one ladder, of whose checks ``failed`` did."""
    evidence = Evidence.of(cells)
    if evidence.right:
        return _of_a_right_motion(evidence, failed)
    for found in (plain, _telling, _stepping, _equations, weaker):
        said = found(evidence)
        if said:
            return said
    return _nothing(evidence, failed)


def _of_a_right_motion(evidence: Evidence, failed: Sequence[Verdict]) -> str:
    """The states follow from each other as they should: something else is wrong."""
    kinds = {verdict.check for verdict in failed}
    drift = float(np.abs(np.linalg.norm(evidence.told.quaternion, axis=-1) - 1).max())
    if drift > 1e-12:
        return f"quaternion is not normalised: its length is off by up to {drift:.2g}"
    if "acceleration" in kinds:
        said = _fitted(evidence, evidence.fit_to_accelerations, evidence.plain)
        what = f"as if {said}" if said else "in no way that is known here"
        return f"accelerations alone are wrong, {what}; the motion follows the scene's equations"
    if "determinism" in kinds:
        return "not deterministic: the same cell gives other bits when it is run again"
    if kinds == {"setup"}:
        names = listed(dict.fromkeys(v.observable for v in failed))
        return f"only what is read back of {names} is wrong; the motion is as asked"
    return (
        f"{NOT_FOUND}: every sample follows from the one before, by the scene's equations and the scheme, "
        "to rounding; look at the check"
    )


def _telling(evidence: Evidence) -> str:
    for words, undo in tellings(evidence.scene):
        cut = evidence.cut(undo)
        if cut is None or len(cut.q) < 3 or inconsistency(cut, undo(evidence.told)) > NOTHING:
            continue
        if size(evidence.of_intervals(cut)) <= NOTHING:
            return words
    return _between_steps(evidence)


def _between_steps(evidence: Evidence) -> str:
    """Whether velocities are those of another moment than the positions told beside them."""
    cut = evidence.intervals
    if cut is None or evidence.scheme == "exact":
        return ""
    before = size(evidence.residual[1:])
    for part, words in ((0.5, "half a step"), (1.0, "one step")):
        for way, told in ((1, "late"), (-1, "early")):
            left = size(evidence.of_intervals(_shifted(evidence, cut, way * part))[1:])
            if evidence.explained(left, before):
                return f"velocities are told {words} {told}"
    return ""


def _shifted(evidence: Evidence, cut: Intervals, late: float) -> Intervals:
    """``cut`` with velocities of its positions' moments, if those told are of ``late`` steps before."""
    accelerate, links, v = evidence.model.accelerate, evidence.model.links, cut.v
    for _ in range(SETTLED):
        q = moved(links, cut.q, -cut.dt * v) if late > 0 and evidence.scheme != "RKMK4" else cut.q
        v = cut.v + late * cut.dt * accelerate(q, v)
    return replace(cut, v=v)


def _stepping(evidence: Evidence) -> str:
    """Whether another scheme, or another step, explains every interval."""
    cut = evidence.intervals
    if cut is None or evidence.scheme == "exact" or size(evidence.residual) <= NOTHING:
        return ""
    for stretch, steps, words in _steps(cut.stride):
        if size(cut.residual(evidence.model, evidence.scheme, stretch=stretch, steps=steps)) <= NOTHING:
            return words
    for scheme, words in _SCHEMES.items():
        if scheme != evidence.scheme and size(cut.residual(evidence.model, scheme)) <= NOTHING:
            return words.format(declared=evidence.scheme)
    return ""


_SCHEMES = {
    "semi-implicit Euler": "steps are those of semi-implicit Euler, not of {declared}: order 1",
    "explicit Euler": "steps are those of explicit Euler, not of {declared}: order 1",
    "RK4 of body velocities": "orientation is integrated to order 2 only: ω of a step's stages are added up "
    "as if their axes were the same",
    "RKMK4": "steps are those of Runge and Kutta, not of {declared}",
    "implicit gyroscopic": "gyroscopic term is taken at the end of the step, not as {declared} does",
    "exact": "answers are the exact motion itself, not an integration by {declared}",
}


def _steps(stride: int) -> list[tuple[float, int, str]]:
    """Factor on dt, steps an interval, and what that means."""
    found = []
    for n, word in ((2, "twice"), (3, "three times"), (4, "four times"), (10, "ten times")):
        found.append((float(n), stride, f"step is {word} the stated one: time runs so much faster"))
        found.append((1 / n, stride, f"step is a part of the stated one, 1/{n}: time runs so much slower"))
        found.append(
            (1 / n, stride * n, f"step is a part of the stated one, 1/{n}, and {n} are taken for each")
        )
        if stride % n == 0:
            found.append((float(n), stride // n, f"step is {word} the stated one, and one is taken for {n}"))
    return found


def _equations(evidence: Evidence) -> str:
    """What is wrong in the equations of motion, by the accelerations logged and by the motion."""
    at_states, before = evidence.accelerations, 0.0
    if at_states is not None:
        before = size(evidence.fit_to_accelerations(evidence.plain))
    if before > NOTHING:
        said = _fitted(evidence, evidence.fit_to_accelerations, evidence.plain)
        if said:
            return said
    return _fitted(evidence, evidence.fit_to_motion, evidence.model) if evidence.intervals else ""


def _fitted(evidence: Evidence, residual: Residual, model: Model) -> str:
    """The mistake that explains a residual, or those that do so equally well; empty if none does."""
    before = size(residual(model))
    if before <= NOTHING:
        return ""
    plain = [
        Explanation(words, size(left), words)
        for words, other in alternatives(model)
        if (left := _left(residual, other)) is not None
    ]
    every = sorted([*plain, *fitted(model, residual, list(suspects(model)))], key=lambda e: e.left)
    if not every or not evidence.explained(every[0].left, before):
        return ""
    equal = [e for e in every if e.left <= max(NOTHING, 3 * every[0].left)]
    # Plain mistakes first, then as suspects are listed: what is likely before what is special.
    ordered = sorted(equal, key=lambda e: e.place)
    words = list({e.part: e.sentence for e in reversed(ordered)}.values())[::-1]
    return words[0] if len(words) == 1 else f"{_either(words)}, which these data cannot tell apart"


def _left(residual: Residual, model: Model) -> Array | None:
    try:
        return residual(model)
    except (InputError, np.linalg.LinAlgError):
        return None


def _either(words: Sequence[str]) -> str:
    shown = list(words[:3])
    return "either " + " or ".join(shown) + (f" or {len(words) - 3} others" if len(words) > 3 else "")


def _nothing(evidence: Evidence, failed: Sequence[Verdict]) -> str:
    orders = [v.message for v in failed if v.check == "order" and v.measured is not None]
    if evidence.intervals is None:
        ruled = "no equations of motion of ours know this scene"
    else:
        ruled = "no one wrong parameter, telling of the state, step or scheme explains the motion"
    return f"{NOT_FOUND}: {ruled}{f'; {orders[0]}' if orders else ''}"
