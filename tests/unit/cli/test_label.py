"""`meshforge label`: each source of labels, and what it says."""

import json
from pathlib import Path

import pytest

from meshforge.project import Project
from tests.unit.batch.families import label_of, table_boxes
from tests.unit.cli.in_process import Run
from tests.unit.labels.test_label_by_propagation import family

RIGHT = {name: {"misc": "crumb"}.get(label_of(name), label_of(name)) for name in table_boxes()}


@pytest.fixture
def run(run: Run, tmp_path: Path) -> Run:
    """Runs the command line beside a project `p` of three tables without labels."""
    family(tmp_path, 3, "top", "leg", "crumb")
    return run


@pytest.mark.slow
def test_propagate_says_where_to_begin_then_labels_the_rest_and_says_what_to_look_at(run: Run, tmp_path: Path) -> None:
    first = run("label", "p", "--with", "propagate")
    assert first.code == 2
    assert "there is no label that others could be taken from" in first.err
    asset = first.err.split("best ")[1].split()[0].rstrip(".")
    project = Project.open(tmp_path / "p")
    assert asset in project.assets()
    project.set_labels(asset, RIGHT)
    told = run("label", "p", "--with", "propagate")
    assert told.code == 0
    assert f"{asset}: 0 labels taken, 6 there already\n" in told.out
    assert told.out.count("6 labels taken") == 2
    assert told.out.splitlines()[-1].startswith("If some are wrong, label or correct this one next: t")


@pytest.mark.slow
def test_propagate_reports_as_json_a_line_an_asset(run: Run, tmp_path: Path) -> None:
    Project.open(tmp_path / "p").set_labels("t0.obj", RIGHT)
    told = run("label", "p", "--with", "propagate", "--json").out.splitlines()
    assert len(told) == 5
    assert all('"unsure": ' in line for line in told[:4])
    closing, last = map(json.loads, told[3:])
    assert last["next"] in ("t1.obj", "t2.obj")
    assert closing["labels"]["hulls"] == 3 * len(RIGHT)
    assert {share["source"] for share in closing["labels"]["shares"]} == {"user", "propagated"}


@pytest.mark.slow
def test_the_summary_counts_by_source_and_confidence(run: Run, tmp_path: Path) -> None:
    project = Project.open(tmp_path / "p")
    project.set_labels("t0.obj", {"top": "top"})
    project.set_labels("t1.obj", {"top": "top", "crumb": "leg"}, source="vlm", confidence=0.4)
    told = run("label", "p", "--with", "names")
    rows = [line.split() for line in told.out.splitlines()]
    assert ["people", "1", "0", "0"] in rows
    assert ["a", "model", "0", "0", "2"] in rows
    assert ["names", "0", "3", "0"] in rows
    assert ["no", "label", "12"] in rows


@pytest.mark.slow
def test_propagate_shows_what_it_would_carry_over(run: Run, tmp_path: Path) -> None:
    project = Project.open(tmp_path / "p")
    project.set_labels("t0.obj", RIGHT)
    shown = run("label", "p", "--with", "propagate", "--dry-run")
    assert shown.code == 0
    assert shown.out.endswith(
        "12 labels would be taken; 0 hulls left without one; 6 hulls would stay as they are. Nothing was written.\n"
    )
    assert [line.split()[:2] for line in shown.out.splitlines()[2:5]] == [
        ["top", "likeness"],
        ["leg", "likeness"],
        ["crumb", "likeness"],
    ]
    assert not project.labels("t1.obj").labels


@pytest.mark.slow
@pytest.mark.parametrize("source", ["file", "names", "propagate"])
def test_a_broken_asset_is_named_and_the_others_are_labelled(run: Run, tmp_path: Path, source: str) -> None:
    project = Project.open(tmp_path / "p")
    project.set_labels("t0.obj", RIGHT)
    (tmp_path / "assets/t1.obj").write_text("nothing of use")
    for name in ("t1", "t2"):
        (tmp_path / f"assets/{name}.labels.json").write_text('{"hulls": {"top": "top"}}')
    told = run("label", "p", "--with", source, "--workers", "2", "--timeout", "60", "--memory", "1")
    assert told.code == 1
    assert told.err == "3 assets (3 OBJ), 1 with labels\n"
    assert "t1.obj: 0 labels taken\n    left out: " in told.out
    assert project.labels("t2.obj").labels and not project.labels("t1.obj").labels


@pytest.mark.slow
def test_a_damaged_labels_file_costs_its_asset(run: Run, tmp_path: Path) -> None:
    (tmp_path / "assets/t0.labels.json").write_text("{")
    (tmp_path / "assets/t1.labels.json").write_text('{"hulls": {"top": "top"}}')
    told = run("label", "p", "--with", "file")
    assert told.code == 1
    assert f"t0.obj: 0 labels taken\n    left out: {tmp_path}/assets/t0.labels.json:1:2: the labels are no" in told.out
    assert "t1.obj: 1 label taken" in told.out
