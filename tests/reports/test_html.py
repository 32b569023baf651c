"""The HTML report as a browser would take it: one file, whole, safe, and the same every time."""

import copy
import json
import re
from collections import Counter
from html.parser import HTMLParser
from urllib.parse import unquote

import pytest
from poinsot.reports import html
from poinsot.reports.digest import Digest
from poinsot.reports.plots import motion_figures
from poinsot.reports.verdict import Status
from poinsot.reports.wording import GLYPHS

VOID = {"meta", "wbr", "br", "link", "img", "input", "hr"}
NASTY = (
    "</script><script>alert(1)</script>\"'<img src=x onerror=alert(2)>{{ 7*7 }}\x00\x1b[31m\u2028\ud800&amp;"
)


class Page(HTMLParser):
    """Every tag with its attributes, in order; complains where tags do not nest."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.open, self.text, self.scripts = [], [], [], []
        self.feed(text)
        assert self.open == [], f"never closed: {self.open}"

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, f"{tag} closed at {self.getpos()}"

    def handle_data(self, data):
        (self.scripts if self.open[-1:] == ["script"] else self.text).append(data)

    def values(self, attribute):
        return [attributes[attribute] for _, attributes in self.tags if attribute in attributes]

    def words(self):
        return " ".join(" ".join(self.text).split())


def drawn(results, motions):
    columns = Digest(results).columns
    return {motion.scene.full_name: motion_figures(motion, columns) for motion in motions}


@pytest.fixture(scope="module")
def file(results, moved, tmp_path_factory):
    out = tmp_path_factory.mktemp("report") / "report.html"
    html.render(results, drawn(results, moved(tuple(results["scenes"]))), out)
    return out


@pytest.fixture(scope="module")
def page(file):
    return Page(file.read_text(encoding="utf-8"))


def rendered(results, tmp_path, motions=()):
    html.render(results, drawn(results, motions), tmp_path / "report.html")
    return (tmp_path / "report.html").read_text(encoding="utf-8")


def test_tags_nest_ids_are_unique_and_every_link_inside_leads_somewhere(page):
    ids = Counter(page.values("id"))
    assert max(ids.values()) == 1
    inside = [unquote(link[1:]) for link in page.values("href") if link.startswith("#")]
    assert len(inside) > 100
    assert set(inside) <= set(ids)


def test_nothing_is_loaded_from_anywhere(page, file):
    assert not {tag for tag, _ in page.tags} & {"link", "img", "iframe", "object", "embed", "base"}
    assert page.values("src") == []
    assert not [link for link in page.values("href") if not link.startswith(("#", "logs/"))]
    styles = re.findall(r"<style>(.*?)</style>", file.read_text(encoding="utf-8"), re.DOTALL)
    assert len(styles) == 1
    assert "url(" not in styles[0]
    assert "@import" not in styles[0]
    (policy,) = (a["content"] for tag, a in page.tags if a.get("http-equiv") == "Content-Security-Policy")
    assert policy.startswith("default-src 'none';")
    assert "http" not in policy


def test_the_plotting_library_is_in_the_file_once(page):
    assert sum("plotly.js v" in script[:200] for script in page.scripts) == 1


def test_the_matrix_has_every_scene_and_scheme_and_a_glyph_in_each_square(page, results):
    digest = Digest(results)
    squares = [a for tag, a in page.tags if tag == "td" and a.get("class", "").startswith("s-")]
    assert len(squares) == len(digest.groups) == 9 * 12
    by_class = Counter(a["class"].split()[0] for a in squares)
    assert by_class["s-error"] == by_class["s-fail"] == by_class["s-fixed"] == 1
    assert by_class["s-known"] == 2
    assert by_class["s-unavailable"] == 18
    titles = [a["title"] for tag, a in page.tags if tag == "a" and "title" in a]
    assert (
        "pybullet reduced on heavy_top[moderate]: fail; 5 cells, 47 checks: 5 fail, 5 unsupported, 37 pass"
        in titles
    )
    assert all(glyph in page.words() for glyph in GLYPHS.values())
    assert all(status.sentence in page.words() for status in Status)


def test_a_scene_that_was_not_run_in_a_scheme_is_an_empty_square_that_says_so(results, tmp_path):
    cells = [c for c in results["cells"] if (c["scene"], c["scheme"]) != ("heavy_top[fast]", "RK4")]
    page = Page(rendered({**results, "cells": cells}, tmp_path))
    empty = [a for tag, a in page.tags if tag == "td" and a.get("class", "").startswith("none")]
    assert [a["title"] for a in empty] == ["This scene was not run in this scheme."]


def test_every_verdict_is_there_with_its_numbers(page, results):
    words = page.words()
    for cell in results["cells"]:
        for verdict in cell["verdicts"]:
            if verdict["measured"] is not None:
                assert f"{verdict['measured']:.2e}" in words
            if cell["dt"] == 1e-3:
                assert verdict["message"] in words


def test_what_a_reader_must_know_is_there(page, results):
    words = page.words()
    for text in (
        "The run does not conform: 426 of 576 cells pass",
        "drake is not installed.",
        "hinges, gravity, collision shapes",
        "Landau & Lifshitz, Mechanics, § 33",
        "poinsot run --out out",
        "AMD EPYC 9B14",
        *results["notes"],
        "Error against run time",
        "order 4, twin name “RKMK4”, mujoco 4.0.0",
        "velocity limit none mujoco (every scheme)",
    ):
        assert text in words, text


def test_a_run_without_times_says_so(remade, tmp_path):
    words = Page(rendered(remade(timed=False), tmp_path)).words()
    assert "This scene was not timed" in words
    assert "Error against step" in words


def test_each_figure_carries_its_data(page):
    figures = [a for tag, a in page.tags if tag == "figure"]
    data = [json.loads(script) for script in page.scripts if script.startswith('{"t')]
    assert len(figures) == len(data) == 9 * 4
    assert not any("<" in script for script in page.scripts if script.startswith('{"t'))


def test_equal_input_gives_equal_bytes(results, moved, file, tmp_path):
    again = json.loads(json.dumps(results))
    html.render(again, drawn(results, moved(tuple(results["scenes"]))), tmp_path / "report.html")
    assert (tmp_path / "report.html").read_bytes() == file.read_bytes()


def _poisoned(part):
    """The same structure with something nasty in every text that is free to be anything."""
    if isinstance(part, dict):
        fixed = ("status", "schema", "at", "observable")
        return {key: value if key in fixed else _poisoned(value) for key, value in part.items()}
    if isinstance(part, list):
        return [_poisoned(value) for value in part]
    return part + NASTY if isinstance(part, str) and part else part


def test_no_text_gets_out_of_its_place(results, tmp_path):
    clean = Page(rendered(results, tmp_path))
    changed = _poisoned(results)
    changed["scenes"] = {name + NASTY: words for name, words in changed["scenes"].items()}
    text = rendered(changed, tmp_path)
    page = Page(text)
    # A name may break before each bracket, and NASTY has one.
    tags = [Counter(tag for tag, _ in each.tags if tag != "wbr") for each in (page, clean)]
    assert tags[0] == tags[1]
    assert {key for _, a in page.tags for key in a} == {key for _, a in clean.tags for key in a}
    assert "{{ 7*7 }}" in page.words()
    body = text[: text.index("plotly.js v")]
    assert not re.search("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\u2028\ud800]", body)
    assert r"\x1b[31m" in page.words(), "what cannot be shown is spelt out, not dropped"


def test_a_log_is_linked_beside_the_report_and_never_as_a_script(results, tmp_path):
    changed = copy.deepcopy(results)
    for cell in changed["cells"]:
        cell["log"] = cell["log"] and "javascript:alert(1)"
    links = Page(rendered(changed, tmp_path)).values("href")
    assert "javascript%3Aalert%281%29" in links
    assert not any(link.startswith("javascript:") for link in links)


def test_an_empty_run_still_has_a_report(results, tmp_path):
    empty = {**results, "cells": [], "scenes": {}, "work_precision": [], "notes": []}
    assert "Nothing was run: there are no cells to judge." in Page(rendered(empty, tmp_path)).words()


def test_a_large_run_stays_one_file_of_reasonable_size(remade, moved, tmp_path, results):
    names = tuple(f"scene_{n}[variant]" for n in range(35))
    text = rendered(remade(names), tmp_path, moved(names))
    library = max(len(script) for script in Page(text).scripts)
    # A message with attachments may have 25 MB; per scene and scheme the report spends about 12 kB.
    assert len(text.encode()) < 12e6
    assert (len(text) - library) / (35 * 12) < 14e3


def test_a_cheapest_configuration_that_may_not_be_one_says_so(remade, tmp_path):
    results = remade()
    for row in results["work_precision"]:
        row["error"] = 1e-3 if row["dt"] < 1e-3 else 1.0
    words = Page(rendered(results, tmp_path)).words()
    assert "What an error of orientation costs at the least" in words
    assert "coarsest step tried" not in words
    results["work_precision"] = [row for row in results["work_precision"] if row["error"] < 1]
    assert "at the coarsest step tried: a coarser one may do" in Page(rendered(results, tmp_path)).words()


def test_what_was_fitted_stands_beside_its_closed_form(remade, tmp_path):
    results = remade()
    rows = [row for row in results["work_precision"] if row["scene"] == "heavy_top[fast]"]
    rates = [
        row
        | {"observable": "precession", "unit": "rad/s", "exact": 0.5, "fitted": 0.5 + row["dt"]}
        | {"uncertainty": None if row["engine"] == "pinocchio" else 2e-7}
        for row in {(row["engine"], row["scheme"], row["dt"]): row for row in rows}.values()
    ]
    results["work_precision"] += rates
    results["scenes"]["heavy_top[fast]"] = {**results["scenes"]["heavy_top[fast]"], "dt": 1e-3}
    words = Page(rendered(results, tmp_path)).words()
    table = words[words.index("precession [rad/s]") :]
    assert "0.5000000000" in table
    assert "0.5010000000" in table  # at the scene's own step, 1e-3 s, and at no other
    assert "0.5020000000" not in table
    assert "± 2e-07" in table
    assert "± unknown" in table
    assert "+1.0e-03" in table
