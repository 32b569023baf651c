"""What a run took: seconds by the clock and of the processor, by phase, by cell and by part of the work."""

import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter
from typing import Any

from .adapters.runner import Outcome, Request
from .estimate import Estimate

FILE = "cost.json"
SCHEMA = "poinsot.cost/1"


@dataclass
class Cost:
    """Filled while a run goes on; ``judging`` [s] is by scene and part."""

    workers: int
    expected: Estimate | None = None
    begun: float = field(default_factory=perf_counter)
    phases: dict[str, dict[str, float]] = field(default_factory=dict)
    outcomes: list[Outcome] = field(default_factory=list)
    judging: dict[str, dict[str, float]] = field(default_factory=dict)
    #: What was timed as well.
    timed: frozenset[Request] = frozenset()

    @contextmanager
    def phase(self, name: str) -> Iterator[None]:
        """Count the block, with the child processes that ended in it, as the phase ``name``."""
        clock, processor = perf_counter(), _processor()
        try:
            yield
        finally:
            self.phases[name] = {
                "seconds": round(perf_counter() - clock, 3),
                "cpu_seconds": round(_processor() - processor, 3),
            }

    def write(self, folder: Path) -> None:
        """Write it beside the results, a line a cell."""
        cells = ",\n  ".join(json.dumps(self._cell(outcome), ensure_ascii=False) for outcome in self.outcomes)
        judging = ",\n  ".join(
            f"{json.dumps(scene)}: {json.dumps(_rounded(parts))}" for scene, parts in self.judging.items()
        )
        text = (
            f'{{\n "schema": "{SCHEMA}",\n "workers": {self.workers},\n'
            f' "seconds": {perf_counter() - self.begun:.3f},\n'
            f' "pulse": {json.dumps(self.expected and self.expected.pulse)},\n'
            f' "crowding": {json.dumps(self.expected and round(self.expected.crowding, 2))},\n'
            f' "expected": {json.dumps(self._expected())},\n'
            f' "phases": {json.dumps(self.phases)},\n'
            f' "cells": [\n  {cells}\n ],\n "judging": {{\n  {judging}\n }}\n}}\n'
        )
        (folder / FILE).write_text(text, encoding="utf-8")

    def _expected(self) -> dict[str, float]:
        """Seconds by phase that were expected by the clock."""
        phases = self.expected.phases if self.expected else {}
        return {name: round(sum(pieces), 3) for name, pieces in phases.items()}

    def _cell(self, outcome: Outcome) -> dict[str, Any]:
        asked = outcome.request
        return {
            "scene": asked.scene,
            "engine": asked.engine,
            "scheme": asked.scheme,
            "dt": asked.dt,
            "repeats": asked.repeats,
            "asked": asked.asked,
            "timed": asked in self.timed,
            "spent": _rounded(outcome.spent),
        }


def _rounded(parts: Mapping[str, float]) -> dict[str, float]:
    """To the microsecond: no clock of a processor is finer."""
    return {part: round(seconds, 6) for part, seconds in parts.items()}


def _processor() -> float:
    """Seconds of the processor that this process and its ended children took."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system
