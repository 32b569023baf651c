"""Known deviations: what an engine is recorded to do wrong, how far, in which versions, and why."""

import tomllib
from collections import defaultdict
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, fields, replace
from fnmatch import fnmatchcase
from functools import cache
from importlib import resources
from typing import Any

from packaging.specifiers import InvalidSpecifier, SpecifierSet

from ..reference.errors import InputError
from .verdict import CHECKS, Ladder, Status, Verdict, ladder_of

FILE = "known_deviations.toml"
#: In a message, between what was found and the recorded reason for it.
KNOWN = "; known: "


@dataclass(frozen=True)
class Deviation:
    """One entry of ``adapters/known_deviations.toml``.

    ``scene``, ``scheme`` and ``observable`` may hold wildcards, ``[`` and ``]`` standing for
    themselves; ``versions`` is a range as in a requirement (">=3.2,<4"). It speaks of steps up to
    ``dt`` [s] and grants a measured value up to ``bound``, in the unit of the check.
    """

    scene: str
    engine: str
    scheme: str
    versions: str
    check: str
    observable: str
    bound: float
    reason: str
    dt: float = float("inf")

    def applies(self, verdict: Verdict) -> bool:
        """Whether this entry speaks of that check on that cell."""
        return (
            verdict.check == self.check
            and verdict.dt <= self.dt
            and _like(verdict.observable, self.observable)
            and self.speaks_of(*ladder_of(verdict))
        )

    def speaks_of(self, scene: str, engine: str, version: str, scheme: str) -> bool:
        """Whether this entry speaks of that scheme in that scene."""
        return (
            engine == self.engine
            and _like(scene, self.scene)
            and _like(scheme, self.scheme)
            and SpecifierSet(self.versions).contains(version, prereleases=True)
        )


@cache
def recorded() -> tuple[Deviation, ...]:
    """The entries that ship with Poinsot; raises ``InputError`` for one that cannot be."""
    text = resources.files("poinsot.adapters").joinpath(FILE).read_text(encoding="utf-8")
    return parsed(text)


def parsed(text: str) -> tuple[Deviation, ...]:
    """Entries from TOML; raises ``InputError`` that names the entry and what is wrong with it."""
    entries = tomllib.loads(text).get("deviation", [])
    return tuple(_entry(number, entry) for number, entry in enumerate(entries, start=1))


def applied(
    verdicts: Sequence[Verdict], deviations: Iterable[Deviation], partly: Collection[Ladder] = ()
) -> list[Verdict]:
    """The verdicts with recorded deviations taken into account.

    A failure inside its bound is ``known``; one outside stays a failure and says by how much the
    record is exceeded. Where an entry applies and nothing of it is left, its verdicts are ``fixed``;
    but of a ladder that was run ``partly`` the rest may still deviate.
    """
    found = list(verdicts)
    ladders = {ladder_of(verdict) for verdict in verdicts}
    for deviation in deviations:
        if not any(deviation.speaks_of(*ladder) for ladder in ladders):
            continue
        places = [place for place, verdict in enumerate(verdicts) if deviation.applies(verdict)]
        gone = all(
            verdicts[place].status is Status.PASS and ladder_of(verdicts[place]) not in partly
            for place in places
        )
        for place in places:
            found[place] = _marked(verdicts[place], deviation, gone)
    return found


def unmatched(
    verdicts: Iterable[Verdict], deviations: Iterable[Deviation], partly: Collection[Ladder] = ()
) -> list[str]:
    """A sentence for every entry that speaks of no check that was made, nor of a ladder run ``partly``."""
    made: dict[Ladder, list[Verdict]] = defaultdict(list)
    for verdict in verdicts:
        made[ladder_of(verdict)].append(verdict)
    return [
        f"known deviation of {d.engine} {d.scheme} in {d.scene}: {d.check} of {d.observable} is no check "
        "that was made; remove or mend its record"
        for d in deviations
        if any(engine == d.engine for _, engine, *_ in made)
        and not any(d.speaks_of(*ladder) and any(map(d.applies, those)) for ladder, those in made.items())
        and not any(d.speaks_of(*ladder) for ladder in partly)
    ]


def _marked(verdict: Verdict, deviation: Deviation, gone: bool) -> Verdict:
    if gone:
        message = f"recorded as deviating ({deviation.reason}), but does so no longer; remove the record"
        return replace(verdict, status=Status.FIXED, message=message)
    if verdict.status is not Status.FAIL or verdict.measured is None:
        return verdict
    if verdict.measured <= deviation.bound:
        return replace(verdict, status=Status.KNOWN, message=f"{verdict.message}{KNOWN}{deviation.reason}")
    return replace(verdict, message=f"{verdict.message}; beyond the recorded bound of {deviation.bound:.3g}")


def _like(name: str, pattern: str) -> bool:
    return fnmatchcase(name, pattern.replace("[", "[[]"))


def _entry(number: int, entry: dict[str, Any]) -> Deviation:
    known = {field.name for field in fields(Deviation)}
    required = known - {"dt"}
    place = f"{FILE}, entry {number}"
    if not required <= entry.keys() <= known:
        raise InputError(f"{place}: got {sorted(entry)}, expected {sorted(required)} and perhaps dt")
    if entry["check"] not in CHECKS:
        raise InputError(f"{place}: got check {entry['check']!r}, expected one of {', '.join(CHECKS)}")
    try:
        SpecifierSet(entry["versions"])
    except InvalidSpecifier as error:
        raise InputError(f"{place}: got versions {entry['versions']!r}; {error}") from error
    if not entry["reason"]:
        raise InputError(f"{place}: got no reason, expected a link or a measurement")
    return Deviation(**entry)
