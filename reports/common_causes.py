"""What is most likely wrong, said once for all scenes of an engine that it explains."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .verdict import Ladder

#: Times and sizes of one scene, after which nothing of what is wrong is said.
_AT = re.compile(r" (after|between) t = .*| off by .*")


@dataclass(frozen=True)
class Localisation:
    """What most likely is wrong with an engine's scheme in a scene.

    ``causes`` are sentences that explain what was logged, equally well if they are several; where none
    does, the one sentence says so and ``found`` is false.
    """

    ladder: Ladder
    causes: tuple[str, ...]
    found: bool = True

    @property
    def sentence(self) -> str:
        """All of it in one sentence."""
        if len(self.causes) == 1:
            return self.causes[0]
        more = f" or {len(self.causes) - 3} others" if len(self.causes) > 3 else ""
        return f"either {' or '.join(self.causes[:3])}{more}, which these data cannot tell apart"


def grouped(localisations: Iterable[Localisation]) -> list[dict[str, Any]]:
    """Causes, each with the schemes and scenes of one engine that it explains, the widest first.

    A scene that several causes explain equally well speaks for the one that explains most scenes. Keys:
    engine, engine_version, schemes, scenes, sentence, found.
    """
    by_engine: dict[tuple[str, str], list[Localisation]] = {}
    for one in localisations:
        _, engine, version, _ = one.ladder
        by_engine.setdefault((engine, version), []).append(one)
    return [part for (engine, version), mine in by_engine.items() for part in _parts(engine, version, mine)]


def spoken(part: Mapping[str, Any]) -> str:
    """A group in one sentence, with where it is true."""
    scenes, schemes = part["scenes"], part["schemes"]
    where = f"in {len(scenes)} scenes" if len(scenes) > 1 else f"in {scenes[0]}"
    by = f" {schemes[0]}" if len(schemes) == 1 else ""
    return f"{part['engine']}{by}: {part['sentence']} ({where})"


def _parts(engine: str, version: str, left: Sequence[Localisation]) -> list[dict[str, Any]]:
    found = []
    while left:
        votes: dict[str, list[Localisation]] = {}
        for one in left:
            for key in dict.fromkeys(map(_general, one.causes)):
                votes.setdefault(key, []).append(one)
        key, mine = max(votes.items(), key=lambda vote: (vote[1][0].found, len(vote[1])))
        found.append(_part(engine, version, key, mine))
        left = [one for one in left if one not in mine]
    return found


def _part(engine: str, version: str, key: str, mine: Sequence[Localisation]) -> dict[str, Any]:
    if len(mine) == 1:
        sentence = mine[0].sentence
    else:
        own = {cause for one in mine for cause in one.causes if _general(cause) == key}
        sentence = own.pop() if len(own) == 1 else key
    return {
        "engine": engine,
        "engine_version": version,
        "schemes": list(dict.fromkeys(one.ladder[3] for one in mine)),
        "scenes": list(dict.fromkeys(one.ladder[0] for one in mine)),
        "sentence": sentence,
        "found": mine[0].found,
    }


def _general(cause: str) -> str:
    """A cause without what is one scene's own: names, times and sizes."""
    return _AT.sub("", re.sub(r"\b(body|joint) '[^']*'", r"a \1", cause)).strip()
