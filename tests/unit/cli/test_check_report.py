"""`meshforge check --report`: every asset on the page, those that are wrong first."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cup_project import cup_urdf
from tests.cups import WHOLE
from tests.unit.batch.families import write_tables
from tests.unit.batch.pages import figures, kinds, names, opened, texts
from tests.unit.cli.in_process import Run

ODD = "<i>&.obj"


@pytest.fixture
def run(run: Run) -> Run:
    Path("mixed").mkdir()
    write_tables(Path("tables"), 1)
    Path("mixed/good.obj").write_text(Path("tables/table0/model.obj").read_text())
    Path("mixed/cup.urdf").write_text(cup_urdf(True, [WHOLE]))
    Path("mixed", ODD).write_text("v 1 2\n")
    return run


@pytest.mark.slow
def test_what_failed_comes_first_then_what_has_findings(run: Run) -> None:
    told = run("check", "mixed/*", "--fit", "--clearance", "--physics", "--report", "r.html", "--json")
    assert told.code == 1 and "report: r.html" in told.err
    assert len(told.out.splitlines()) == 3 and all(map(json.loads, told.out.splitlines()))
    page = opened("r.html")
    assert names(page) == [ODD, "cup.urdf", "good.obj"]
    assert kinds(page) == ["failed", "warnings", "clean"]
    assert figures(page) == {"assets": "3", "clean": "1", "warnings": "1", "failed": "1"}
    assert texts(page, "//h1") == ["Checks of mixed"]
    assert "Checked: legality, fit, clearance, physics." in texts(page, "//p")
    assert "a vertex needs three numbers" in texts(page, "//p[@class='error']")[0]
    assert "<i>" not in Path("r.html").read_text("utf-8")
    assert [len(card.xpath("./div//img")) for card in page.xpath("//article")] == [0, 1, 1]
    assert len(page.xpath("//figure")) == 3  # two heat maps and what is closed; an OBJ shows nothing
    assert any(line.startswith("fit: hulls stick out by") for line in texts(page, "//p[@class='note']"))


def test_an_asset_that_is_gone_by_then_is_told_without_a_picture(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("meshforge.batch.read_again", lambda readers: [None for _ in readers])
    assert run("check", "mixed/good.obj", "--report", "r.html").code == 0
    page = opened("r.html")
    assert kinds(page) == ["clean"] and page.xpath("//img") == []
    assert texts(page, "//article/p") == ["it cannot be read any more, so there is no picture"]


@pytest.mark.slow
def test_mended_assets_are_shown_before_and_after(run: Run) -> None:
    lathe = "".join(f"v {x} {y} {z}\n" for z in (0, 1) for x, y in ((k, k * k) for k in range(40)))
    Path("curved.obj").write_text(f"o curved\n{lathe}" + faces(40))
    words = ("check", "curved.obj", "--engine", "physx-gpu", "--fix", "--out", "out", "--report", "r.html")
    assert run(*words).code == 0
    page = opened("r.html")
    assert page.xpath("//article//img/@class") == ["before", "after", "changes"]
    assert any(note.startswith("fixed: ") for note in texts(page, "//article/p"))
    assert figures(page)["assets"] == "1" and texts(page, "//h1") == ["Checks of curved.obj"]


def faces(sides: int) -> str:
    """The faces of a prism over a convex polygon whose corners come first below, then above; counted from 1."""
    below = range(1, sides + 1)
    ring = [(a, b, b + sides, a + sides) for a, b in zip(below, [*below[1:], below[0]], strict=True)]
    ends = [tuple(reversed(below)), tuple(k + sides for k in below)]
    return "".join(f"f {' '.join(map(str, face))}\n" for face in (*ends, *ring))
