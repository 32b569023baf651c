"""What most likely is wrong where checks fail: one sentence, from the logs alone.

No engine is asked and no readback believed. Each hypothesis says what should be seen if it were true; the
one that leaves nothing over but rounding speaks. Where none does, the sentence says so.
"""

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from time import perf_counter

import numpy as np

from ..reference.checked import Array
from ..reference.errors import InputError, PoinsotError
from ..reference.tree_schemes import moved
from . import told_reactions
from .by_truth import in_truth
from .cell import Cell
from .centres import displaced_centres, elsewhere
from .common_causes import Localisation
from .evidence import IMPLICIT, MANY, NOTHING, Evidence, OutOfTimeError, inconsistency
from .fitting import Explanation, Residual, fitted, fitted_together, size
from .intervals import Intervals
from .plain_mistakes import alternatives
from .signs import plain, weaker
from .struck import struck_otherwise
from .supposed import Model
from .suspects import several, suspects
from .tellings import tellings
from .verdict import Ladder, Status, Verdict, ladder_of
from .wording import listed

NOT_FOUND = "not localised"
#: Time [s] after which no further ladder is looked into, as an engine wrong everywhere is wrong in one way,
#: and for which any one is.
LONGEST = 30.0
#: Rounds in which a velocity that its own acceleration depends on settles.
SETTLED = 20


def localised(cells: Sequence[Cell], verdicts: Iterable[Verdict]) -> list[Localisation]:
    """What most likely is wrong in each ladder of ``cells`` in which a check fails."""
    failed: dict[Ladder, list[Verdict]] = defaultdict(list)
    for verdict in verdicts:
        if verdict.status is Status.FAIL:
            failed[ladder_of(verdict)].append(verdict)
    ladders: dict[Ladder, list[Cell]] = defaultdict(list)
    for cell in cells:
        if ladder_of(cell.provenance) in failed and cell.trajectory.first_not_finite() is None:
            ladders[ladder_of(cell.provenance)].append(cell)
    since, result = perf_counter(), list[Localisation]()
    for ladder, mine in ladders.items():
        if perf_counter() - since > LONGEST:
            late = f"{NOT_FOUND}: not looked into, after {len(result)} others"
            result.append(Localisation(ladder, (late,), found=False))
            continue
        evidence = Evidence.of(mine, until=perf_counter() + LONGEST)
        causes: tuple[str, ...] = ()
        try:
            causes = _causes(evidence, failed[ladder])
            told = causes or (_nothing(evidence, failed[ladder]),)
        except OutOfTimeError:
            told = (f"{NOT_FOUND}: the search stopped after {LONGEST:g} s",)
        except (ArithmeticError, ValueError, PoinsotError) as error:
            # A report says what failed, whether or not it can say why.
            told = (f"{NOT_FOUND}: the search for a cause broke down ({error})",)
        result.append(Localisation(ladder, told, bool(causes)))
    return result


def _causes(evidence: Evidence, failed: Sequence[Verdict]) -> tuple[str, ...]:
    """Sentences that explain the runs of one ladder, of whose checks ``failed`` did; empty if none does."""
    if evidence.right:
        return _of_a_right_motion(evidence, failed)
    for look in _LOOKS:
        found = look(evidence)
        if found:
            return (found,) if isinstance(found, str) else found
    return ()


def _of_a_right_motion(evidence: Evidence, failed: Sequence[Verdict]) -> tuple[str, ...]:
    """The states follow from each other as they should: something else is wrong."""
    kinds = {verdict.check for verdict in failed}
    drift = float(np.abs(np.linalg.norm(evidence.told.quaternion, axis=-1) - 1).max())
    if drift > 1e-12:
        return (f"quaternion is not normalised: its length is off by up to {drift:.2g}",)
    if "acceleration" in kinds:
        return _at_states(evidence)
    if "determinism" in kinds:
        return ("not deterministic: the same cell gives other bits when it is run again",)
    reactions = told_reactions.cause(evidence.cell)
    if reactions:
        return (reactions,)
    if kinds == {"stability"} and evidence.scheme == evidence.declared:
        return _past_the_limit(evidence)
    if kinds == {"setup"}:
        names = listed(dict.fromkeys(v.observable for v in failed))
        return (f"only what is read back of {names} is wrong: the motion is as asked",)
    if evidence.scheme != evidence.declared:
        return (_SCHEMES[evidence.scheme].format(declared=evidence.declared),)
    return ()


def _past_the_limit(evidence: Evidence) -> tuple[str, ...]:
    """The motion is right at the steps logged: what can still shift the largest stable one."""
    found, theory = evidence.cell.provenance.stable_step, evidence.scene.stable_step
    limit = theory(evidence.scene, evidence.cell.provenance.twin) if theory else None
    if limit is None or not found or found[0] <= limit:
        return ()
    return ("velocities are clamped, or the state put back, once steps are past the stable one",)


def _telling(evidence: Evidence) -> str:
    if max(size(evidence.residual), evidence.inconsistent) <= NOTHING:
        return ""
    for words, undo in tellings(evidence.scene):
        cut, told = evidence.cut(undo), undo(evidence.told)
        if cut is None or len(cut.q) < 3 or inconsistency(cut, told) > NOTHING:
            continue
        if evidence.followed(cut) and evidence.begins(told):
            return words
    return _between_steps(evidence)


