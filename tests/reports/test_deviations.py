"""Known deviations: granted up to their bound, in their versions, and no longer than they last."""

import re
from dataclasses import replace
from fnmatch import fnmatchcase

import pytest
from packaging.specifiers import SpecifierSet
from poinsot.adapters.declared import declared
from poinsot.reference.errors import InputError
from poinsot.reports import deviations
from poinsot.reports.deviations import Deviation
from poinsot.reports.verdict import Status, Verdict, ladder_of
from poinsot.scenarios.registry import scenes

ENTRY = Deviation(
    "heavy_top[fast]", "alpha", "Euler", ">=1,<3", "truth", "omega", 1e-3, "it drifts; see its issue 7"
)
FAILED = Verdict(
    "heavy_top[fast]", "alpha", "2.1", "Euler", 1e-3, "truth", "omega", Status.FAIL, 5e-4, 1e-4, "rad/s",
    1.5, "far",
)  # fmt: skip
PASSED = replace(FAILED, status=Status.PASS, measured=5e-5)


def test_a_failure_inside_its_bound_is_known():
    (found,) = deviations.applied([FAILED], [ENTRY])
    assert (found.status, found.message) == (Status.KNOWN, "far; known: it drifts; see its issue 7")
    assert replace(found, status=Status.FAIL, message="far") == FAILED


def test_a_failure_beyond_its_bound_stays_and_says_so():
    (found,) = deviations.applied([replace(FAILED, measured=2e-3)], [ENTRY])
    assert (found.status, found.message) == (Status.FAIL, "far; beyond the recorded bound of 0.001")


def test_a_deviation_that_is_gone_is_fixed_and_fails():
    (found,) = deviations.applied([PASSED], [ENTRY])
    assert found.status is Status.FIXED
    assert not found.status.conforms
    assert found.message.endswith("but does so no longer; remove the record")


def test_a_deviation_that_is_left_somewhere_is_not_gone():
    found = deviations.applied([PASSED, replace(FAILED, dt=5e-4)], [ENTRY])
    assert [v.status for v in found] == [Status.PASS, Status.KNOWN]


@pytest.mark.parametrize("status", [Status.ERROR, Status.UNSUPPORTED, Status.UNAVAILABLE])
def test_only_a_failed_check_is_excused(status):
    broken = replace(FAILED, status=status)
    assert deviations.applied([broken], [ENTRY]) == [broken]


def test_a_failure_without_a_number_is_not_inside_any_bound():
    found = deviations.applied([replace(FAILED, measured=None)], [ENTRY])
    assert [v.status for v in found] == [Status.FAIL]


def test_a_failure_that_is_no_number_is_not_inside_any_bound():
    found = deviations.applied([replace(FAILED, measured=float("nan"))], [ENTRY])
    assert [v.status for v in found] == [Status.FAIL]


ELSEWHERE = [
    {"engine": "beta"}, {"scheme": "RK4"}, {"check": "invariant"}, {"observable": "orientation"},
    {"scene": "heavy_top[cusps]"}, {"engine_version": "3.0"}, {"engine_version": "0.9"},
]  # fmt: skip


@pytest.mark.parametrize("change", ELSEWHERE)
def test_an_entry_speaks_of_nothing_else(change):
    other = replace(FAILED, **change)
    assert not ENTRY.applies(other)
    assert deviations.applied([other, FAILED], [ENTRY])[0] == other


@pytest.mark.parametrize(
    ("change", "applies"),
    [
        ({"scene": "heavy_top*"}, True),
        ({"scene": "*"}, True),
        ({"scene": "heavy_top"}, False),
        ({"scene": "heavy_top[f*]"}, True),
        ({"scene": "heavy_top[c*]"}, False),  # a bracket stands for itself: f is no c
        ({"scene": "heavy_topf"}, False),
        ({"observable": "om*"}, True),
        ({"scheme": "Eul?r"}, True),
        ({"versions": "==2.1"}, True),
        ({"versions": ""}, True),
        ({"dt": 1e-3}, True),
        ({"dt": 9e-4}, False),
        ({"engine": "al*"}, False),
    ],
)
def test_patterns_versions_and_steps(change, applies):
    assert replace(ENTRY, **change).applies(FAILED) is applies


def test_a_release_candidate_is_in_its_range():
    assert replace(ENTRY, versions=">=2").applies(replace(FAILED, engine_version="2.1rc1"))


def test_entries_that_speak_of_no_check_are_named():
    made = [replace(FAILED, engine="beta"), FAILED]
    assert deviations.unmatched(made, [ENTRY]) == []
    (said,) = deviations.unmatched(made, [replace(ENTRY, observable="spin")])
    assert said.startswith(
        "known deviation of alpha Euler in heavy_top[fast]: truth of spin is no check that was made"
    )
    # Of an engine that was not run there is nothing to say.
    assert deviations.unmatched(made, [replace(ENTRY, engine="gamma")]) == []


TEXT = """
[[deviation]]
scene = "heavy_top[fast]"
engine = "alpha"
scheme = "Euler"
versions = ">=1,<3"
check = "truth"
observable = "omega"
bound = 1e-3
reason = "it drifts; see its issue 7"
"""


