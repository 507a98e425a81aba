"""`meshforge convert --to --report`: each asset as it was read and as it was written, those that failed first."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.unit.batch.pages import figures, kinds, names, opened, texts
from tests.unit.checks.test_examination import urdf
from tests.unit.cli.in_process import Run

ODD = "z <i>&.urdf"


@pytest.fixture
def run(run: Run) -> Run:
    """Runs the command line beside a folder of two cups and a damaged file."""
    Path("in").mkdir()
    for name, filled in (("a", False), ("b", True)):
        Path(f"in/{name}.urdf").write_text(urdf(filled))
    Path("in", ODD).write_text("<robot")
    return run


@pytest.mark.slow
def test_what_failed_comes_first_and_losses_are_told(run: Run) -> None:
    told = run("convert", "in/*", "out", "--to", "obj", "--report", "r.html", "--json")
    assert told.code == 1 and "report: r.html" in told.err
    assert [json.loads(line)["asset"] for line in told.out.splitlines()] == ["a.urdf", "b.urdf", ODD]
    page = opened("r.html")
    assert names(page) == [ODD, "a.urdf", "b.urdf"]
    assert kinds(page) == ["failed", "written", "written"]
    assert figures(page) == {"assets": "3", "written": "2", "failed": "1", "hulls": "6 → 6 no change"}
    assert texts(page, "//h1") == ["out as .obj"] and page.xpath("//section[@id='program']") == []
    assert [card.xpath(".//img/@class") for card in page.xpath("//article")] == [[], *[["before", "after"]] * 2]
    assert any(
        note == "1 box (cup/geom0) is written as triangles: OBJ has no boxes"
        for note in texts(page, "//article[3]//p[@class='note']")
    )
    assert page.xpath("//*[@data-mode]") == [] and len(page.xpath("//input[@id='every']")) == 1
    assert "<i>" not in Path("r.html").read_text("utf-8")


@pytest.mark.slow
def test_outputs_of_an_earlier_run_are_shown_again(run: Run) -> None:
    for _ in range(2):
        run("convert", "in", "out", "--to", "usda", "--report", "r.html")
    page = opened("r.html")
    assert kinds(page) == ["failed", "skipped", "skipped"]
    assert len(page.xpath("//article//img")) == 4


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (("in/a.urdf", "a.obj"), "--report says nothing without --to SUFFIX"),
        (("in", "out", "--to", "obj", "--dry-run"), "with --dry-run there is nothing to show"),
    ],
)
def test_a_report_that_makes_no_sense_is_refused(run: Run, words: tuple[str, ...], problem: str) -> None:
    told = run("convert", *words, "--report", "r.html")
    assert told.code == 2 and problem in told.err
    assert sorted(path.name for path in Path().iterdir()) == ["in"]
