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
    """One bound of an entry of ``adapters/known_deviations.toml``.

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
            and self.names(verdict.observable)
            and self.speaks_of(*ladder_of(verdict))
        )

    def names(self, observable: str) -> bool:
        """Whether this entry speaks of that observable."""
        return _like(observable, self.observable)

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
    """Entries from TOML; raises ``InputError`` that names the entry and what is wrong with it.

    An entry names a ``check``, an ``observable`` and its ``bound``, or says of several which bound is whose:
    ``bounds.truth.omega = 0.1``.
    """
    entries = tomllib.loads(text).get("deviation", [])
    return tuple(
        _entry(number, one) for number, entry in enumerate(entries, start=1) for one in _each(number, entry)
    )


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


def _each(number: int, entry: dict[str, Any]) -> list[dict[str, Any]]:
    """An entry of several bounds as one for each."""
    if "bounds" not in entry:
        return [entry]
    shared, bounds = {name: entry[name] for name in entry if name != "bounds"}, entry["bounds"]
    single = {"check", "observable", "bound"} & entry.keys()
    if single:
        raise InputError(f"{FILE}, entry {number}: got bounds and {sorted(single)}, expected either")
    mine = list(bounds.values()) if isinstance(bounds, dict) else []
    numbers = [bound for each in mine for bound in (each.values() if isinstance(each, dict) else [None])]
    if not numbers or not all(isinstance(bound, int | float) for bound in numbers):
        example = "bounds.truth.omega = 0.1"
        raise InputError(f"{FILE}, entry {number}: got bounds {bounds}, expected as in {example}")
    return [
        {**shared, "check": check, "observable": observable, "bound": bound}
        for check, each in bounds.items()
        for observable, bound in each.items()
    ]


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
