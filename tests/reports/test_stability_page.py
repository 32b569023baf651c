"""The page of a sweep and the results behind it, made by hand so that every outcome and verdict occurs."""

import json
import math
import re
import xml.etree.ElementTree as ET

import pytest
from poinsot.adapters.runner import Failure
from poinsot.adapters.stable_step import StableStep
from poinsot.reports import stability, stability_map, stability_page, stability_results, stored
from poinsot.reports.outcomes import Found, Outcome
from poinsot.reports.stability_results import Sweep
from poinsot.reports.stored import ResultsError
from poinsot.reports.verdict import Status
from poinsot.scenarios.families import select

(SPRING,) = select(["stiff_spring"])
HOSTILE = "</text><script>alert(1)</script>\x1b"


def limit_of(value, twin="semi-implicit Euler"):
    scene = SPRING.scene(value)
    return scene.stable_step(scene, twin)


def made(*limits, twin="semi-implicit Euler", points=None):
    """Results of one sweep whose points run through all outcomes."""
    sweep = Sweep("stiff_spring", "alpha", "1.0", "own", twin)
    outcomes = list(Outcome)
    places = [(value, dt) for value in SPRING.values for dt in SPRING.steps] if points is None else points
    for k, place in enumerate(places):
        sweep.points[place] = Found(outcomes[k % len(outcomes)], 0.5, 2.0, 1.0, HOSTILE if k % 3 else "")
    sweep.limits.update(dict(zip(SPRING.values, limits, strict=False)))
    verdicts = [
        stability.verdict(f"stiff_spring[{value:g}]", sweep, 1e-3, found, limit_of(value, twin))
        for value, found in sweep.limits.items()
    ]
    return stability_results.results(
        [SPRING], [sweep], verdicts, {"command": "poinsot stability"}, ["a note"]
    )


GOOD = StableStep(0.1999, 0.2001)


@pytest.mark.parametrize(
    ("limits", "statuses", "code"),
    [
        ((GOOD,), ["pass"], 0),
        ((GOOD, StableStep(0.5, 0.51)), ["pass", "fail"], 1),
        ((GOOD, StableStep(1e3, math.inf)), ["pass", "fail"], 1),
        ((Failure("took too long", "time limit"),), ["error"], 3),
        ((), [], 0),
    ],
)
def test_verdicts_and_exit_codes(limits, statuses, code):
    found = made(*limits, points=[(100.0, 1e-6)])
    assert [verdict["status"] for verdict in found["verdicts"]] == statuses
    assert stability_results.exit_code(found) == code


def test_a_crash_ends_with_three():
    assert stability_results.exit_code(made(GOOD)) == 3


def test_results_come_back_from_the_file(tmp_path):
    found = made(GOOD, StableStep(1e3, math.inf))
    stored.write(tmp_path / "stability.json", found)
    back = stability_results.read(tmp_path / "stability.json")
    assert back == json.loads(json.dumps(found))
    assert back["schema"] == "poinsot.stability/1"
    (each,) = back["maps"]
    assert len(each["points"]) == len(SPRING.values) * len(SPRING.steps)
    assert each["limits"][1] == {"value": 1000.0, "held": 1e3, "grew": None}
    assert each["theory"][0] == {"value": 100.0, "limit": pytest.approx(0.2)}


@pytest.mark.parametrize("text", ["", "[]", '{"schema": "poinsot.stability/9"}'])
def test_other_files_are_refused(tmp_path, text):
    path = tmp_path / "stability.json"
    path.write_text(text)
    with pytest.raises(ResultsError, match=r"stability\.json"):
        stability_results.read(path)


@pytest.fixture
def page(tmp_path):
    stability_page.render(made(GOOD, StableStep(0.5, 0.51)), tmp_path / "page.html")
    return (tmp_path / "page.html").read_text(encoding="utf-8")


def test_page_asks_for_nothing_and_lets_nothing_in(page):
    assert not re.search(r"https?:|src=|@import|url\(", page)
    assert "<script" not in page
    assert "\x1b" not in page
    assert "default-src &#39;none&#39;" in page or "default-src 'none'" in page


def test_page_says_what_failed_and_what_lies_past_the_limit(page):
    assert "beyond what the scheme can do" in page
    assert "a note" in page
    for outcome in Outcome:
        assert outcome.value in page
        assert outcome.sentence[:20] in page
    assert "autoreset on" in page
    assert "Runs are cut short after 4000 steps" in page


