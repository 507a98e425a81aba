"""The bundled tables from nothing to usable labels, in each of the ways, from the command line."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from meshforge.formats import read
from meshforge.project import Project
from meshforge.samples import TABLES
from meshforge.symbolic import read_labels
from tests.loop.command import meshforge_here as meshforge
from tests.loopback import KEY, Asked, labels_as_json, serving, sometimes

VOCABULARY = ("panel", "leg", "handle", "drawer", "misc")
TRUTH = {
    path.name: {name: label.name for name, label in read_labels(path.with_suffix(".labels.json")).labels.items()}
    for path in sorted(TABLES.glob("*.obj"))
}
CALLED = {
    "panel": "TableTop_{}",
    "leg": "Leg.{:03}",
    "handle": "drawer_handle-{}",
    "drawer": "Drawer{}",
    "misc": "bolt_{}",
}
"""What somebody may have called the parts."""
DENSITY = 60  # points for each hull
KEPT = "tables"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with the tables in `assets`, and nothing that says what their hulls are."""
    (tmp_path / "assets").mkdir()
    for name in TRUTH:
        shutil.copy(TABLES / name, tmp_path / "assets")
    return tmp_path


def begin(folder: Path) -> Project:
    meshforge("new", KEPT, "assets/*.obj", "--vocabulary", ",".join(VOCABULARY), cwd=folder)
    return Project.open(folder / KEPT)


def right(project: Project) -> float:
    """The share of all hulls whose label is the true one."""
    found = {asset: project.labels(asset).labels for asset in TRUTH}
    same = [
        name in found[asset] and found[asset][name].name == label
        for asset, truth in TRUTH.items()
        for name, label in truth.items()
    ]
    return sum(same) / len(same)


def test_segmented_points_make_labels_of_hulls(folder: Path) -> None:
    """As a segmentation of point clouds would give them: numbers of classes, one point in ten wrong."""
    project, draw = begin(folder), np.random.default_rng(7)
    for name, truth in TRUTH.items():
        points, classes = [], []
        for geom in read(folder / "assets" / name).geoms:
            assert geom.shape is not None
            corners = geom.shape.vertices[geom.shape.faces[draw.integers(len(geom.shape.faces), size=DENSITY)]]
            points.append(np.einsum("ij,ijk->ik", draw.dirichlet((1, 1, 1), DENSITY), corners))
            classes += [VOCABULARY.index(truth[geom.name])] * DENSITY
        said = np.where(draw.random(len(classes)) < 0.1, draw.integers(len(VOCABULARY), size=len(classes)), classes)
        np.savez(folder / "assets" / name.replace(".obj", ".points.npz"), points=np.concatenate(points), labels=said)
    meshforge("label", KEPT, "--with", "file", "--classes", "vocabulary", cwd=folder)
    assert right(project) >= 0.97


def test_names_are_read(folder: Path) -> None:
    """The hulls have the names of parts here; two kinds are called otherwise than in the vocabulary."""
    for name, truth in TRUTH.items():
        path = folder / "assets" / name
        lines = path.read_text().splitlines(keepends=True)
        for k, (hull, label) in enumerate(truth.items()):
            lines[lines.index(f"o {hull}\n")] = f"o {CALLED[label].format(k)}\n"
        path.write_text("".join(lines))
    project = begin(folder)
    patterns = ("--pattern", "bolt*=misc", "--pattern", "*top*=panel")
    shown = meshforge("label", KEPT, "--with", "names", *patterns, "--dry-run", cwd=folder)
    assert "Nothing was written" in shown.out
    assert not any(project.labels(asset).labels for asset in TRUTH)
    meshforge("label", KEPT, "--with", "names", *patterns, cwd=folder)
    found = {asset: [label.name for label in project.labels(asset).labels.values()] for asset in TRUTH}
    assert found == {asset: list(truth.values()) for asset, truth in TRUTH.items()}


def test_two_tables_by_hand_label_the_rest(folder: Path) -> None:
    """Those that are advised, one after the other."""
    project, shares = begin(folder), []
    told = meshforge("label", KEPT, "--with", "propagate", cwd=folder, code=2).err
    for _ in range(2):
        advised = re.findall(r"table_\d\d\.obj", told)[-1]
        project.set_labels(advised, TRUTH[advised])
        told = meshforge("label", KEPT, "--with", "propagate", cwd=folder).out
        shares.append(right(project))
    assert shares[0] >= 0.78  # a small one, since it tells most a second
    assert shares[1] >= 0.92


def test_a_model_that_often_fails_labels_all(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One that is right, behind a server of which every fifth answer is a fault; it is asked about exemplars."""

    def answer(asked: Asked) -> str:
        hulls = {number: asked.hulls[number] for number in asked.numbers}
        return labels_as_json({number: TRUTH[asset][hull] for number, (asset, hull) in hulls.items()})

    monkeypatch.setenv("LOOPBACK_API_KEY", KEY)
    project = begin(folder)
    with serving(answer, fault=sometimes(0.2)) as server:
        with project.layout.settings.open("a") as file:
            file.write('\n[vlm]\nkey_env = "LOOPBACK_API_KEY"\nnames = true\nsize = 256\n')
        where = ("--base-url", server.base_url, "--model", server.model)
        planned = meshforge("label", KEPT, "--with", "vlm", *where, "--dry-run", cwd=folder)
        assert server.asked == []
        assert "14 assets" in planned.out
        meshforge("label", KEPT, "--with", "vlm", *where, cwd=folder)
        assert right(project) >= 0.97
        sent = len(server.asked)
        assert sum(whole for _, _, whole in server.asked) <= 8
        meshforge("label", KEPT, "--with", "vlm", *where, cwd=folder)
        assert len(server.asked) == sent
