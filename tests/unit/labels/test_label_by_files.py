"""Labels out of files of other tools: segmented points."""

import json
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError, MeshForgeError, ProjectError, UsageError
from meshforge.formats import read
from meshforge.geometry import Floats
from meshforge.labels import FileLabeler, LabelFileOptions, OfferCache
from meshforge.project import Project
from meshforge.symbolic import Label
from tests.unit.batch.families import label_of, tree, write_table
from tests.unit.labels.partnet import write_partnet
from tests.unit.project.tables import FIRST, SECOND, fresh

ASSET = "mobility.urdf"
NAMES = ("top", "leg", "misc")


def labels(project: Project, asset: str = ASSET) -> dict[str, tuple[str, float, str]]:
    return {name: (label.name, label.confidence, label.source) for name, label in project.labels(asset).labels.items()}


# Segmented points


def surface_points(project: Project, asset: str, count: int = 300) -> tuple[Floats, list[str]]:
    """Points on the hulls of an asset, spread evenly, and the hull of each."""
    rng = np.random.default_rng(0)
    points, owner = [], []
    for geom in read(project.path(asset)).geoms:
        box, at = geom.shape.aabb, rng.random((count, 3))
        side = rng.integers(0, 3, count)
        at[np.arange(count), side] = rng.integers(0, 2, count)
        points.append(box.min + at * box.size)
        owner += [geom.name] * count
    return np.concatenate(points), owner


def segmented(project: Project, asset: str, path: Path, **more: object) -> Path:
    """A file of points on the hulls of a table, as classes in the order of NAMES."""
    points, owner = surface_points(project, asset)
    path.parent.mkdir(parents=True, exist_ok=True)
    arrays = {"points": points, "labels": np.array([NAMES.index(label_of(name)) for name in owner]), **more}
    np.savez(path, **arrays)  # type: ignore[arg-type]
    return path


def table(folder: Path, *vocabulary: str) -> Project:
    """A project of one table."""
    write_table(folder / "assets/t.obj", labels=False)
    return Project.create(folder / "p", [folder / "assets"], vocabulary=vocabulary)


def named(classes: str) -> LabelFileOptions:
    return LabelFileOptions(classes=tuple(classes.split(",")))


def right(project: Project, asset: str = "t.obj") -> bool:
    return all(name == label_of(hull) for hull, (name, _, _) in labels(project, asset).items())


def test_each_hull_is_what_most_of_its_points_are(tmp_path: Path) -> None:
    project = table(tmp_path, *NAMES)
    segmented(project, "t.obj", tmp_path / "assets/t.points.npz", names=NAMES)
    (report,) = project.label("file").outcomes
    assert (report.taken, report.unlabelled, report.problems) == (6, 0, ())
    assert right(project)
    assert all(0.5 < sure <= 1.0 and source == "file" for _, sure, source in labels(project, "t.obj").values())
    (again,) = project.label("file").outcomes
    assert (again.taken, again.same) == (0, 6)


def test_names_of_classes_come_from_the_user_or_the_file(tmp_path: Path) -> None:
    project = table(tmp_path, *NAMES)
    file = segmented(project, "t.obj", tmp_path / "given.npz")
    for how in (named("top,leg,misc"), named("vocabulary")):
        assert project.label(FileLabeler(file, how)).outcomes[0].problems == () and right(project)
    file = segmented(project, "t.obj", tmp_path / "given.npz", names=("leg", "top", "misc"))
    project.label(FileLabeler(file))
    assert labels(project, "t.obj")["top"][0] == "leg"
    project.label(FileLabeler(file, named("top,leg,misc")))
    assert right(project), "what is typed counts before the file"


def test_classes_without_names_are_refused_with_the_ways_to_name_them(tmp_path: Path) -> None:
    project = table(tmp_path, *NAMES)
    file = segmented(project, "t.obj", tmp_path / "given.npz")
    (report,) = project.label(FileLabeler(file)).outcomes
    assert report.problems == (
        f"{file}: its classes are numbers, and nothing names them\n"
        "  Name them in order: --classes drawer,handle,leg, or --classes vocabulary where they are those of the "
        "vocabulary; or put `names` into the .npz file.",
    )
    (report,) = project.label(FileLabeler(file, named("top,leg"))).outcomes
    assert report.problems[0].startswith(f"{file}: class 2 has no name\n")
    with pytest.raises(AssetError, match="nothing names them"):
        table(tmp_path / "bare").label(FileLabeler(file))


def test_classes_mean_labels_as_names_do_and_several_may_mean_one(tmp_path: Path) -> None:
    project = table(tmp_path, "leg", "top")
    points, owner = surface_points(project, "t.obj")
    kinds = {"top": 0, "crumb": 3} | {name: 1 + name.startswith("left") for name in set(owner) - {"top", "crumb"}}
    file = tmp_path / "given.npz"
    names = ["board", "right legs", "left_leg", "crumb"]
    np.savez(file, points=points, labels=[kinds[name] for name in owner], names=names)
    (report,) = project.label(FileLabeler(file, LabelFileOptions((("board", "top"),)))).outcomes
    assert report.problems == ("1 hull left out: 'crumb' is not in the vocabulary, and no pattern says what it means",)
    assert right(project) and len(labels(project, "t.obj")) == 5
    sure = {name: sure for name, (_, sure, _) in labels(project, "t.obj").items()}
    project.label(FileLabeler(file, LabelFileOptions((("board", "top"), ("*leg*", "leg")))))
    assert all(now > sure[name] for name, (label, now, _) in labels(project, "t.obj").items() if label == "leg")


