"""Results in a file: written so that two runs can be compared by eye, read only where they are known here."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..reference.errors import PoinsotError


class ResultsError(PoinsotError):
    """A file of results that cannot be what it should be."""


def write(path: Path, found: Mapping[str, Any]) -> None:
    """Write results as JSON, one line a value, stable from run to run."""
    path.write_text(json.dumps(found, indent=1, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8")


def read(path: Path, schema: str, of: str) -> dict[str, Any]:
    """Read the results ``of`` something; raises ``ResultsError`` if the file is not of that ``schema``."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ResultsError(f"{path.name}: {error}; expected the results of {of}") from error
    got = found.get("schema") if isinstance(found, dict) else None
    if got != schema:
        raise ResultsError(f"{path.name}: got schema {got!r}, expected {schema!r}")
    return dict(found)
