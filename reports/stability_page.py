"""The page of a sweep: maps, measured limits against theory, and what happens past the limit."""

import math
import re
from collections import Counter
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from markupsafe import Markup

from . import templating
from .outcomes import LONGEST, Outcome
from .stability import TOLERANCE, between, bracket, deviation
from .stability_map import SIGNS, picture, sign
from .verdict import Status
from .wording import number

#: What engines do by default, which Poinsot's adapters switch off; tests/reports/test_outcomes.py sees it.
DEFAULTS = (
    (
        "mujoco 4.0.0",
        "autoreset on",
        Outcome.RESET,
        "Past the limit the state and the clock go back to zero, as soon as a coordinate, velocity or "
        "acceleration is over 1e10 or no number; the arrays are calm again.",
    ),
    (
        "pybullet 3.2.7",
        "maxJointVelocity 100",
        Outcome.CLAMPED,
        "Past the limit each joint velocity stays at ±100, finite and bounded for ever.",
    ),
)
#: What engines do where a step of 1e-3 s ends within 1e-12 rad of gimbal lock; the same tests see it.
IN_GIMBAL_LOCK = (
    ("mujoco 4.0.0", Outcome.ACCURATE, "It warns of a singular mass matrix, mjWARN_INERTIA, and goes on."),
    ("pybullet 3.2.7", Outcome.ACCURATE, "It goes on without a word."),
    ("pinocchio 4.1.0", Outcome.NOT_FINITE, "Its accelerations divide by zero, without a word of its own."),
)


def render(results: Mapping[str, Any], out: Path) -> None:
    """Write the page on ``results`` (the content of stability.json) to the file ``out``."""
    verdicts = results["verdicts"]
    text = _template().render(
        results=results,
        counts=Counter(Status(verdict["status"]) for verdict in verdicts),
        outcomes=[(outcome, sign(outcome)) for outcome in Outcome],
        engines=list(dict.fromkeys(found["engine"] for found in results["maps"])),
        limits=[_limits(found, verdicts) for found in results["maps"] if found["limits"]],
        past=[row for found in results["maps"] if (row := _past(found))],
        defaults=[(engine, setting, sign(outcome), said) for engine, setting, outcome, said in DEFAULTS],
        in_gimbal_lock=[(engine, sign(outcome), said) for engine, outcome, said in IN_GIMBAL_LOCK],
        picture=lambda found: picture(found, results["families"][found["family"]]),
        words=lambda found: _range([row["limit"] for row in found["theory"]]),
        tolerance=TOLERANCE,
        longest=LONGEST,
        accurate=SIGNS[Outcome.ACCURATE][1],
        not_passes=[verdict for verdict in verdicts if verdict["status"] != Status.PASS.value],
        Status=Status,
    )
    out.write_text(text, encoding="utf-8")


@cache
def _template() -> Any:
    return templating.environment().get_template("stability.html.j2")


def who(found: Mapping[str, Any]) -> str:
    """Engine with its version, and scheme."""
    return f"{found['engine']} {found['engine_version']}, {found['scheme']}"


def _limits(found: Mapping[str, Any], verdicts: list[dict[str, Any]]) -> tuple[str, ...]:
    """Family, scheme, theory in words, the limits measured, the worst deviation, and the verdicts.

    What the halving left open stands beside both: of limits that theory gives, the deviation is no better.
    """
    theory = {row["value"]: row["limit"] for row in found["theory"]}
    worst = max(_deviation(limit, theory[limit["value"]]) for limit in found["limits"])
    mine = [
        verdict["status"]
        for verdict in verdicts
        if (verdict["engine"], verdict["scheme"]) == (found["engine"], found["scheme"])
        and verdict["scene"].partition("[")[0] == found["family"]
    ]
    judged = ", ".join(f"{n} {status}" for status, n in Counter(mine).items())
    measured = _range([_between(limit) for limit in found["limits"]])
    left = max(bracket(limit["held"], _grew(limit)) for limit in found["limits"])
    open_by = f" ± {100 * left:.2g} %" if left else ""
    off = number(worst) + (f" ± {number(left)}" if left else "")
    return found["family"], who(found), _range(list(theory.values())), measured + open_by, off, judged


def _between(limit: Mapping[str, Any]) -> float | str:
    middle = between(limit["held"], _grew(limit))
    return "any" if math.isinf(middle) else middle


def _deviation(limit: Mapping[str, Any], theory: float | str) -> float:
    return deviation(limit["held"], _grew(limit), math.inf if theory == "any" else float(theory))


def _grew(limit: Mapping[str, Any]) -> float:
    return math.inf if limit["grew"] is None else float(limit["grew"])


def _range(limits: list[Any]) -> str:
    """Limits [s] in few words."""
    kinds = {"any": "holds at any step", 0.0: "grows at any step"}
    words = [text for limit, text in kinds.items() if limit in limits]
    steps = sorted(limit for limit in limits if limit is not None and limit not in kinds)
    if steps:
        last = f" … {steps[-1]:.4g} s" if steps[-1] > steps[0] else ""
        words.append(f"holds up to {steps[0]:.4g} s{last}")
    return "; ".join(words)


def _past(found: Mapping[str, Any]) -> tuple[str, str, list[tuple[Markup, Outcome, int]], str] | None:
    """Family, scheme, what becomes of runs past the limit and of how many, and what is said then."""
    theory = {row["value"]: row["limit"] for row in found["theory"]}
    past = [point for point in found["points"] if _is_past(point, theory[point["value"]])]
    if not past:
        return None
    counts = Counter(Outcome(point["outcome"]) for point in past)
    said = Counter(re.sub(r"\d[-+.\de]*", "…", point["said"]) for point in past if point["said"])
    shown = [(sign(outcome), outcome, n) for outcome, n in counts.most_common()]
    return found["family"], who(found), shown, "; ".join(text for text, _ in said.most_common(2))


def _is_past(point: Mapping[str, Any], limit: float | str | None) -> bool:
    """Whether a run's step is past theory's limit; where theory knows none, whether the run went wrong."""
    if limit is None:
        return Outcome(point["outcome"]) not in (Outcome.ACCURATE, Outcome.BOUNDED)
    return isinstance(limit, float | int) and float(point["dt"]) > limit * (1 + TOLERANCE)
