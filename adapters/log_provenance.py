"""A trajectory's provenance as the log's metadata records: names with texts, and back, exactly.

Record ``run`` says which cell this is; ``setup``, ``settings`` and ``environment`` are the mappings of
those names. What is text stays as it is; all else is JSON, with two marks for what JSON lacks:
``{"$tuple": [...]}`` and ``{"$float": "inf"}``.
"""

import json
import math
from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from ..reference.errors import InputError
from ..scenarios.trajectory import Provenance

_RECORDS = ("setup", "settings", "environment")
_RUN = tuple(field for field in fields(Provenance) if field.name not in _RECORDS)

Metadata = dict[str, dict[str, str]]


def to_metadata(provenance: Provenance) -> Metadata:
    """Metadata records by name. Raises ``InputError`` for a value that no log can give back."""
    run = {field.name: _text(getattr(provenance, field.name), field.type is str) for field in _RUN}
    result = {"run": run}
    for name in _RECORDS:
        entries = getattr(provenance, name)
        try:
            result[name] = {_key(key): _text(value, name == "settings") for key, value in entries.items()}
        except InputError as error:
            raise InputError(f"provenance {name}: {error}") from error
    return result


def from_metadata(metadata: Metadata) -> Provenance:
    """The provenance in these records. Raises ``KeyError``, ``TypeError`` or ``ValueError`` if none is."""
    arguments: dict[str, Any] = {
        field.name: _value(metadata["run"][field.name], field.type is str)
        for field in _RUN
        if field.name in metadata["run"]
    }
    for name in _RECORDS:
        arguments[name] = {key: _value(text, name == "settings") for key, text in metadata[name].items()}
    return Provenance(**arguments)


def _text(value: Any, plain: bool) -> str:
    if plain and not isinstance(value, str):
        raise InputError(f"got {value!r}, expected text")
    return value if plain else json.dumps(_marked(value), ensure_ascii=False, allow_nan=False)


def _value(text: str, plain: bool) -> Any:
    return text if plain else _unmarked(json.loads(text))


def _marked(value: Any) -> Any:
    if isinstance(value, float) and not math.isfinite(value):
        return {"$float": repr(float(value))}
    if isinstance(value, tuple):
        return {"$tuple": [_marked(part) for part in value]}
    if isinstance(value, list):
        return [_marked(part) for part in value]
    if isinstance(value, Mapping):
        return {_key(key): _marked(part) for key, part in value.items()}
    if value is None or isinstance(value, str | int | float):
        return value
    raise InputError(f"got {value!r}, expected numbers, texts, lists, tuples and mappings of them")


def _unmarked(value: Any) -> Any:
    if isinstance(value, list):
        return [_unmarked(part) for part in value]
    if not isinstance(value, dict):
        return value
    if "$float" in value:
        return float(value["$float"])
    if "$tuple" in value:
        return tuple(_unmarked(part) for part in value["$tuple"])
    return {key: _unmarked(part) for key, part in value.items()}


def _key(key: Any) -> str:
    if not isinstance(key, str) or key.startswith("$"):
        raise InputError(f"got the key {key!r}, expected a text that does not begin with $")
    return key
