import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from meshforge.batch import IN_PROCESS, ExecutionOptions, read_preparation
from meshforge.common import format_share
from meshforge.geometry import volume_of_union
from meshforge.labels.spans import FinePieces, find_pieces
from meshforge.language import Program
from meshforge.project import (
    NewAsset,
    NewAssetOptions,
    NewAssetResult,
    Project,
    RebuildSettings,
    prepare_new_assets,
    read_preparation_plan,
)
from meshforge.store.sign_off import SignOff, SignOffBasis
from meshforge.symbolic import Label, read_labels
from tests.unit.batch.families import tree
from tests.unit.project.stools import PARTS, boxes, coarse, create_stools, write_stool


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project of two labelled stools, whose bodies were looked at; and two new stools that have one each."""
    folder = tmp_path_factory.mktemp("stools")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("MESHFORGE_CACHE", str(folder / "cache"))
        project = create_stools(folder, {"a": (0.2, 0.4), "b": (0.22, 0.4)}, spanning="")
        for name, width in (("c", 0.18), ("d", 0.21)):
            parts = boxes(width, 0.4)
            write_stool(folder / "new", name, parts, coarse(parts))
        list(project.rebuild_spanning(how=RebuildSettings(0.7), execution=IN_PROCESS))
    return folder


@pytest.fixture
def folder(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("MESHFORGE_CACHE", str(made / "cache"))
    for name in ("assets", "new", "p"):
        shutil.copytree(made / name, tmp_path / name)
    return tmp_path


def prepare(
    folder: Path, names: Sequence[str] = ("c.urdf", "d.urdf"), to: str = "aside", **options: object
) -> dict[str, NewAssetResult]:
    project = Project.open(folder / "p")
    plan = read_preparation_plan(project)
    new = [NewAsset(name, folder / "new" / name, plan) for name in names]
    given = NewAssetOptions(**{"execution": IN_PROCESS, **options})  # type: ignore[arg-type]
    return {work.id: result for work, result in prepare_new_assets(project, new, folder / to, given)}


def test_a_new_body_with_a_hull_that_spans_parts_is_rebuilt_and_labelled(folder: Path) -> None:
    before = tree(folder / "new"), tree(folder / "p")
    found = prepare(folder)
    assert (tree(folder / "new"), tree(folder / "p")) == before, "neither the project nor the source is written"
    (rebuilt,) = found["c.urdf"].rebuilt
    assert [span.hull for span in rebuilt.spans] == ["base/h0"] and rebuilt.chance > 0.7
    assert str(rebuilt).startswith(f"base/h0 holds seat and leg, {format_share(rebuilt.chance)}: base rebuilt into ")
    labels = read_labels(folder / "aside/labels/c.urdf.json").labels
    assert [label.name for label in labels.values()].count("seat") == 1 and len(labels) == 5
    assert {label.source for label in labels.values()} == {"rebuild"}, "no guess passes for a fact"
    kept = read_preparation(folder / "aside/prepared/c.urdf")
    assert kept is not None and [step.do for step in kept.steps] == ["rebuild"]
    assert kept.steps[0].settings["rebuilt"] == ["base"]
    parts = boxes(0.18, 0.4)
    assert volume_of_union(list(kept.hulls.values())) == pytest.approx(sum(one.volume for one in parts), rel=1e-3)


def test_what_was_guessed_is_no_surer_than_the_guess(folder: Path) -> None:
    found = prepare(folder)["c.urdf"]
    least = min(found.rebuilt[0].chance, *(label.confidence for label in found.new_labels.values()))
    assert found.probability == pytest.approx(least) and found.probability < 1
    left = prepare(folder, rebuild=False)["c.urdf"]
    assert left.probability == pytest.approx(1 - left.spanning[0].chance), "what likely spans parts is likely wrong"


@pytest.mark.slow
def test_the_same_alone_and_together_here_and_in_workers(folder: Path) -> None:
    prepare(folder)
    prepare(folder, ["d.urdf"], "alone")
    prepare(folder, ["d.urdf", "c.urdf"], "workers", execution=ExecutionOptions(workers=2))
    together, workers = tree(folder / "aside"), tree(folder / "workers")
    assert len(together) == 6 and workers == together
    assert tree(folder / "alone") == {name: one for name, one in together.items() if "d.urdf" in str(name)}


def test_labels_that_a_new_asset_has_stay(folder: Path) -> None:
    project = Project.open(folder / "p")
    path = folder / "new/c.labels.json"
    path.write_text('{"vocabulary": ["seat", "leg"], "hulls": {"base/h1": "seat"}}')
    new = NewAsset("c.urdf", folder / "new/c.urdf", read_preparation_plan(project), path)
    options = NewAssetOptions(rebuild=False, execution=IN_PROCESS)
    ((work, found),) = prepare_new_assets(project, [new], folder / "aside", options)
    assert "base/h1" not in found.guesses and work.labels is not None
    assert read_labels(work.labels).labels["base/h1"] == Label("seat", 1.0, "file")


def test_an_asset_that_cannot_be_read_does_not_stop_the_others(folder: Path) -> None:
    (folder / "new/c.urdf").write_text("<robot")
    found = prepare(folder)
    assert found["c.urdf"].problem and "c.urdf" in found["c.urdf"].problem
    assert len(found["d.urdf"].rebuilt) == 1


@pytest.mark.slow
def test_without_a_surface_a_note_says_so_and_without_a_label_nothing_is_looked_for(folder: Path) -> None:
    text = (folder / "new/c.urdf").read_text()
    start, end = text.index("<visual>"), text.index("</visual>") + len("</visual>")
    (folder / "new/c.urdf").write_text(text[:start] + text[end:])
    found = prepare(folder, ["c.urdf"])["c.urdf"]
    assert found.notes == ("no surface says which hulls of base span parts; cut them by hand: meshforge cut",)
    shutil.rmtree(folder / "p/labels")
    assert prepare(folder, ["d.urdf"])["d.urdf"].notes == (
        "no hull of the project has a label, so nothing says which hulls span parts",
    )


def test_what_comes_later_to_a_project_is_kept_in_it_and_undone(folder: Path) -> None:
    for path in (folder / "new").glob("c*"):
        shutil.copy(path, folder / "assets")
    project = Project.open(folder / "p")
    (found,) = project.prepare_new(NewAssetOptions(execution=IN_PROCESS))
    assert found.asset == "c.urdf"
    assert len(found.rebuilt) == 1
    mesh = project.mesh("c.urdf")
    assert sorted(hull.label or "" for hull in mesh.hulls) == sorted(PARTS)
    assert {hull.source for hull in mesh.hulls} == {"rebuild"}
    project.unprepare("c.urdf")
    assert list(project.prepare_new()) == [], "what was taken back is not done again"
    assert [hull.name for hull in project.mesh("c.urdf").hulls] == ["base/h0", "base/h1", "base/h2", "base/h3"]


@pytest.mark.parametrize("is_signed", [True, False])
def test_assets_without_labels_are_new_to_a_family_that_is_signed_off(tmp_path: Path, is_signed: bool) -> None:
    project = create_stools(tmp_path, {"a": (0.2, 0.4), "b": (0.22, 0.45)}, "")
    project.write_program(Program.parse("Is(leg) => Delete"))
    if is_signed:
        digests: dict[str, Any] = {"asset": {}, "templates": {}, "labels": None, "manual_edits": None}
        basis = SignOffBasis.model_validate(digests | dict.fromkeys(("program", "settings", "software"), ""))
        signed = SignOff(asset="a.urdf", by="person", when="2026-01-01", probability=1, rests_on=basis)
        project.write_sign_offs({"a.urdf": signed})
    write_stool(tmp_path / "assets", "c", None, boxes(0.18, 0.38))
    later = Project.open(project.folder)
    found = list(later.prepare_new(NewAssetOptions(execution=IN_PROCESS)))
    assert [one.asset for one in found] == ["c.urdf"] * is_signed
    labels = [hull.annotation and hull.annotation.name for hull in later.mesh("c.urdf").hulls]
    assert labels == (list(PARTS) if is_signed else [None] * 5)
    assert list(later.prepare_new()) == []


def test_labelled_assets_that_could_not_be_compared_are_named(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def lose_one(*given: Any) -> tuple[dict[str, FinePieces], dict[str, str]]:
        found, _ = find_pieces(*given)
        return {"a.urdf": found["a.urdf"]}, {"b.urdf": "no answer within 600 s"}

    monkeypatch.setattr("meshforge.labels.reference_family.find_pieces", lose_one)
    results = prepare(folder, ["c.urdf"])
    assert "not compared with b.urdf: no answer within 600 s" in results["c.urdf"].notes
