"""Every scene there is: found by listing this folder, so that a new scene is one new file."""

import importlib
import pkgutil
from functools import cache

from ..reference.errors import InputError
from ..reference.spelling import nearest
from .scene import Scene


@cache
def scenes() -> dict[str, Scene]:
    """All scenes by full name, variants in the order their file lists them.

    A scene file is a module of this folder with a tuple ``SCENES``.
    """
    found: dict[str, Scene] = {}
    folder = importlib.import_module(__package__)
    for entry in sorted(pkgutil.iter_modules(folder.__path__), key=lambda module: module.name):
        module = importlib.import_module(f"{__package__}.{entry.name}")
        for scene in getattr(module, "SCENES", ()):
            if scene.full_name in found:
                raise InputError(f"scene {scene.full_name}: two files of scenarios/ define it, expected one")
            found[scene.full_name] = scene
    return found


def select(names: list[str]) -> list[Scene]:
    """The scenes of these names; ``name`` alone means all its variants, no names mean all scenes.

    Raises ``InputError`` that names the nearest scene for a name that none has.
    """
    known = scenes()
    chosen: dict[str, Scene] = {} if names else dict(known)
    for name in names:
        matches = {full: scene for full, scene in known.items() if name in (full, scene.name)}
        if not matches:
            bare = dict.fromkeys(scene.name for scene in known.values())
            raise InputError(f"scene: got {name!r}; {nearest(name, [*bare, *known])}")
        chosen.update(matches)
    return list(chosen.values())
