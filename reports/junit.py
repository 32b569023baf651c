"""The verdicts as JUnit XML, which every CI system knows how to show."""

from collections.abc import Iterable, Iterator
from pathlib import Path
from xml.etree import ElementTree

from .digest import Digest, Group, Record, gravest
from .verdict import Status
from .wording import number, printable

#: The element that a status becomes; a known deviation passes, and says so in its output.
_ELEMENTS = {
    Status.ERROR: "error",
    Status.FAIL: "failure",
    Status.FIXED: "failure",
    Status.UNAVAILABLE: "skipped",
    Status.UNSUPPORTED: "skipped",
    Status.KNOWN: "system-out",
}

#: A step, and what was found there: the cell itself, or one of its verdicts.
_Found = list[tuple[float, Record]]


def render(results: Record, out: Path) -> None:
    """Write ``results`` (the content of results.json) as JUnit XML to the file ``out``.

    A test suite is a scene in a scheme; its test cases are the run itself and each check of each
    observable, over every step. Raises ``InputError`` if ``results`` has another schema.
    """
    digest = Digest(results)
    seconds = _seconds(digest)
    root = ElementTree.Element("testsuites", name="poinsot", time=f"{digest.seconds:.3f}")
    for group in digest.groups.values():
        root.append(_suite(group, digest.started, seconds.get(_key(group), 0.0)))
    for total in ("tests", "failures", "errors"):
        root.set(total, str(sum(int(suite.get(total, "0")) for suite in root)))
    ElementTree.indent(root)
    ElementTree.ElementTree(root).write(out, encoding="utf-8", xml_declaration=True)


def _seconds(digest: Digest) -> dict[tuple[str, ...], float]:
    """The timed seconds of each scene in each scheme, all its steps together."""
    cells: dict[tuple[str, ...], dict[float, float]] = {}
    for row in digest.work_precision:
        key = row["scene"], row["engine"], row["engine_version"] or "", row["scheme"]
        # Every observable of a cell repeats its time.
        cells.setdefault(key, {})[row["dt"]] = row["seconds_median"] or 0.0
    return {key: sum(of_steps.values()) for key, of_steps in cells.items()}


def _key(group: Group) -> tuple[str, ...]:
    return group.scene, group.column.engine, group.column.version, group.column.scheme


def _suite(group: Group, started: str, seconds: float) -> ElementTree.Element:
    # A dot would divide the class into packages.
    classname = ".".join(printable(part).replace(".", "_") for part in (group.scene, group.column.label))
    cases = [_case(classname, name, found) for name, found in _checks(group)]
    # What was not timed has no time of its own to tell; CI systems want a number all the same.
    for case, time in zip(cases, [seconds, *[0.0] * len(cases)], strict=False):
        case.set("time", f"{time:.3f}")
    suite = ElementTree.Element("testsuite", name=printable(group.name), tests=str(len(cases)))
    for total, tag in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
        suite.set(total, str(sum(case.find(tag) is not None for case in cases)))
    suite.set("time", f"{seconds:.3f}")
    suite.set("timestamp", printable(started))
    suite.extend(cases)
    return suite


def _checks(group: Group) -> Iterator[tuple[str, _Found]]:
    """The run, then each check of each observable, by name."""
    yield "run", [(cell["dt"], cell) for cell in group.cells if cell["message"] or not cell["verdicts"]]
    checks: dict[str, _Found] = {}
    for cell in group.cells:
        for verdict in cell["verdicts"]:
            name = f"{verdict['check']} of {verdict['observable']}"
            checks.setdefault(name, []).append((cell["dt"], verdict))
    yield from checks.items()


def _case(classname: str, name: str, found: _Found) -> ElementTree.Element:
    case = ElementTree.Element("testcase", classname=classname, name=printable(name))
    status = gravest([Status(record["status"]) for _, record in found] or [Status.PASS])
    if status is not Status.PASS:
        said = [record["message"] for _, record in found if record["status"] == status.value]
        element = ElementTree.SubElement(case, _ELEMENTS[status])
        element.text = "\n".join(_lines(found))
        if status is not Status.KNOWN:
            element.set("type", status.value)
            element.set("message", printable(said[0] or status.sentence))
    return case


def _lines(found: _Found) -> Iterable[str]:
    """Everything that is not a pass, step by step."""
    for dt, record in found:
        if record["status"] != Status.PASS.value:
            said = record["message"] or Status(record["status"]).sentence
            yield printable(f"{record['status']} at dt {number(dt)} s: {_numbers(record)}{said}")


def _numbers(record: Record) -> str:
    if record.get("measured") is None:
        return ""
    return f"measured {number(record['measured'])}, allowed {number(record['allowed'])} {record['unit']}; "
