"""Rebuilt bodies: which hulls are rebuilt and by what, and that no gap is left in the surface that hulls held."""

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from meshforge.batch import IN_PROCESS
from meshforge.common import ProjectError, UsageError
from meshforge.geometry import FinePiece, Floats, Ints, PieceEngine, decompose_finely
from meshforge.label_model import SpanPosterior
from meshforge.labels import spans
from meshforge.project import PreparationResult, Project, RebuildSettings
from meshforge.project.preparation_plan import find_new_assets
from meshforge.symbolic import Label, LabelSource
from tests.soups import merge_solids
from tests.surface_cover import sample_lost
from tests.unit.project.stools import PARTS, boxes, coarse, create_stools, write_stool

SURE = 0.7  # two labelled assets do not make it surer


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("stools")
    create_stools(folder, {"a": (0.2, 0.4), "b": (0.22, 0.45), "c": (0.18, 0.38)}, spanning="c")
    return folder


@pytest.fixture
def project(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    monkeypatch.setenv("MESHFORGE_CACHE", str(made / "cache"))
    shutil.copytree(made / "assets", tmp_path / "assets")
    shutil.copytree(made / "p", tmp_path / "p")
    return Project.open(tmp_path / "p")


def rebuild(project: Project, *assets: str, sure: float = SURE, **more: object) -> list[PreparationResult]:
    how = RebuildSettings(sure)
    return list(project.rebuild_spanning(assets or None, how, execution=IN_PROCESS, **more))  # type: ignore[arg-type]


def test_bodies_are_chosen_and_what_was_dismissed_is_not_found_again(project: Project) -> None:
    (found,) = (one for result in rebuild(project, dry_run=True) for one in result.found)
    assert (found.hull, found.body, found.labels) == ("base/h0", "base", ("seat", "leg"))
    before = files(project)
    assert not [one.made for one in rebuild(project, bodies={"c.urdf": ["lid"], "a.urdf": []}) if one.made]
    assert files(project) == before, "another body"
    project.dismiss_spanning({"c.urdf": ["base/h0"]})
    assert not [one.found for one in rebuild(project) if one.found]


def files(project: Project) -> dict[str, bytes]:
    kept = (path for path in project.folder.rglob("*") if path.is_file() and ".meshforge" not in path.parts)
    return {str(path.relative_to(project.folder)): path.read_bytes() for path in kept}


def test_the_same_parts_whatever_the_number_of_workers_and_once_more_nothing(project: Project, tmp_path: Path) -> None:
    shutil.copytree(tmp_path / "p", tmp_path / "q")
    rebuild(project)
    other = Project.open(tmp_path / "q")
    list(other.rebuild_spanning(how=RebuildSettings(SURE)))
    assert files(project)["prepared/c.urdf/hulls.obj"] == files(other)["prepared/c.urdf/hulls.obj"]
    assert [result.made for result in rebuild(project)] == [(), (), ()], "parts are of one label each"


@pytest.fixture
def engines(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The engine of each surface whose fine pieces are made."""
    used = list[str]()

    def note(vertices: Floats, faces: Ints, engine: PieceEngine, *, cache: Path) -> tuple[FinePiece, ...]:
        used.append(engine)
        return decompose_finely(vertices, faces, engine, cache=cache)

    monkeypatch.setattr(spans, "decompose_finely", note)
    return used


def test_bad_input_is_named(project: Project, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"--min-confidence 1\.5: a probability is needed"):
        rebuild(project, sure=1.5)
    with pytest.raises(ProjectError, match="nope"):
        rebuild(project, "nope")
    bare = Project.create(tmp_path / "bare", [tmp_path / "assets/*.urdf"], vocabulary=("seat",))
    with pytest.raises(ProjectError, match="no hull has a label"):
        rebuild(bare)


def test_a_hull_that_stands_for_nothing_is_named_and_left(project: Project, tmp_path: Path) -> None:
    parts = boxes(0.18, 0.38)
    far = parts[1]
    moved = type(far)(far.vertices + np.array([5.0, 0, 0]), far.faces)
    write_stool(tmp_path / "assets", "c", parts, [*parts, moved])
    (result,) = rebuild(Project.open(project.folder), "c.urdf")
    assert result.made == ()
    assert any("stands for no surface: left as it is" in note for note in result.notes)


def test_a_broken_asset_does_not_stop_the_others(project: Project, tmp_path: Path) -> None:
    (tmp_path / "assets/a.urdf").write_text("<robot")
    results = rebuild(Project.open(project.folder))
    assert results[0].problems and len(results[2].made) == 4


def test_propagation_leaves_what_the_surface_says_of_parts(project: Project) -> None:
    made = rebuild(project)[2].hulls
    project.set_labels("c.urdf", dict.fromkeys(made))
    project.set_labels("c.urdf", dict.fromkeys(made, "leg"), source="rebuild", confidence=0.3)
    project.label("propagate")
    after = project.mesh("c.urdf")
    assert all(after.hull_of(name).annotation == Label("leg", 0.3, "rebuild") for name in made)


def test_a_body_is_rebuilt_part_by_part_and_taken_back_to_the_last_byte(project: Project) -> None:
    before = files(project)
    results = rebuild(project)
    assert [result.problems for result in results] == [(), (), ()]
    assert [len(result.made) for result in results] == [0, 0, 4], "all hulls of the body, of that asset alone"
    mesh, parts = project.mesh("c.urdf"), boxes(0.18, 0.38)
    assert sorted(str(hull.label) for hull in mesh.hulls) == sorted(PARTS), "one hull a part"
    assert sorted(hull.volume for hull in mesh.hulls) == pytest.approx(sorted(part.volume for part in parts), rel=1e-3)
    project.unprepare("c.urdf")
    after = files(project)
    assert json.loads(after.pop("preparation.json"))["min_confidence"] == SURE, "what is done to new assets stays"
    assert after == before


def test_labels_that_a_person_gave_stay_a_persons_when_a_body_is_rebuilt(project: Project) -> None:
    legs = project.mesh("c.urdf").hulls[1:]
    project.set_labels("c.urdf", {legs[0].name: "leg"})
    rebuild(project, "c.urdf")
    sources = {hull.name.split("#")[0]: hull.source for hull in project.mesh("c.urdf").hulls}
    assert sources[legs[0].name] == "user" and sources[legs[1].name] == "rebuild"


@pytest.mark.slow
def test_a_surface_in_another_unit_does_not_count_and_is_named(project: Project) -> None:
    seen = project.path("c.urdf").with_name("c_seen.obj")
    points = [line.split() for line in seen.read_text().splitlines()]
    rows = [["v", *(f"{1000 * float(x):g}" for x in row[1:])] if row[0] == "v" else row for row in points]
    seen.write_text("\n".join(map(" ".join, rows)) + "\n")
    (_, _, found) = rebuild(project, dry_run=True)
    assert found.notes[0].startswith("base: its surface is 1e+03 times the size of its hulls")
    assert found.notes[1] == "no surface says which hulls of base span parts; cut them by hand: meshforge cut"
    assert not found.planned


def test_a_hull_that_likely_spans_parts_is_told_with_two_labels_and_no_surer_than_it_is() -> None:
    span = spans.HullSpan("base", "mug", 0.8999, {"wall": 0.95, "handle": 0.04, "lid": 0.01})
    assert str(span) == "base holds wall and handle, 89%"
    assert str(replace(span, chance=0.9, shares={"wall": 0.5, "handle": 0.3, "lid": 0.2})).endswith(
        "wall, handle and lid, 90%"
    )


def test_what_a_rebuild_made_is_not_rebuilt_again(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    rebuild(project)
    before = files(project)
    monkeypatch.setattr(
        SpanPosterior, "chances_of", lambda self, mesh: np.full(len(self.assets[mesh].mesh.hulls), 0.99)
    )
    (result,) = rebuild(project, "c.urdf")
    assert not result.made and not result.notes
    assert files(project).keys() == before.keys()


def test_what_is_less_sure_than_is_asked_for_is_named_and_left(project: Project) -> None:
    (result,) = rebuild(project, "c.urdf", sure=0.999)
    assert not result.made and result.notes[0].startswith("below 100%, left as they are: base/h0 holds seat and leg, ")


@pytest.mark.parametrize(("source", "left"), [("user", True), ("repair", True), ("file", True), ("name", False)])
def test_a_label_of_a_person_or_a_file_counts_and_a_name_does_not(
    project: Project, source: LabelSource, left: bool
) -> None:
    spanning = project.mesh("c.urdf").hulls[0]
    project.set_labels("c.urdf", {spanning.name: "seat"}, source=source)
    (result,) = rebuild(project, "c.urdf")
    assert bool(result.made) != left
    if not left:
        assert sorted(str(hull.label) for hull in project.mesh("c.urdf").hulls) == sorted(PARTS)


def test_nothing_is_said_where_a_person_labelled_all_hulls(project: Project, engines: list[str]) -> None:
    project.set_labels("c.urdf", dict.fromkeys(project.mesh("c.urdf").index, "leg"))
    assert [(one.made, one.notes, one.problems) for one in rebuild(project, sure=0.01)] == [((), (), ())] * 3


def test_a_project_with_splits_of_an_earlier_version_is_read_and_they_are_taken_back(project: Project) -> None:
    """Its preparation divides hulls, its plan says that they were split, and a hull was said to be one part."""
    before = project.mesh("c.urdf")
    rebuild(project, "c.urdf")
    after = project.mesh("c.urdf")
    path = project.layout.preparation("c.urdf") / "preparation.json"
    kept = json.loads(path.read_text())
    kept["steps"][0]["do"] = "divide"
    kept["steps"][0]["settings"] = {"sure": 0.9, "pieces": "coacd", "chances": {"base/h0": 0.95}}
    kept["steps"][0]["replaced"][1]["with_body"] = True
    path.write_text(json.dumps(kept))
    plan = {"split": ["a.urdf", "b.urdf"], "sure": 0.7, "rebuild": False, "pieces": "coacd", "only": []}
    project.layout.preparation_plan.write_text(json.dumps(plan))
    (project.folder / "single_parts.json").write_text('{"assets": {"c.urdf": {"base/h1": "00"}}}')
    opened = Project.open(project.folder)
    assert [str(hull) for hull in opened.mesh("c.urdf").hulls] == [str(hull) for hull in after.hulls]
    assert opened.status().assets[2].prepared == ("4 hulls divided into 5 hulls",)
    plans, unclear = find_new_assets(opened)
    assert unclear is None and plans["c.urdf"].rebuild == RebuildSettings(0.7)
    assert opened.unprepare("c.urdf").undone == ("4 hulls divided into 5 hulls",)
    assert list(opened.mesh("c.urdf").index) == list(before.index)


SIZES = {"a": (0.2, 0.4), "b": (0.22, 0.45), "c": (0.18, 0.5)}


def test_a_missing_hull_is_a_gap() -> None:
    parts = boxes(*SIZES["c"])
    lost = sample_lost(*merge_solids(parts), parts, parts[1:])
    assert len(lost) > 100
    assert np.all(lost[:, 2] > SIZES["c"][1] - 0.01), "of the seat"


@pytest.mark.slow
def test_stools_have_no_gap_where_hulls_that_span_parts_were(tmp_path: Path) -> None:
    project = create_stools(tmp_path, SIZES, spanning="c")
    parts = boxes(*SIZES["c"])
    assert list(project.rebuild_spanning(["c.urdf"], RebuildSettings(0.5)))
    after = [hull.shape for hull in project.mesh("c.urdf").hulls]
    before = coarse(parts)
    assert len(after) > len(before)
    assert not len(sample_lost(*merge_solids(parts), before, after))
