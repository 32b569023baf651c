"""The report as Markdown, for a terminal and for a comment on a change."""

import re
from collections.abc import Iterable, Sequence
from itertools import groupby
from pathlib import Path

from .common_causes import spoken
from .digest import Digest, Group, Record
from .findings import findings
from .verdict import Status
from .wording import GLYPHS, count, printable

#: What Markdown would take for markup inside a sentence; underscores inside words it leaves alone.
_MARKUP = re.compile(r"([\\`*<|~]|\](?=\()|&(?=#?\w+;))")


def render(results: Record, out: Path) -> None:
    """Write the summary of ``results`` (the content of results.json) to the file ``out``.

    Raises ``InputError`` if ``results`` has another schema.
    """
    digest = Digest(results)
    parts = [_head(digest), _likely(digest), _matrix(digest), _not_passes(digest), _environment(digest)]
    out.write_text("\n\n".join(filter(None, parts)) + "\n", encoding="utf-8")


def _plain(text: object) -> str:
    """``text`` on one line, with nothing in it that Markdown would act on."""
    return _MARKUP.sub(r"\\\1", printable(" ".join(str(text).split())))


def _head(digest: Digest) -> str:
    counts = [f"{GLYPHS[status]} {n} {status.value}" for status, n in reversed(digest.counts.items())]
    size = f"{count(len(digest.scenes), 'scene')}, {count(len(digest.columns), 'engine scheme')}"
    return f"# Poinsot\n\n**{_plain(digest.headline)}**\n\n{size}. Cells: {', '.join(counts) or 'none'}."


def _likely(digest: Digest) -> str:
    """What most likely is wrong, where checks fail."""
    if not digest.likely_causes:
        return ""
    lines = [f"- {_plain(spoken(cause))}" for cause in digest.likely_causes]
    return "\n".join(["## What most likely is wrong, estimated from the logs", "", *lines])


def _matrix(digest: Digest) -> str:
    """Schemes are numbered, so that the table fits a terminal however many there are."""
    numbers = [str(n) for n in range(1, len(digest.columns) + 1)]
    key = ", ".join(f"{n} {_plain(column.label)}" for n, column in zip(numbers, digest.columns, strict=True))
    rows = [[_plain(scene), *map(_mark, digest.row(scene))] for scene in digest.scenes]
    legend = ", ".join(f"{glyph} {status.value}" for status, glyph in GLYPHS.items())
    return "\n\n".join(
        [
            "## Scenes × engine schemes: the worst status over every step and check",
            f"{legend}, ({GLYPHS[Status.PASS]}) passes but for checks that could not be made, blank not run.",
            f"Columns: {key or 'none'}.",
            _table(["scene", *numbers], rows),
        ]
    )


def _mark(group: Group | None) -> str:
    if group is None:
        return ""
    return f"({GLYPHS[group.status]})" if group.partial else GLYPHS[group.status]


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A Markdown table whose columns also stand under each other as plain text."""
    lines = [list(head), *map(list, rows)]
    widths = [max(3, *(len(line[k]) for line in lines)) for k in range(len(head))]
    lines.insert(1, ["-" * width for width in widths])
    return "\n".join(
        f"| {' | '.join(word.ljust(width) for word, width in zip(line, widths, strict=True))} |"
        for line in lines
    )


def _not_passes(digest: Digest) -> str:
    lines = ["## Everything that is not a pass"]
    found = findings(digest)
    if not found:
        lines.append("Every cell passes, and so does every check.")
    for status, some in groupby(found, key=lambda finding: finding.status):
        sentences = [
            f"- **{_plain(finding.where)}**{', ' * bool(finding.about)}{_plain(finding.about)}: "
            f"{_plain(finding.sentence)}{f' ({_plain(finding.numbers)})' if finding.numbers else ''}"
            for finding in some
        ]
        lines.append("\n".join([f"### {GLYPHS[status]} {status.value}: {status.sentence}", "", *sentences]))
    if digest.notes:
        notes = [f"- {_plain(note)}" for note in digest.notes]
        lines.append("\n".join(["### Left out of this run, or adjusted", "", *notes]))
    return "\n\n".join(lines)


def _environment(digest: Digest) -> str:
    facts = {**digest.facts, "started": digest.started, "took": f"{digest.seconds:.4g} s"}
    table = _table(["what", "value"], [[_plain(name), _plain(value)] for name, value in facts.items()])
    again = f"To run it again:\n\n    {printable(' '.join(digest.command.split()))}"
    return "\n\n".join(["## Environment: versions and machine", table, again])
