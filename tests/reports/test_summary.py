"""The Markdown summary: tables that are tables, in text that cannot break them."""

import copy
import re

import pytest
from poinsot.reports import summary
from poinsot.reports.digest import Digest
from poinsot.reports.findings import findings


def rendered(results, tmp_path):
    summary.render(results, tmp_path / "summary.md")
    return (tmp_path / "summary.md").read_text(encoding="utf-8")


def tables(text):
    """Each table as rows of cells, with the last heading before it."""
    found, heading = [], ""
    for line in text.splitlines():
        heading = line if line.startswith("#") else heading
        if line.startswith("|"):
            if not found or found[-1][0] != heading:
                found.append((heading, []))
            found[-1][1].append([cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]])
    return found


@pytest.fixture(scope="module")
def text(results, tmp_path_factory):
    return rendered(results, tmp_path_factory.mktemp("summary"))


def test_tables_are_rectangular_and_each_has_its_title(text):
    titles = [title for title, _ in tables(text)]
    assert titles == [
        "## Scenes × engine schemes: the worst status over every step and check",
        "## Environment: versions and machine",
    ]
    for _, rows in tables(text):
        assert len({len(row) for row in rows}) == 1
        assert set("".join(rows[1])) == {"-"}


def test_the_matrix_says_what_each_scene_did_in_each_scheme(text, results):
    (_, (head, _, *rows)), _ = tables(text)
    marks = {row[0]: dict(zip(head[1:], row[1:], strict=True)) for row in rows}
    assert list(marks) == list(results["scenes"])
    assert "6 pybullet reduced, 7 pybullet maximal" in text
    assert (marks["heavy_top[moderate]"]["6"], marks["heavy_top[fast]"]["7"]) == ("✗", "E")
    assert (marks["heavy_top[fast]"]["6"], marks["heavy_top[fast]"]["4"]) == ("(✓)", "✓")
    assert (marks["co2_chain[mixture]"]["3"], marks["co2_chain[mixture]"]["7"]) == ("!", "–")
    assert (
        marks["free_symmetric_top[oblate]"]["5"],
        marks["tides" if "tides" in marks else "heavy_top[fast]"]["11"],
    ) == ("K", "?")


def test_columns_stand_under_each_other_in_a_terminal(text):
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    lengths = {len(line) for line in lines if "✓" in line or "---" in line}
    assert len(lengths) == 2, "the two tables, each of one width"


def test_every_finding_note_and_fact_is_there(text, results):
    plain = text.replace("\\", "")
    for finding in findings(Digest(results)):
        assert f"- **{finding.where}**" in plain
        assert finding.sentence in plain
        assert finding.numbers in plain
    for word in (*results["notes"], "AMD EPYC 9B14", "4.0.0", "poinsot run --out out", "48.7 s"):
        assert word in plain


def test_no_text_breaks_a_table_or_becomes_markup(results, tmp_path):
    nasty = "a|b\n# c *d* `e` <script> [f](g) \x1b[31m&lt;"
    changed = copy.deepcopy(results)
    changed["environment"]["cpu"] = nasty
    changed["notes"] = [nasty]
    for cell in changed["cells"]:
        cell["message"] = cell["message"] and nasty
    text = rendered(changed, tmp_path)
    for _, rows in tables(text):
        assert len({len(row) for row in rows}) == 1
    assert not re.search(r"(?<!\\)<script|(?<!\\)`e|[^\\]\]\(g|(?<!\\)&lt;|\x1b", text)
    assert r"- a\|b # c \*d\* \`e\` \<script> [f\](g) \\x1b[31m\&lt;" in text


def test_a_large_run_fits_a_comment(remade, tmp_path):
    text = rendered(remade(tuple(f"scene_{n}[variant]" for n in range(35))), tmp_path)
    # GitHub takes 65536 characters.
    assert len(text) < 65536 / 2


def test_a_clean_run_says_so(remade, tmp_path):
    changed = remade()
    changed["cells"] = [cell for cell in changed["cells"] if cell["scheme"] == "RK4"]
    text = rendered({**changed, "notes": []}, tmp_path)
    assert "**The run conforms: all 54 cells pass.**" in text
    assert "Every cell passes, and so does every check." in text
