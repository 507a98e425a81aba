"""`meshforge label --report`: all assets in the colours of their labels, those with problems or doubts first."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from meshforge.project import Project
from tests.unit.batch.families import label_of, table_boxes, write_tables
from tests.unit.batch.pages import figures, kinds, names, opened, texts
from tests.unit.cli.in_process import Run

ODD = "<i>&.obj"


@pytest.fixture
def run(run: Run, tmp_path: Path) -> Run:
    """Runs the command line beside a project `p` of three tables: one labelled in a file, one with a label for a hull
    that is not there, one with nothing beside it; and of a damaged file."""
    write_tables(tmp_path / "tables", 3)
    for beside in tmp_path.glob("tables/*/*.labels.json"):
        beside.unlink()
    (tmp_path / "tables" / ODD).write_text("v 1 2\n")
    Project.create(tmp_path / "p", [tmp_path / "tables"], vocabulary=("top", "leg", "misc"))
    for k, said in enumerate(({name: label_of(name) for name in table_boxes()}, {"nope": "leg"})):
        (tmp_path / f"tables/table{k}/model.labels.json").write_text(json.dumps({"hulls": said}))
    return run


def cards(page: Any) -> dict[str, list[str]]:
    """What the page says of each asset."""
    return dict(zip(names(page), (texts(card, ".//p") for card in page.xpath("//article")), strict=True))


@pytest.mark.slow
def test_labels_of_files_with_problems_and_doubts_first(run: Run) -> None:
    told = run("label", "p", "--with", "file", "--report", "r.html")
    assert told.code == 1 and "report: r.html" in told.err
    page = opened("r.html")
    assert kinds(page) == ["problems", "problems", "doubtful", "labelled"]
    said = cards(page)
    wrong, damaged, bare, labelled = said
    assert damaged.endswith(ODD) and "a vertex needs three numbers" in said[damaged][0]
    assert said[wrong][0].startswith("there is no hull 'nope'") and said[wrong][1].startswith("0 labels taken")
    assert said[bare][0].startswith("given no labels this time, ")
    assert said[labelled][0].endswith("labels taken")
    top = figures(page)
    assert {name: top[name] for name in ("assets", "labelled", "doubtful", "problems")} == {
        "assets": "4",
        "labelled": "1",
        "doubtful": "1",
        "problems": "2",
    }
    assert top["hulls"] == str(int(top["labels taken"]) + int(top["without a label"]))
    assert texts(page, "//h1") == ["Labels of p"]
    assert [len(card.xpath(".//img")) for card in page.xpath("//article")] == [1, 0, 1, 1]
    assert "<i>" not in Path("r.html").read_text("utf-8")


@pytest.mark.slow
def test_carried_labels_are_shown_with_what_is_unsure(run: Run) -> None:
    run("label", "p", "--with", "file")
    told = run("label", "p", "--with", "propagate", "--report", "r.html", "--json")
    lines = {line["asset"]: line for line in map(json.loads, told.out.splitlines()) if "asset" in line}
    page = opened("r.html")
    assert "The labels that there are, propagated to all other hulls" in texts(page, "//header/p")[0]
    taken = sum(line["taken"] for line in lines.values())
    assert taken and figures(page)["labels taken"] == str(taken)
    assert "without a label" not in figures(page)
    unsure = sum(line["unsure"] for line in lines.values())
    assert figures(page).get("unsure", "0") == str(unsure)
    assert ("hatched: an unsure label" in texts(page, "//ul[@class='legend']/li")) == bool(unsure)


def test_a_dry_run_has_nothing_to_show(run: Run) -> None:
    told = run("label", "p", "--dry-run", "--report", "r.html")
    assert told.code == 2 and "with --dry-run there is nothing to show" in told.err