def _between_steps(evidence: Evidence) -> str:
    """Whether velocities are those of another moment than the positions told beside them."""
    cut = evidence.intervals
    before = size(evidence.residual[1:])
    if cut is None or evidence.scheme == "exact" or before <= NOTHING:
        return ""
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
        if evidence.followed(cut, stretch=stretch, steps=steps):
            return words
    clock = _clock(evidence, cut)
    if clock:
        return clock
    for scheme, words in _SCHEMES.items():
        affordable = scheme != IMPLICIT or len(evidence.scene.v0) <= MANY
        if scheme != evidence.scheme and affordable and evidence.followed(cut, scheme):
            return words.format(declared=evidence.declared)
    return ""


def _clock(evidence: Evidence, cut: Intervals) -> str:
    """Whether steps of a slightly other length explain every interval."""
    x, width, which = 0.0, 1e-6, np.arange(0, len(cut.q) - 1, 5)

    def residual(x: float) -> Array:
        evidence.in_time()
        return cut.residual(evidence.model, evidence.scheme, which, stretch=1 + x).ravel()

    for _ in range(4):
        now = residual(x)
        slope = (residual(x + width) - now) / width
        if not np.isfinite(slope).all() or not slope @ slope > 0:
            return ""
        x -= float(slope @ now) / float(slope @ slope)
        if not abs(x) < 0.5:
            return ""
    if not evidence.followed(cut, stretch=1 + x):
        return ""
    return f"step is {1 + x:.9g} times the stated one: time runs so much {'faster' if x > 0 else 'slower'}"


_SCHEMES = {
    "semi-implicit Euler": "steps are those of semi-implicit Euler, not of {declared}: order 1",
    "explicit Euler": "steps are those of explicit Euler, not of {declared}: order 1",
    # Before the next: where nothing turns the two are the same.
    "RKMK4": "steps are those of Runge and Kutta, not of {declared}",
    "RK4 of body velocities": "orientation is integrated to order 2 only: ω of a step's stages are added up "
    "as if their axes were the same",
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


def _at_states(evidence: Evidence) -> tuple[str, ...]:
    """What is wrong in the equations of motion, by accelerations, unless the motion speaks against it."""
    found = _fitted(evidence, evidence.fit_to_accelerations, evidence.plain)
    if not found or evidence.intervals is None or evidence.scheme == "exact":
        return _sentences(found)
    before = size(evidence.fit_to_motion(evidence.model))

    def agrees(one: Explanation) -> bool:
        return evidence.explained(size(evidence.fit_to_motion(one.change(evidence.model))), before)

    agreeing = [one for one in found if agrees(one)]
    if not agreeing and before <= NOTHING:
        return tuple(f"accelerations alone are as if {s}; the motion is right" for s in _sentences(found))
    return _sentences(agreeing)


def _in_motion(evidence: Evidence) -> tuple[str, ...]:
    """What is wrong in the equations of motion, by the motion."""
    return _sentences(_fitted(evidence, evidence.fit_to_motion, evidence.model))


def _sentences(found: Sequence[Explanation]) -> tuple[str, ...]:
    """One of each part: plain mistakes first, then round numbers, then as suspects are listed."""
    ordered = sorted(found, key=lambda e: (e.digits, e.place))
    return tuple({e.part: e.sentence for e in reversed(ordered)}.values())[::-1]


def _fitted(evidence: Evidence, residual: Residual, model: Model) -> list[Explanation]:
    """The mistakes that explain a residual equally well; none if it is nothing, or none does."""
    before = size(residual(model))
    if before <= NOTHING:
        return []
    simple = [
        Explanation(words, size(left), words, change=lambda m, make=make: make(m))  # type: ignore[misc]
        for words, make in alternatives(model)
        if (left := _left(residual, make(model))) is not None
    ]
    every = [*simple, *fitted(model, residual, list(suspects(model)))]
    if not any(evidence.explained(e.left, before) for e in every):
        groups = (fitted_together(model, residual, group) for group in several(model))
        every = [e for e in groups if e is not None]
    least = min((e.left for e in every), default=np.inf)
    return [e for e in every if evidence.explained(e.left, before) and e.left <= max(NOTHING, 3 * least)]


def _left(residual: Residual, model: Model) -> Array | None:
    try:
        return residual(model)
    except (InputError, np.linalg.LinAlgError):
        return None


def _nothing(evidence: Evidence, failed: Sequence[Verdict]) -> str:
    orders = [v.message for v in failed if v.check == "order" and v.measured is not None]
    if evidence.right:
        ruled = "every sample follows from the one before, by equations and scheme, to rounding"
    elif evidence.intervals is None:
        ruled = "no equations of motion of ours know this scene"
    else:
        ruled = "no one wrong parameter, telling of the state, step or scheme explains the motion"
    return f"{NOT_FOUND}: {ruled}{f'; {orders[0]}' if orders else ''}"


#: Where causes are looked for, the surest ways first; the first to find one speaks.
_LOOKS: tuple[Callable[[Evidence], str | tuple[str, ...]], ...] = (
    struck_otherwise,
    plain,
    displaced_centres,
    _at_states,
    _telling,
    elsewhere,
    _stepping,
    _in_motion,
    weaker,
    in_truth,
)
