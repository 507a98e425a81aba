"""Contact sheets of labelled assets, and the counts beside them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from meshforge.labels import SourceTally
from meshforge.labels.summary import PER_SHEET
from meshforge.project import Project
from meshforge.rendering import label_colors
from tests.unit.batch.families import label_of, table_boxes
from tests.unit.labels.test_label_by_propagation import family

NAMES = tuple(table_boxes())


@pytest.mark.slow
def test_sheets_hold_all_assets_that_can_be_drawn_and_replace_older_ones(tmp_path: Path) -> None:
    project = family(tmp_path, 2)
    (tmp_path / "assets/t1.obj").write_text("nothing of use")
    out = tmp_path / "sheets"
    out.mkdir()
    (out / "labels-007.png").write_bytes(b"old")
    (out / "mine.png").write_bytes(b"mine")
    many = ["t0.obj"] * (PER_SHEET + 1)
    written = project.draw_labels(out, [*many, "t1.obj"])
    assert [path.name for path in written] == ["labels-001.png", "labels-002.png"]
    assert sorted(path.name for path in out.iterdir()) == ["labels-001.png", "labels-002.png", "mine.png"]
    assert project.draw_labels(out, many[:1]) == (out / "labels-001.png",)
    assert project.draw_labels(out, []) == ()


def test_hulls_have_the_colours_of_their_labels(tmp_path: Path) -> None:
    project = family(tmp_path, 1)
    project.set_labels("t0.obj", {name: label_of(name) for name in NAMES})
    (path,) = project.draw_labels(tmp_path, ["t0.obj"])
    with Image.open(path) as picture:
        seen = np.asarray(picture.convert("RGB")).astype(int)[:240]
    wanted = [label_colors(project.vocabulary)[label] for label in ("top", "leg")]
    for color in wanted:
        hue = np.array([int(color[k : k + 2], 16) for k in (1, 3, 5)])
        shaded = seen @ hue / (np.linalg.norm(seen, axis=2) * np.linalg.norm(hue) + 1e-9)
        assert (shaded > 0.995).sum() > 100


def test_labels_are_counted_by_source_and_confidence(tmp_path: Path) -> None:
    project = family(tmp_path, 3)
    project.set_labels("t0.obj", {"top": "top", "crumb": "misc"})
    project.set_labels("t1.obj", {"top": "top"}, source="vlm", confidence=0.95)
    project.set_labels("t1.obj", {"crumb": "leg"}, source="vlm", confidence=0.49)
    (tmp_path / "assets/t2.obj").write_text("nothing of use")
    found = Project.open(tmp_path / "p").tally_labels()
    assert found.shares == (SourceTally("vlm", 1, 0, 1), SourceTally("user", 2, 0, 0))
    assert (found.hulls, found.unlabelled) == (2 * len(NAMES), 2 * len(NAMES) - 4)
    assert found.doubtful == (("t1.obj", len(NAMES) - 1), ("t0.obj", len(NAMES) - 2))


def test_an_empty_project_of_labels_has_nothing_but_bare_hulls(tmp_path: Path) -> None:
    found = family(tmp_path, 1).tally_labels()
    assert found.shares == ()
    assert found.unlabelled == found.hulls == len(NAMES)
