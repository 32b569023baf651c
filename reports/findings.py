"""A sentence for everything in a run that is not a pass; what is said of many places is said once."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from .deviations import KNOWN
from .digest import Column, Digest, Group, Record
from .verdict import Status
from .wording import number, steps

#: What an engine does is told before what was not looked at.
ORDER = (Status.ERROR, Status.FAIL, Status.FIXED, Status.KNOWN, Status.UNAVAILABLE, Status.UNSUPPORTED)


@dataclass(frozen=True)
class Finding:
    """A sentence, what it is about (check, observable, steps; may be empty) and where it is true.

    ``numbers`` says what was measured and allowed where it is worst; empty where there is no number.
    """

    status: Status
    sentence: str
    about: str
    groups: tuple[Group, ...]
    where: str
    numbers: str


def findings(digest: Digest) -> list[Finding]:
    """Everything that is not a pass, by status in ``ORDER``, then in the order of the matrix."""
    merged: dict[tuple[Status, str, str], list[tuple[Group, Record, float]]] = {}
    for group in digest.groups.values():
        for key, record, dt in _told(group):
            merged.setdefault(key, []).append((group, record, dt))
    return [
        _finding(digest, key, found)
        for key, found in sorted(merged.items(), key=lambda item: ORDER.index(item[0][0]))
    ]


def _finding(
    digest: Digest, key: tuple[Status, str, str], found: list[tuple[Group, Record, float]]
) -> Finding:
    status, about, sentence = key
    groups = list({id(group): group for group, _, _ in found}.values())
    _, worst, dt = max(found, key=lambda place: _excess(place[1]))
    numbers = _numbers(worst, dt)
    if not about and len(found) > 1 and numbers:
        about, numbers = _checks(found), f"{worst['check']} of {worst['observable']} {numbers}"
    return Finding(status, sentence, about, tuple(groups), _where(digest, groups), numbers)


def _checks(found: list[tuple[Group, Record, float]]) -> str:
    """The checks that a recorded reason speaks of: how many of each kind, over all that they are made on."""
    of: dict[str, set[tuple[str, str, str]]] = {}
    for group, record, _ in found:
        place = (group.scene, group.column.label, record["observable"])
        of.setdefault(record["check"], set()).add(place)
    kinds = ", ".join(f"{len(places)} of {check}" for check, places in of.items())
    return f"seen in {kinds}"


def _numbers(record: Record, dt: float) -> str:
    if record.get("measured") is None:
        return ""
    unit = f" {record['unit']}" if record["unit"] not in ("", "1") else ""
    measured, allowed = number(record["measured"]), number(record["allowed"])
    return f"at worst, {steps([dt])}: measured {measured}, allowed {allowed}{unit}"


def _not_passes(group: Group) -> Iterator[tuple[Status, str, Record, float]]:
    """Status, subject, the record that says so, and the step, of every cell and verdict."""
    for cell in group.cells:
        verdicts = [verdict for verdict in cell["verdicts"] if verdict["status"] != Status.PASS.value]
        for verdict in verdicts:
            about = f"{verdict['check']} of {verdict['observable']}"
            yield Status(verdict["status"]), about, verdict, cell["dt"]
        # A cell's status only repeats its verdicts', unless it says something or has none.
        if cell["status"] != Status.PASS.value and (cell["message"] or not verdicts):
            yield Status(cell["status"]), "", cell, cell["dt"]


def _told(group: Group) -> Iterator[tuple[tuple[Status, str, str], Record, float]]:
    """Status, subject and sentence, said by which record at which step.

    A check that was measured at many steps speaks once, where it is worst.
    """
    same: dict[tuple[Status, str, str], list[tuple[Record, float]]] = {}
    for status, about, record, dt in _not_passes(group):
        apart = "" if record.get("measured") is not None else record["message"]
        same.setdefault((status, about, apart), []).append((record, dt))
    for (status, about, _), found in same.items():
        worst, at = max(found, key=lambda place: _excess(place[0]))
        where = "" if len(found) == len(group.cells) else steps(dt for _, dt in found)
        subject = ", ".join(part for part in (about, where) if part)
        known, reason = worst["message"].rpartition(KNOWN)[1:]
        if status is Status.KNOWN and known:
            # One record of a deviation may speak of many checks: its reason is said once.
            yield (status, "", reason), worst, at
        else:
            yield (status, subject, worst["message"] or status.sentence), worst, at


def _excess(record: Record) -> float:
    """How far beyond its allowance a verdict is; records without numbers come last."""
    measured, allowed = record.get("measured"), record.get("allowed")
    return measured / allowed if measured is not None and allowed else -math.inf


def _where(digest: Digest, groups: list[Group]) -> str:
    """The places of ``groups`` in few words: whole engines and whole rows are named as such."""
    columns_of: dict[tuple[str, ...], list[Column]] = {}
    for column in digest.columns:
        scenes = tuple(group.scene for group in groups if group.column is column)
        if scenes:
            columns_of.setdefault(scenes, []).append(column)
    return "; ".join(
        f"{digest.named(columns)} on {_scenes(digest, scenes)}" for scenes, columns in columns_of.items()
    )


def _scenes(digest: Digest, scenes: tuple[str, ...]) -> str:
    missing = [scene for scene in digest.scenes if scene not in scenes]
    if len(scenes) > 1 and len(missing) <= min(3, len(scenes) - 1):
        return f"every scene but {', '.join(missing)}" if missing else "every scene"
    variants: dict[str, list[str]] = {}
    for scene in digest.scenes:
        variants.setdefault(scene.partition("[")[0], []).append(scene)
    whole = {name for name, every in variants.items() if len(every) > 1 and set(every) <= set(scenes)}
    bare = [scene.partition("[")[0] for scene in scenes]
    named = [
        f"{name} (every variant)" if name in whole else scene
        for name, scene in zip(bare, scenes, strict=True)
    ]
    return ", ".join(dict.fromkeys(named))