def test_a_limit_says_what_the_halving_left_open(tmp_path, page):
    # (0.2001/0.1999)^½ − 1, and (0.51/0.5)^½ − 1 of the worse.
    assert stability.bracket(0.1999, 0.2001) == pytest.approx(5e-4, rel=1e-3)
    assert "± 1 %</td>" in page
    for limit in (StableStep(1e3, math.inf), StableStep(0.0, 0.1)):
        stability_page.render(made(limit, points=[(100.0, 1e-6)]), tmp_path / "other.html")
        row = (tmp_path / "other.html").read_text(encoding="utf-8").partition("<tbody>")[2]
        assert "±" not in row.partition("</tbody>")[0]


def test_signs_are_told_apart_by_glyph_and_by_colour():
    glyphs, colours = zip(*stability_map.SIGNS.values(), strict=True)
    assert len(set(glyphs)) == len(set(colours)) == len(Outcome)


def picture(found):
    return ET.fromstring(str(stability_map.picture(found["maps"][0], found["families"]["stiff_spring"])))


def test_map_shows_every_point_where_it_belongs():
    root = picture(made(GOOD))
    cells = root.findall("g")
    assert len(cells) == len(SPRING.values) * len(SPRING.steps)
    places = {(rect.get("x"), rect.get("y")) for rect in root.iter("rect")}
    assert len(places) == len(cells)
    # The smallest step is the lowest row, the smallest value the leftmost column.
    first = next(g for g in cells if g.find("title").text.startswith("100, dt 1e-06 s"))
    ys = [float(rect.get("y")) for rect in root.iter("rect")]
    assert float(first.find("rect").get("y")) == max(ys)
    assert float(first.find("rect").get("x")) == stability_map.LEFT


def test_what_was_cut_short_is_marked_and_says_how_much_of_its_scene_it_saw():
    found = made(GOOD)
    for point in found["maps"][0]["points"]:
        point["covered"] = 1.2e-4 if point["dt"] < 1e-4 else 1.0
    for cell in picture(found).findall("g"):
        title = cell.find("title").text
        cut = float(re.search(r"dt (\S+) s", title)[1]) < 1e-4
        assert ("after 0.00012 of its scene" in title) == cut
        # What grows or breaks off has done so, whatever the rest would have been.
        may_change = any(f": {each.value}," in title for each in (Outcome.ACCURATE, Outcome.BOUNDED))
        assert (cell.find("path") is not None) == (cut and may_change)


def test_theory_runs_between_the_steps_that_hold_and_those_that_do_not():
    found = made(GOOD)
    (line, _) = picture(found).iter("polyline")
    corners = [tuple(map(float, corner.split(","))) for corner in line.get("points").split()]
    rows = {
        float(re.search(r"dt (\S+) s", g.find("title").text)[1]): float(g.find("rect").get("y"))
        for g in picture(found).findall("g")
    }
    middle = stability_map.HEIGHT / 2
    for k, value in enumerate(SPRING.values):
        y = corners[2 * k][1]
        below = max(dt for dt in SPRING.steps if dt <= limit_of(value))
        above = min(dt for dt in SPRING.steps if dt > limit_of(value))
        assert rows[above] + middle < y <= rows[below] + middle + 0.1


def test_measured_limit_lies_on_theory_where_they_agree():
    root = picture(made(GOOD))
    (circle,) = root.iter("circle")
    line = next(root.iter("polyline")).get("points").split()[0]
    assert float(circle.get("cy")) == pytest.approx(float(line.split(",")[1]), abs=0.5)


@pytest.mark.parametrize("twin", ["discrete", "one's own"])
def test_no_line_where_theory_has_none(twin):
    root = picture(made(StableStep(1e3, math.inf), twin=twin))
    assert not list(root.iter("polyline"))
    assert not list(root.iter("circle"))


def test_status_of_a_limit_is_that_of_the_check():
    sweep = Sweep("stiff_spring", "alpha", "1.0", "own", "semi-implicit Euler")
    verdict = stability.verdict("stiff_spring[100]", sweep, 1e-3, GOOD, 0.2)
    assert (verdict.check, verdict.status, verdict.scene) == ("stability", Status.PASS, "stiff_spring[100]")


def test_where_theory_knows_no_limit_what_went_wrong_is_past_it(tmp_path):
    points = [(100.0, dt) for dt in SPRING.steps[: len(Outcome)]]
    stability_page.render(made(twin="one's own", points=points), tmp_path / "page.html")
    past = (tmp_path / "page.html").read_text(encoding="utf-8").partition('id="past"')[2]
    rows = past.partition("</table>")[0]
    for outcome in Outcome:
        fine = outcome in (Outcome.ACCURATE, Outcome.BOUNDED)
        assert (f" 1 {outcome.value}" in rows) != fine
