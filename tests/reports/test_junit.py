"""JUnit XML as CI systems read it: the common schema, the right colours, the right sentences."""

import copy
import re
from collections import Counter
from xml.etree import ElementTree

import pytest
from poinsot.reports import junit

#: What the schema of Jenkins' xUnit plugin (junit-10.xsd) lets an element hold: attributes, children.
ALLOWED = {
    "testsuites": ({"name", "time", "tests", "failures", "errors"}, {"testsuite"}),
    "testsuite": (
        {"name", "tests", "failures", "errors", "skipped", "time", "timestamp"},
        {"testcase"},
    ),
    "testcase": ({"name", "classname", "time"}, {"failure", "error", "skipped", "system-out"}),
    "failure": ({"type", "message"}, set()),
    "error": ({"type", "message"}, set()),
    "skipped": ({"type", "message"}, set()),
    "system-out": (set(), set()),
}


def rendered(results, tmp_path):
    junit.render(results, tmp_path / "junit.xml")
    return ElementTree.parse(tmp_path / "junit.xml").getroot()


@pytest.fixture(scope="module")
def root(results, tmp_path_factory):
    return rendered(results, tmp_path_factory.mktemp("junit"))


def case(root, suite, name):
    return root.find(f"testsuite[@name='{suite}']/testcase[@name='{name}']")


def test_elements_and_attributes_are_those_of_the_schema(root):
    for element in root.iter():
        attributes, children = ALLOWED[element.tag]
        assert set(element.attrib) <= attributes
        assert {child.tag for child in element} <= children
        if "time" in element.attrib:
            assert re.fullmatch(r"\d+\.\d{3}", element.get("time"))


def test_the_totals_are_the_sums(root):
    for suite in root:
        tags = Counter(child.tag for each in suite for child in each)
        assert int(suite.get("tests")) == len(suite)
        assert [int(suite.get(k)) for k in ("failures", "errors", "skipped")] == [
            tags["failure"],
            tags["error"],
            tags["skipped"],
        ]
    for total in ("tests", "failures", "errors"):
        assert int(root.get(total)) == sum(int(suite.get(total)) for suite in root)


def test_one_suite_for_each_scene_and_scheme_and_no_case_twice(root, results):
    pairs = {(cell["scene"], cell["engine"], cell["scheme"]) for cell in results["cells"]}
    assert len(root) == len({suite.get("name") for suite in root}) == len(pairs)
    names = [(each.get("classname"), each.get("name")) for each in root.iter("testcase")]
    assert len(set(names)) == len(names)
    assert all(classname.count(".") == 1 for classname, _ in names), "dots divide a class into packages"


def test_statuses_become_what_ci_systems_colour(root):
    failed = case(root, "pybullet reduced on heavy_top[moderate]", "truth of orientation").find("failure")
    assert failed.get("type") == "fail"
    assert failed.get("message").startswith("orientation: ")
    assert failed.text.count("fail at dt") == 5
    gone = case(root, "mujoco implicitfast on co2_chain[mixture]", "truth of orientation").find("failure")
    assert gone.get("message") == "The recorded deviation of 2.00e-02 rad is gone: remove its record."
    broken = case(root, "pybullet maximal on heavy_top[fast]", "run").find("error")
    assert broken.get("message") == 'left the finite numbers at t = 1.25 s: "qvel & qacc" <inf>'
    for suite in ("drake radau on heavy_top[fast]", "pybullet maximal on co2_chain[mixture]"):
        assert case(root, suite, "run").find("skipped") is not None
    known = case(root, "mujoco discrete on free_symmetric_top[oblate]", "truth of orientation")
    assert [child.tag for child in known] == ["system-out"]
    assert "recorded bound 3.5e-1 rad" in known[0].text
    assert len(case(root, "mujoco RK4 on heavy_top[fast]", "truth of orientation")) == 0


def test_names_do_not_change_with_the_steps(results, root, tmp_path):
    changed = copy.deepcopy(results)
    for cell in changed["cells"]:
        cell["dt"] *= 0.77
    for row in changed["work_precision"]:
        row["dt"] *= 0.77
    again = rendered(changed, tmp_path)
    assert [each.attrib for each in again.iter("testcase")] == [each.attrib for each in root.iter("testcase")]


def test_the_run_carries_the_timed_seconds_once_however_many_observables(root, results):
    suite = root.find("testsuite[@name='mujoco RK4 on heavy_top[fast]']")
    rows = {
        row["dt"]: row["seconds_median"]
        for row in results["work_precision"]
        if (row["scene"], row["scheme"]) == ("heavy_top[fast]", "RK4")
    }
    assert float(suite.get("time")) == pytest.approx(sum(rows.values()), abs=5e-4)
    assert sum(float(each.get("time")) for each in suite) == pytest.approx(float(suite.get("time")))


def test_no_character_makes_the_file_unreadable(results, tmp_path):
    changed = copy.deepcopy(results)
    for cell in changed["cells"]:
        cell["scene"] = cell["scene"] + " \x00\x1b\ud800\ufffe]]>"
        for verdict in cell["verdicts"]:
            verdict["message"] += '\x08<&"\n'
    changed["scenes"] = {}
    names = [suite.get("name") for suite in rendered(changed, tmp_path)]
    assert r"mujoco RK4 on heavy_top[fast] \x00\x1b\xd800\xfffe]]>" in names
