"""Figures about hulls that span parts: counts by hand, and the surface of an asset. Alarms on the bundled families,
through a project: none with their labels, few without, and merged legs are found. Programs learned on meshes that are
rebuilt where hulls span: which are, who labels first, what is compared. Real assets decomposed as a whole: their hulls,
the surface that these stand for, and what is left out."""

from pathlib import Path

import numpy as np
import pytest

from benchmark.assets import samples
from benchmark.real.family import families, family
from benchmark.real.samples import make_sample
from benchmark.real.whole import REAL, list_hidden, list_whole, whole_sample
from benchmark.spanning.alarms import KNOWN, open_bundled, open_merged
from benchmark.spanning.course import HullChance
from benchmark.spanning.detection import Detection
from benchmark.spanning.family import choose_known, label_truly, make_pieces
from benchmark.spanning.programs import open_bench
from benchmark.spanning.real_assets import measure
from benchmark.spanning.sets import list_names, list_tasks, surface_of
from benchmark.study.client import TaskClient
from benchmark.study.project import SUFFIX, name_by_files, open_project
from benchmark.study.propagation import begin_by_hand
from benchmark.tasks import task
from meshforge.common import AssetError
from meshforge.geometry import volume_inside
from meshforge.symbolic import Label
from tests.corpus_path import corpus


def test_precision_and_recall_count_hulls() -> None:
    rows = [(0.8, True), (0.2, True), (0.2, True), (0.9, False)]
    found = Detection.of([HullChance("cup_01", number, *row) for number, row in enumerate(rows)])
    assert found.precision == pytest.approx(1 / 2)
    assert found.recall == pytest.approx(1 / 3)


@pytest.mark.parametrize(("setting", "most"), [("union", 1.01), ("welded", 1.5)])
def test_the_surface_holds_the_parts_in_the_box_of_the_hulls(setting: str, most: float) -> None:
    sample = samples("cup", True, (setting,))[0]
    points, faces = surface_of(sample)
    corners = np.concatenate([one.vertices for one in sample.mesh.hulls])
    assert np.allclose(points.min(axis=0), corners.min(axis=0), atol=2e-3)
    assert np.allclose(points.max(axis=0), corners.max(axis=0), atol=2e-3)
    volume = sum(part.solid.volume() for part in sample.asset.parts)
    inside = volume_inside(points, faces)
    assert inside and 0.9 * volume < inside < most * volume


@pytest.mark.parametrize(("family", "hulls"), [("tables", 587), pytest.param("chairs", 148, marks=pytest.mark.long)])
@pytest.mark.parametrize(("labelled", "most"), [(None, 0), (KNOWN, 3)])
def test_hulls_of_one_part_are_left(tmp_path: Path, family: str, hulls: int, labelled: int | None, most: int) -> None:
    case = open_bundled(tmp_path, family, labelled)
    meshes = [case.project.mesh(asset) for asset in case.project.assets()]
    assert sum(len(mesh.hulls) for mesh in meshes) == hulls
    assert case.find()[1] <= most


@pytest.mark.long
def test_of_seven_chairs_with_a_leg_merged_into_the_seat_six_are_found(tmp_path: Path) -> None:
    case = open_merged(tmp_path)
    assert len(case.project.assets()) == 10 and len(case.spanning) == 7
    found, others = case.find()
    assert found >= 6 and others <= 3


def test_a_session_begins_with_labels_by_hand_of_the_known_assets_and_those_of_split_parts() -> None:
    rows = samples("cup", False, ("coarse",))[:6]
    known = [rows[place].name for place in choose_known(6)]
    split = next(row for row in rows if row.name not in known)
    part = split.mesh.hulls[0].name
    told = Label("handle", 0.6, "rebuild")
    bench = name_by_files(open_bench(task("cup-medium"), [(row, {part: told} if row is split else {}) for row in rows]))
    with open_project(bench.desk("propagated", 0)) as project:
        by_hand, _ = begin_by_hand(TaskClient(project), bench, 3)
        meshes = dict(project.meshes_by_id())
    assert by_hand == {f"{name}{SUFFIX}" for name in known}
    parts = meshes[f"{split.name}{SUFFIX}"]
    assert parts.hull_of(part).annotation == told
    assert all(hull.source == "propagated" for hull in parts.hulls if hull.name != part)
    for name in by_hand:
        pairs = zip(meshes[name].hulls, bench.truth.meshes[name].hulls, strict=True)
        assert all(hull.label == true.label and hull.source == "user" for hull, true in pairs)


def test_without_the_corpus_one_message_says_what_to_set(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("MESHFORGE_CORPUS", str(tmp_path / "nowhere"))
    with pytest.raises(AssetError, match=r"real_assets: not run: no corpus is here\n.*MESHFORGE_CORPUS"):
        measure(lambda line: None, True)


def test_assets_that_show_nothing_are_left_out_and_named() -> None:
    for name in families():
        assert sorted([*list_whole(name), *list_hidden(name)]) == sorted(family(name).names)
    assert [name for name in families() if list_hidden(name)] == ["cups"]
    assert list_names("cups", REAL) == list(list_whole("cups"))
    assert [task.difficulty for task in list_tasks("cups", REAL)] == ["easy", "medium", "hard"]


def test_a_real_chair_is_decomposed_as_a_whole_in_the_frame_of_its_file() -> None:
    corpus()
    sample = whole_sample("chairs", "kaykit-armchair")
    separate = make_sample(family("chairs"), "kaykit-armchair", "coarse")
    assert separate
    corners, other = (np.concatenate([h.vertices for h in one.mesh.hulls]) for one in (sample, separate))
    points, faces = surface_of(sample)
    for low_or_high in ("min", "max"):
        of_file = getattr(points, low_or_high)(axis=0)
        assert np.allclose(getattr(corners, low_or_high)(axis=0), of_file, atol=2e-3)
        assert np.allclose(getattr(other, low_or_high)(axis=0), of_file, atol=2e-3)
    assert faces.max() < len(points)
    assert sum(purity < 0.9 for purity in sample.purities) > sum(purity < 0.9 for purity in separate.purities)
    pieces = [piece.shape for piece in make_pieces(sample)]
    assert set(label_truly(pieces, sample.asset)) == {part.label for part in sample.asset.parts}
