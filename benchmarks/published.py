"""What the benchmarks that publish a page share: print it, write it, or hold it against what is so now."""

import difflib
import re
import sys

#: A number within words, and neither an exponent nor within a name such as `I3`.
NUMBER = re.compile(r"(?<![\w^])(?<!\^-)[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
#: What two numbers may differ by, as a factor, where a column has no factor of its own: how they are printed.
PRINTED = 1 + 1e-9


def settled(text, path, arguments, factors=None):
    """Do with a page what the arguments ask for; 1 if it does not agree with what was published.

    ``factors`` maps the name of a column to the factor by which its numbers may be off.
    """
    if "--publish" in arguments:
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return 0
    if "--check" not in arguments:
        sys.stdout.write(text)
        return 0
    return agreed(list(differences(path.read_text(encoding="utf-8"), text, factors or {})))


def agreed(found):
    """Print what differs; 1 if anything does."""
    print("\n".join(found) or "the page agrees")
    return 1 if found else 0


def differences(page, now, factors):
    """What a published page says and is no longer so, and what is so now in its place."""
    old, new = columns(page), columns(now)
    matcher = difflib.SequenceMatcher(
        None, *([wording(line) for line, _ in side] for side in (old, new)), False
    )
    for tag, a, b, c, d in matcher.get_opcodes():
        if tag == "equal":
            for (line, names), (other, _) in zip(old[a:b], new[c:d], strict=True):
                if not about(line, other, names, factors):
                    yield f"published: {line}\nmeasured:  {other}"
        else:
            yield from (f"published, and no longer so: {line}" for line, _ in old[a:b])
            yield from (f"measured, and not published: {line}" for line, _ in new[c:d])


def columns(text):
    """Each line that is not empty, with the names of the columns of the table it stands in."""
    found, names = [], []
    for line in text.splitlines():
        if not line.startswith("|"):
            names = []
        elif not names:
            names = cells(line)
        if line:
            found.append((line, names))
    return found


def cells(line):
    """The cells of a line of a table."""
    return [cell.strip() for cell in line.strip("|").split("|")]


def wording(line):
    """A line without its numbers."""
    return NUMBER.sub("#", line)


def about(line, other, names, factors):
    """Whether two lines of the same words have about the same numbers."""
    pairs = zip(cells(line), cells(other), strict=True)
    return all(
        close(float(one), float(two), factors.get(names[place] if place < len(names) else "", PRINTED))
        for place, (a, b) in enumerate(pairs)
        for one, two in zip(NUMBER.findall(a), NUMBER.findall(b), strict=True)
    )


def close(one, two, factor):
    """Whether two numbers differ by no more than a factor."""
    small, large = sorted((abs(one), abs(two)))
    return one == two or factor == float("inf") or (one * two > 0 and large <= factor * small)
