"""What a person who misspelt a name probably meant."""

from collections.abc import Iterable


def nearest(got: str, valid: Iterable[str]) -> str:
    """A half sentence that suggests the nearest valid name and lists them all."""
    import difflib  # few misspell, and whoever only lists names would load it too

    names = list(valid)
    close = difflib.get_close_matches(got, names, n=1)
    suggestion = f"did you mean {close[0]!r}? " if close else ""
    return f"{suggestion}expected one of: {', '.join(names)}"
