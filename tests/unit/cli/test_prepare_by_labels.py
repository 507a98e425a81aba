"""Projects whose assets are decomposed by segmented points beside them."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from meshforge.batch import IN_PROCESS
from meshforge.project import NewAssetOptions, Project
from tests.unit.cli.in_process import Run
from tests.unit.formats.test_segmented_parts import FACES, KINDS, MIDDLES, NAMES, VERTICES

URDF = """<robot name="table"><link name="base">
<collision><geometry><mesh filename="{name}.obj"/></geometry></collision>
<collision name="foot"><origin xyz="0 0 -0.4"/><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link></robot>
"""
VOXELS = ("--decompose", "vhacd", "--set", "resolution=3000", "--set", "max_convex_hulls=4", "--by", "labels")


def put(name: str, **arrays: object) -> None:
    """A URDF of the table and a box between its legs, and labelled points on the table."""
    rows = [*(f"v {x!r} {y!r} {z!r}" for x, y, z in VERTICES.tolist()), *(f"f {a} {b} {c}" for a, b, c in FACES + 1)]
    Path("in").mkdir(exist_ok=True)
    Path(f"in/{name}.obj").write_text("\n".join(rows) + "\n")
    Path(f"in/{name}.urdf").write_text(URDF.format(name=name))
    if arrays:
        np.savez(f"in/{name}.points.npz", **arrays)  # type: ignore[arg-type]


ANSWERS = {"points": MIDDLES, "labels": np.repeat(KINDS, 5), "names": NAMES}


@pytest.fixture
def run(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    monkeypatch.setenv("MESHFORGE_CACHE", str(tmp_path / "cache"))
    return run


def names_of(asset: str) -> set[str]:
    return {hull.name.partition("#")[0] for hull in Project.open("p").mesh(asset).hulls}


@pytest.mark.slow
def test_hulls_are_called_by_their_parts_labelled_by_the_same_file_and_new_assets_go_the_same_way(run: Run) -> None:
    put("a", **ANSWERS)
    told = run("new", "p", "in/a.urdf", "--vocabulary", "panel,leg", *VOXELS, "--workers", "1")
    assert told.code == 0, told.out + told.err
    assert names_of("a.urdf") == {"base/panel", "base/leg", "base/foot"}
    (step,) = json.loads(Path("p/prepared/a.urdf/preparation.json").read_text())["steps"]
    assert step["settings"]["by"] == "labels"
    assert run("label", "p", "--with", "file", "--workers", "1").code == 0
    mesh = Project.open("p").mesh("a.urdf")
    assert all(hull.label == hull.name[5:].partition("#")[0] for hull in mesh.hulls if "foot" not in hull.name)
    put("b", **ANSWERS)
    project = Project.open("p").add_assets(["in/b.urdf"])
    (result,) = project.prepare_new(NewAssetOptions(execution=IN_PROCESS))
    assert result.problem is None and names_of("b.urdf") == names_of("a.urdf")
    assert run("prepare", "p", "a.urdf", "--undo").code == 0
    assert names_of("a.urdf") == {"base/foot"}


def test_an_asset_without_labels_is_decomposed_as_a_whole_and_that_is_told(run: Run) -> None:
    put("a")
    told = run("new", "p", "in/a.urdf", *VOXELS, "--workers", "1")
    assert told.code == 0
    assert "no labels of points lie beside a.urdf; no parts are known, so it was decomposed as a whole" in told.out


def test_labels_that_do_not_fit_fail_the_asset_by_name_and_nothing_is_written(run: Run) -> None:
    put("a", **{**ANSWERS, "labels": KINDS})
    told = run("new", "p", "in/a.urdf", *VOXELS, "--workers", "1")
    assert told.code == 1
    assert "a.points.npz: it has " in told.out and f", but {len(KINDS):,} classes\n" in told.out
    assert not Path("p/prepared/a.urdf").exists() and Path("p/meshforge.toml").exists()
