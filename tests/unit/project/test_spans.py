from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from meshforge.batch import IN_PROCESS
from meshforge.common import ProjectError, UsageError
from meshforge.geometry import (
    FinePiece,
    Floats,
    Ints,
    PieceEngine,
    decompose_finely,
    overlap_volume,
    volume_of_union,
)
from meshforge.label_model import SpanPosterior
from meshforge.labels import spans
from meshforge.project import PreparationResult, Project, SplitSettings, span_search, span_splits
from meshforge.symbolic import Label
from tests.unit.project.stools import PARTS, boxes, coarse, write_stool

SURE = 0.7  # two labelled assets do not make it surer


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("stools")
    for name, width, height in (("a", 0.2, 0.4), ("b", 0.22, 0.45), ("c", 0.18, 0.38)):
        parts = boxes(width, height)
        write_stool(folder / "assets", name, parts, parts if name != "c" else coarse(parts))
    project = Project.create(folder / "p", [folder / "assets/*.urdf"], vocabulary=("seat", "leg"))
    for name in ("a.urdf", "b.urdf"):
        names = [hull.name for hull in project.mesh(name).hulls]
        project.set_labels(name, dict(zip(names, PARTS, strict=True)))
    return folder


@pytest.fixture
def project(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    monkeypatch.setenv("MESHFORGE_CACHE", str(made / "cache"))
    shutil.copytree(made / "assets", tmp_path / "assets")
    shutil.copytree(made / "p", tmp_path / "p")
    return Project.open(tmp_path / "p")


def split(
    project: Project, *assets: str, sure: float = SURE, rebuild: bool = False, **more: object
) -> list[PreparationResult]:
    how = SplitSettings(sure, rebuild)
    return list(project.split_spanning(assets or None, how, execution=IN_PROCESS, **more))  # type: ignore[arg-type]


def files(project: Project) -> dict[str, bytes]:
    kept = (path for path in project.folder.rglob("*") if path.is_file() and ".meshforge" not in path.parts)
    return {str(path.relative_to(project.folder)): path.read_bytes() for path in kept}


def test_a_hull_that_spans_parts_is_split_and_its_parts_are_labelled(project: Project) -> None:
    before = project.mesh("c.urdf")
    spanning = before.hulls[0]
    results = split(project)
    assert [result.problems for result in results] == [(), (), ()]
    assert [len(result.made) for result in results] == [0, 0, 1], "hulls of one part stay"
    assert results[2].made[0].what == spanning.name
    mesh = project.mesh("c.urdf")
    parts = [hull for hull in mesh.hulls if hull.name in results[2].hulls]
    assert {hull.label for hull in parts} == {"seat", "leg"}
    assert {hull.source for hull in parts} == {"split"}
    own = boxes(0.18, 0.38)[:2]
    assert volume_of_union([part.shape for part in parts]) == pytest.approx(sum(one.volume for one in own), rel=1e-3), (
        "tight around seat and leg: what was between them is free"
    )
    assert volume_of_union([spanning.shape, *(part.shape for part in parts)]) == pytest.approx(spanning.volume)
    seat = max((hull for hull in parts if hull.label == "seat"), key=lambda hull: hull.volume)
    assert seat.aabb.max[2] == pytest.approx(spanning.aabb.max[2])


def test_the_status_names_the_hull_until_it_is_split(project: Project) -> None:
    assert not any(result.problems for result in project.list_spans(execution=IN_PROCESS)), "all could be looked at"
    (name,) = project.spans().assets["c.urdf"]
    told = [asset.spans for asset in project.status().assets]
    assert told[:2] == [{}, {}]
    assert told[2][name].startswith(f"{name} holds ")
    assert "seat" in told[2][name] and "leg" in told[2][name] and told[2][name].endswith("%")
    split(project)
    assert [asset.spans for asset in project.status().assets] == [{}, {}, {}]


def test_what_is_split_is_taken_back_to_the_last_byte(project: Project) -> None:
    before = files(project)
    split(project)
    assert files(project) != before
    project.unprepare("c.urdf")
    plan = {"preparation.json": project.layout.preparation_plan.read_bytes()}
    assert files(project) == before | plan, "what is to be done to new assets stays"


def test_a_dry_run_says_what_would_be_split_and_keeps_what_it_found(project: Project) -> None:
    before = files(project)
    results = split(project, dry_run=True)
    assert files(project) == before
    assert list(project.spans().assets) == ["c.urdf"], "for the status and the review"
    assert [len(result.planned) for result in results] == [0, 0, 1]
    assert [len(entry.made) for entry in results[2].planned] == [2]
    assert not any(result.made for result in results)


def test_the_same_parts_whatever_the_number_of_workers_and_once_more_nothing(project: Project, tmp_path: Path) -> None:
    shutil.copytree(tmp_path / "p", tmp_path / "q")
    split(project)
    other = Project.open(tmp_path / "q")
    list(other.split_spanning(how=SplitSettings(SURE)))
    assert files(project)["prepared/c.urdf/hulls.obj"] == files(other)["prepared/c.urdf/hulls.obj"]
    assert [result.made for result in split(project)] == [(), (), ()], "parts are of one label each"


@pytest.fixture
def engines(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The engine of each surface whose fine pieces are made."""
    used = list[str]()

    def note(vertices: Floats, faces: Ints, engine: PieceEngine, *, cache: Path) -> tuple[FinePiece, ...]:
        used.append(engine)
        return decompose_finely(vertices, faces, engine, cache=cache)

    monkeypatch.setattr(spans, "decompose_finely", note)
    return used


@pytest.mark.parametrize("rebuild", [False, True])
def test_another_engine_makes_the_fine_pieces_where_it_is_asked_for(
    project: Project, engines: list[str], rebuild: bool
) -> None:
    before, how = files(project), SplitSettings(SURE, rebuild, "vhacd")
    list(project.split_spanning(None, how, execution=IN_PROCESS))
    assert engines == ["vhacd"] * 3
    (step,) = project.preparation("c.urdf").steps
    assert step.settings["pieces"] == "vhacd" and "vhacdx" in step.software
    assert json.loads(project.layout.preparation_plan.read_text())["pieces"] == "vhacd"
    project.unprepare("c.urdf")
    assert files(project).keys() - {"preparation.json"} == before.keys()
    engines.clear()
    project.list_spans(execution=IN_PROCESS)
    assert engines == ["vhacd"] * 3, "the studio looks at the project by the same engine"
    engines.clear()
    split(project, dry_run=True)
    assert engines == ["coacd"] * 3, "pieces of another engine are not taken for its own"


def test_a_dry_run_by_another_engine_is_kept_for_the_review_alone(project: Project, engines: list[str]) -> None:
    before, how = files(project), SplitSettings(SURE, pieces="vhacd")
    list(project.split_spanning(None, how, dry_run=True, execution=IN_PROCESS))
    assert files(project) == before
    ((hull, line),) = project.spans().assets["c.urdf"].items()
    assert line.pieces == "vhacd"
    span_splits.split_as_found(project, "c.urdf", hull)
    (step,) = project.preparation("c.urdf").steps
    assert (step.settings["asked"], step.settings["pieces"]) == (True, "vhacd") and "vhacdx" in step.software


def test_only_named_assets_are_split(project: Project) -> None:
    assert [result.asset for result in split(project, "a.urdf")] == ["a.urdf"]
    assert len(project.mesh("c.urdf").hulls) == 4


def test_bad_input_is_named(project: Project, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"--min-confidence 1\.5: a probability is needed"):
        split(project, sure=1.5)
    with pytest.raises(ProjectError, match="nope"):
        split(project, "nope")
    bare = Project.create(tmp_path / "bare", [tmp_path / "assets/*.urdf"], vocabulary=("seat",))
    with pytest.raises(ProjectError, match="no hull has a label"):
        split(bare)


def test_a_hull_that_stands_for_nothing_is_named_and_left(project: Project, tmp_path: Path) -> None:
    parts = boxes(0.18, 0.38)
    far = parts[1]
    moved = type(far)(far.vertices + np.array([5.0, 0, 0]), far.faces)
    write_stool(tmp_path / "assets", "c", parts, [*parts, moved])
    (result,) = split(Project.open(project.folder), "c.urdf")
    assert result.made == ()
    assert any("stands for no surface: left as it is" in note for note in result.notes)


@pytest.mark.slow
def test_a_hull_that_spans_parts_is_split_where_no_asset_has_a_surface(tmp_path: Path) -> None:
    stools = (("a", 0.2, 0.4), ("b", 0.22, 0.45), ("c", 0.18, 0.38))
    for name, width, height in stools:
        parts = boxes(width, height)
        write_stool(tmp_path / "assets", name, None, parts if name != "c" else coarse(parts))
    project = Project.create(tmp_path / "p", [tmp_path / "assets/*.urdf"], vocabulary=("seat", "leg"))
    with pytest.raises(ProjectError, match="no hull has a label"):
        split(project)
    for name in ("a.urdf", "b.urdf"):
        project.set_labels(name, dict(zip([hull.name for hull in project.mesh(name).hulls], PARTS, strict=True)))
    before, spanning = files(project), project.mesh("c.urdf").hulls[0]
    results = split(project, sure=0.5)
    assert [len(result.made) for result in results] == [0, 0, 1], "hulls of one part stay"
    assert results[2].made[0].what == spanning.name and not results[2].notes
    made = [hull for hull in project.mesh("c.urdf").hulls if hull.name in results[2].hulls]
    assert {hull.label for hull in made} == {"seat", "leg"} and {hull.source for hull in made} == {"split"}
    union = volume_of_union([spanning.shape, *(hull.shape for hull in made)])
    assert union == pytest.approx(spanning.volume), "parts lie within the hull"
    for solid, label in zip(boxes(0.18, 0.38), ("seat", "leg"), strict=False):
        held = sum(overlap_volume(solid, hull.shape) for hull in made if hull.label == label)
        assert held > 0.6 * solid.volume, f"most of the {label} has its label"
    assert [asset.spans for asset in project.status().assets] == [{}, {}, {}]
    project.unprepare("c.urdf")
    plan = {"preparation.json": project.layout.preparation_plan.read_bytes()}
    assert files(project) == before | plan
    assert project.status().assets[2].spans[spanning.name].startswith(f"{spanning.name} holds ")


@pytest.mark.slow
def test_one_body_without_a_surface_is_judged_by_look_alikes(project: Project, tmp_path: Path) -> None:
    write_stool(tmp_path / "assets", "c", None, coarse(boxes(0.18, 0.38)))
    (result,) = split(Project.open(project.folder), "c.urdf", sure=0.5)
    assert len(result.made) == 1
    assert {hull.label for hull in project.mesh("c.urdf").hulls if hull.name in result.hulls} == {"seat", "leg"}


def test_a_hull_of_a_body_whose_surface_is_flat_is_named_and_left(project: Project, tmp_path: Path) -> None:
    path = write_stool(tmp_path / "assets", "c", boxes(0.18, 0.38), coarse(boxes(0.18, 0.38)))
    (path.parent / "c_seen.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (result,) = split(Project.open(project.folder), "c.urdf", sure=0.5)
    assert result.made == () and len([note for note in result.notes if "stands for no surface" in note]) == 4


def test_a_broken_asset_does_not_stop_the_others(project: Project, tmp_path: Path) -> None:
    (tmp_path / "assets/a.urdf").write_text("<robot")
    results = split(Project.open(project.folder))
    assert results[0].problems and len(results[2].made) == 1


def test_in_a_large_family_each_asset_is_looked_at_by_itself(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    together = [result.planned for result in split(project, dry_run=True)]
    monkeypatch.setattr(span_search, "MOST_TOGETHER", 0)
    monkeypatch.setattr(span_search, "find_spans", None)
    alone = split(project, dry_run=True)
    assert [len(result.planned) for result in alone] == [len(planned) for planned in together] == [0, 0, 1]
    assert alone[2].planned[0].told.startswith("base/h0 holds seat and leg, ")
    results = split(project)
    assert [len(result.made) for result in results] == [0, 0, 1]
    assert {project.mesh("c.urdf").hull_of(name).label for name in results[2].hulls} == {"seat", "leg"}
    assert project.spans().assets["c.urdf"]["base/h0"].told.startswith("base/h0 holds seat and leg, ")
    for asset in ("a.urdf", "b.urdf"):
        names = [hull.name for hull in project.mesh(asset).hulls]
        project.set_labels(asset, dict.fromkeys(names))
    with pytest.raises(ProjectError, match="no hull has a label"):
        split(project)


def test_propagation_leaves_what_the_surface_says_of_parts(project: Project) -> None:
    made = split(project)[2].hulls
    before = project.mesh("c.urdf")
    project.set_labels("c.urdf", dict.fromkeys(made))
    project.set_labels("c.urdf", dict.fromkeys(made, "leg"), source="split", confidence=0.3)
    project.label("propagate")
    after = project.mesh("c.urdf")
    assert all(after.hull_of(name).annotation == Label("leg", 0.3, "split") for name in made)
    others = [hull.name for hull in before.hulls if hull.name not in made]
    assert all(after.hull_of(name).source == "propagated" for name in others)


def rebuild(project: Project, *assets: str, dry_run: bool = False) -> list[PreparationResult]:
    return split(project, *assets, rebuild=True, dry_run=dry_run)


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
    assert json.loads(after.pop("preparation.json"))["rebuild"] is True, "what is to be done to new assets stays"
    assert after == before


def test_rebuilding_says_first_what_it_would_do_and_leaves_what_a_person_said_is_one_part(project: Project) -> None:
    before = files(project)
    (result,) = rebuild(project, "c.urdf", dry_run=True)
    assert (len(result.planned), sum(len(entry.made) for entry in result.planned)) == (4, 5)
    assert result.planned[1].told.startswith("base/h1, made anew with its body: "), "it spans no parts"
    assert files(project) == before
    span_splits.mark_as_one_part(project, "c.urdf", project.mesh("c.urdf").hulls[0].name)
    assert rebuild(project, "c.urdf")[0].made == ()


def test_labels_that_a_person_gave_stay_a_persons_when_a_body_is_rebuilt(project: Project) -> None:
    legs = project.mesh("c.urdf").hulls[1:]
    project.set_labels("c.urdf", {legs[0].name: "leg"})
    rebuild(project, "c.urdf")
    sources = {hull.name.split("#")[0]: hull.source for hull in project.mesh("c.urdf").hulls}
    assert sources[legs[0].name] == "user" and sources[legs[1].name] == "split"


@pytest.mark.slow
def test_a_surface_in_another_unit_does_not_count_and_is_named(project: Project) -> None:
    seen = project.path("c.urdf").with_name("c_seen.obj")
    points = [line.split() for line in seen.read_text().splitlines()]
    rows = [["v", *(f"{1000 * float(x):g}" for x in row[1:])] if row[0] == "v" else row for row in points]
    seen.write_text("\n".join(map(" ".join, rows)) + "\n")
    (_, _, found) = split(project, dry_run=True)
    assert found.notes[0].startswith("base: its surface is 1e+03 times the size of its hulls")
    assert all("by likeness" in line.told for line in project.spans().assets.get("c.urdf", {}).values())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "why"),
    [(None, "no such file"), ("", "the file is empty"), ("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "finite")],
)
def test_a_surface_that_cannot_be_read_is_named(project: Project, text: str | None, why: str) -> None:
    seen = project.path("c.urdf").with_name("c_seen.obj")
    seen.unlink() if text is None else seen.write_text(text)
    (_, _, found) = split(project, dry_run=True)
    assert "does not count: " in found.notes[0] and "c_seen.obj" in found.notes[0] and why in found.notes[0]


def test_a_hull_that_likely_spans_parts_is_told_with_two_labels_and_no_surer_than_it_is() -> None:
    span = spans.HullSpan("base", 0.8999, {"wall": 0.95, "handle": 0.04, "lid": 0.01})
    assert str(span) == "base holds wall and handle, 89%"
    assert str(replace(span, chance=0.9, shares={"wall": 0.5, "handle": 0.3, "lid": 0.2})).endswith(
        "wall, handle and lid, 90%"
    )


@pytest.mark.parametrize("rebuild", [False, True])
def test_what_a_split_made_is_not_split_again(project: Project, rebuild: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    split(project, rebuild=rebuild)
    before = files(project)
    monkeypatch.setattr(
        SpanPosterior, "chances_of", lambda self, mesh: np.full(len(self.assets[mesh].mesh.hulls), 0.99)
    )
    made = {name for result in split(project, "c.urdf", rebuild=rebuild, dry_run=True) for name in result.hulls}
    parts = {name for step in project.preparation("c.urdf").steps for entry in step.replaced for name in entry.made}
    assert parts and not made and not parts & project.spans().assets.get("c.urdf", {}).keys()
    assert files(project) == before