def test_points_elsewhere_are_refused_and_taken_when_the_way_is_said(tmp_path: Path) -> None:
    links = ("link_0", "link_1", "link_2")
    project = Project.create(tmp_path / "p", [write_partnet(tmp_path / "assets")], vocabulary=links)
    points, owner = surface_points(project, ASSET)
    turned = np.column_stack([points[:, 0], points[:, 2], -points[:, 1]]) / 7
    kinds = [int(name[5]) for name in owner]
    np.savez(tmp_path / "given.npz", points=turned, labels=kinds)
    (report,) = project.label(FileLabeler(tmp_path / "given.npz", named("vocabulary"))).outcomes
    assert report.taken == 0 and len(report.problems) == 1
    assert "its points do not lie where the asset does" in report.problems[0]
    assert report.problems[0].endswith("They would fit with --align box.")
    how = LabelFileOptions(classes=("vocabulary",), align="box")
    (report,) = project.label(FileLabeler(tmp_path / "given.npz", how)).outcomes
    assert report.taken == 6 and all(hull.startswith(label) for hull, (label, _, _) in labels(project).items())


def test_points_that_most_hulls_do_not_hold_are_refused_unless_they_are_to_be_taken(tmp_path: Path) -> None:
    project = table(tmp_path, *NAMES)
    box = project.mesh("t.obj").aabb
    assert box is not None
    points = box.min + np.random.default_rng(5).random((500, 3)) * box.size
    np.savez(tmp_path / "given.npz", points=points, labels=np.zeros(500, int), names=["top"])
    (report,) = project.label(FileLabeler(tmp_path / "given.npz")).outcomes
    assert "of its points are in hulls: it may be turned, or of another asset" in report.problems[0]
    (report,) = project.label(FileLabeler(tmp_path / "given.npz", LabelFileOptions(align="off"))).outcomes
    assert report.taken > 0 and not report.problems


def test_what_other_segmentations_write_is_refused_with_what_is_read(tmp_path: Path) -> None:
    """Classes of the faces of the asset, as PartField and SAMPart3D write them, beside it or given."""
    project = table(tmp_path, *NAMES)
    np.save(tmp_path / "assets/t.points.npy", np.zeros(72, dtype=int))
    for source in (None, tmp_path / "assets/t.points.npy"):
        (report,) = project.label(FileLabeler(source, named("vocabulary"))).outcomes
        (problem,) = report.problems
        assert problem.startswith(f"{tmp_path / 'assets/t.points.npy'}: .npy is no kind of segmented points\n")
        assert "Points with a class each are read, from a .ply" in problem and "np.savez(" in problem
    assert not project.labels("t.obj").labels


def test_a_person_is_never_overwritten_and_a_machine_is(tmp_path: Path) -> None:
    project = table(tmp_path, *NAMES)
    segmented(project, "t.obj", tmp_path / "assets/t.points.npz", names=NAMES)
    project.set_labels("t.obj", {"top": "misc"})
    project.set_labels("t.obj", {"crumb": "leg"}, source="propagated", confidence=0.99)
    (report,) = project.label("file").outcomes
    assert (report.taken, report.kept) == (5, 1)
    kept = project.labels("t.obj").labels
    assert kept["top"] == Label("misc") and kept["crumb"].name == "misc" and kept["crumb"].source == "file"


# Which file


def test_a_labels_file_goes_before_points(tmp_path: Path) -> None:
    project = table(tmp_path, *NAMES)
    segmented(project, "t.obj", tmp_path / "assets/t.points.npz", names=NAMES)
    project.label("file")
    assert right(project)
    (tmp_path / "assets/t.labels.json").write_text(json.dumps({"hulls": {"crumb": "leg"}}))
    (report,) = project.label("file").outcomes
    assert report.taken == 1 and labels(project, "t.obj")["crumb"] == ("leg", 1.0, "file")


def test_a_folder_mirrors_the_assets_with_files_of_every_kind(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    project.set_vocabulary(NAMES)
    folder = tmp_path / "out"
    segmented(project, FIRST, folder / "table0/model.npz", names=NAMES)
    segmented(project, SECOND, folder / "table1/model.points.npz", names=NAMES)
    reports = project.label(FileLabeler(folder)).outcomes
    assert [(report.asset, report.taken) for report in reports] == [(FIRST, 6), (SECOND, 6)]
    assert right(project, FIRST) and right(project, SECOND)


def test_what_cannot_serve_is_refused_before_anything_is_read(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    cases: dict[str, tuple[type[MeshForgeError], str]] = {
        "a.npz": (UsageError, "one file cannot serve 3 assets"),
        "a.pcd": (UsageError, "this is no kind of file that labels are read from"),
        "nowhere": (UsageError, "there is no such labels file or folder"),
        "empty": (ProjectError, "there is no labels file for any asset"),
    }
    (tmp_path / "a.npz").touch()
    (tmp_path / "a.pcd").touch()
    (tmp_path / "empty").mkdir()
    before = tree(project.folder)
    for name, (kind, message) in cases.items():
        for dry_run in (True, False):
            with pytest.raises(kind, match=message):
                project.label(FileLabeler(tmp_path / name), dry_run=dry_run)
    assert tree(project.folder) == before


# Offers


@pytest.mark.slow
def test_points_are_offered_until_something_was_taken(tmp_path: Path) -> None:
    project, offers = table(tmp_path, *NAMES), OfferCache()
    segmented(project, "t.obj", tmp_path / "assets/t.points.npz", names=NAMES)
    assert offers.of(project).files == ("t.obj",)
    project.set_labels("t.obj", {"top": "top"}, source="propagated", confidence=0.6)
    assert offers.of(project).files == ("t.obj",)
    project.label("file")
    assert offers.of(project).files == ()