def test_an_entry_is_read_as_it_is_written():
    assert deviations.parsed(TEXT) == (ENTRY,)
    assert deviations.parsed(TEXT + "dt = 2e-3\n") == (replace(ENTRY, dt=2e-3),)
    assert deviations.parsed("") == ()


SEVERAL = """
bounds.truth."omega*" = 1e-3
bounds.truth.position = 0.2
bounds.order.omega = 1
"""


def test_an_entry_of_several_bounds_is_one_for_each():
    text = "".join(line for line in TEXT.splitlines(True) if line.split(" ")[0] not in SINGLE)
    assert deviations.parsed(text + SEVERAL + TEXT) == (
        replace(ENTRY, observable="omega*"),
        replace(ENTRY, observable="position", bound=0.2),
        replace(ENTRY, check="order", bound=1),
        ENTRY,
    )


SINGLE = ("check", "observable", "bound")


@pytest.mark.parametrize(
    ("more", "says"),
    [
        (SEVERAL + 'check = "truth"', "got bounds and ['check'], expected either"),
        ("bounds = 0.1", "got bounds 0.1, expected as in bounds.truth.omega = 0.1"),
        ("bounds.truth = 0.1", "got bounds {'truth': 0.1}, expected as in"),
        ("bounds.truth = {}", "got bounds {'truth': {}}, expected as in"),
        ('bounds.truth.omega = "1e-3"', "expected as in bounds.truth.omega = 0.1"),
        ("bounds.energy.drift = 1", "got check 'energy', expected one of truth, order, twin"),
    ],
)
def test_bounds_that_cannot_be_are_refused_by_number_and_fault(more, says):
    text = "".join(line for line in TEXT.splitlines(True) if line.split(" ")[0] not in SINGLE)
    with pytest.raises(InputError, match=re.escape(says)) as caught:
        deviations.parsed(text + more)
    assert str(caught.value).startswith("known_deviations.toml, entry 1: ")


@pytest.mark.parametrize(
    ("line", "instead", "says"),
    [
        ('engine = "alpha"\n', "", "entry 1: got ['bound', 'check', 'observable', "),
        ('engine = "alpha"', 'engine = "alpha"\nseverity = "low"', "'severity'"),
        ('check = "truth"', 'check = "energy"', "got check 'energy', expected one of truth, order, twin"),
        ('versions = ">=1,<3"', 'versions = "2.x"', "got versions '2.x'"),
        (
            'reason = "it drifts; see its issue 7"',
            'reason = ""',
            "got no reason, expected a link or a measurement",
        ),
    ],
)
def test_an_entry_that_cannot_be_is_refused_by_number_and_fault(line, instead, says):
    assert line in TEXT
    with pytest.raises(InputError, match=re.escape(says)) as caught:
        deviations.parsed(TEXT.replace(line, instead))
    assert str(caught.value).startswith("known_deviations.toml, entry 1: ")


#: Deviations that are no rounding, by words of their reasons: how large they may be, and what order a ladder
#: may show that converges to something else.
WRONG_PHYSICS = {
    "friction": (0.1, 1.5),
    "the sensor adds ω×Iω": (4.0, 1.5),
    "box around": (12.0, 1.5),
    "single precision": (1e-5, 4.1),
}

#: Of engines as they come, by observable: a clamp at 100 is 1e4 below what no scene comes near, and of a spin
#: of 150 rad/s it leaves little.
AS_THEY_COME = {"velocity_limit": 1.01e4, "*_damping": 0.05, "omega": 150.0, "energy": 120.0}
#: A motor that stops a hinge in one step shows as a damping of 1/s, and as a clamp to what it leaves of 1e7.
MOTORS = {"compound_pendulum[defaults]": {"velocity_limit": 1.3e4, "*_damping": 1.1}}


def test_the_entries_that_ship_speak_of_what_there_is():
    schemes = {(engine.name, scheme.name) for engine in declared() for scheme in engine.schemes}
    for entry in deviations.recorded():
        assert any(engine == entry.engine and fnmatchcase(name, entry.scheme) for engine, name in schemes)
        assert entry.scene in scenes()
        assert len(entry.reason) > 40
        # Measured up to one version, and known of none after it.
        assert not SpecifierSet(entry.versions).contains("999")
        # Rounding is small; wrong physics is not, and has no order: then nothing else may be granted.
        [(largest, order), *_] = [
            *(found for words, found in WRONG_PHYSICS.items() if words in entry.reason),
            (1e-3, 0.0),
        ]
        if scenes()[entry.scene].defaults:  # what users get who set nothing may be anything but an order
            granted = AS_THEY_COME | MOTORS.get(entry.scene, {})
            largest, order = granted.get(entry.observable, 10.0), 0.0
        assert 0 < entry.bound <= (order if entry.check == "order" else largest)


def test_of_a_ladder_run_in_part_nothing_is_taken_for_gone_or_unmatched():
    partly = {ladder_of(PASSED)}
    assert deviations.applied([PASSED], [ENTRY], partly) == [PASSED]
    assert deviations.unmatched([PASSED], [replace(ENTRY, observable="spin")], partly) == []
    other = {ladder_of(replace(PASSED, scene="heavy_top[moderate]"))}
    assert deviations.applied([PASSED], [ENTRY], other)[0].status is Status.FIXED
