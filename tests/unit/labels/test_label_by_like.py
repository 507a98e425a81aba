"""Labels of another project, or of a family that ships."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.common import MeshForgeError, ProjectError, UsageError
from meshforge.labels import LikeLabeler, LikeMismatchError, ignore_stage, like_reference, read_reference_family
from meshforge.labels.like_reference import read_references
from meshforge.labels.summary import SURE
from meshforge.project import Project, learn
from meshforge.samples import TABLES
from meshforge.symbolic import Label
from tests.unit.batch.families import label_of, obj, table_boxes, write_table
from tests.unit.cli.in_process import Run

NAMES = tuple(table_boxes())
TRUE = {name: label_of(name) for name in NAMES}


def family(folder: Path, low: float, vocabulary: tuple[str, ...] = ()) -> Project:
    """Three tables of different heights."""
    for k in range(3):
        write_table(folder / f"assets/t{k}.obj", height=low + 0.3 * k, labels=False)
    return Project.create(folder / "p", [folder / "assets"], vocabulary=vocabulary)


@pytest.fixture
def other(tmp_path: Path) -> Project:
    """Another project, of tables that a person labelled."""
    project = family(tmp_path / "other", 0.8, ("top", "leg", "misc"))
    project.set_labels_of(dict.fromkeys(project.assets(), TRUE))
    return project


@pytest.fixture
def project(tmp_path: Path, other: Project) -> Project:
    """Tables with the labels of the other project."""
    project = family(tmp_path / "own", 0.95)
    project.label(LikeLabeler(other.folder))
    return project


def labels_of(project: Project) -> dict[str, str]:
    return {f"{a} {hull}": label.name for a in project.assets() for hull, label in project.labels(a).labels.items()}


def test_hulls_get_the_labels_of_another_project_and_none_is_sure(tmp_path: Path, project: Project) -> None:
    assert project.vocabulary == ("top", "leg", "misc")
    for asset in project.assets():
        labels = project.labels(asset).labels
        assert {name: label.name for name, label in labels.items()} == TRUE
        assert {label.source for label in labels.values()} == {"like"}
        assert max(label.confidence for label in labels.values()) < SURE
    assert project.layout.like.ids == ("p",) and project.layout.labels.ids == project.assets()
    inputs = learn.digest_learning_inputs(project)
    project.layout.like("p").unlink()
    assert learn.digest_learning_inputs(project) == inputs


def test_what_follows_from_it_is_not_sure_either(project: Project) -> None:
    project.set_labels("t0.obj", dict.fromkeys(NAMES))
    family = read_reference_family(project, IN_PROCESS, ignore_stage, spans=False)
    assert family and max(label.confidence for label in family.infer_labels(project.mesh("t0.obj")).values()) < SURE
    project.label("propagate")
    labels = project.labels("t0.obj").labels.values()
    assert {label.source for label in labels} == {"propagated"} and max(label.confidence for label in labels) < SURE


def test_a_dry_run_keeps_nothing_of_too_many_hulls_some_and_an_asset_that_cannot_be_read_is_named(
    tmp_path: Path, other: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(like_reference, "_HULLS", 2 * len(NAMES))
    project = family(tmp_path / "own", 0.95)
    dry = project.label(LikeLabeler(other.folder), dry_run=True)
    assert {row.label for row in dry.proposals.rows} == {*TRUE.values()}
    assert not project.vocabulary and not project.layout.like.ids and not labels_of(project)
    assert not project.label(LikeLabeler(other.folder)).notes
    assert len(read_references(project)["p"].assets) == 2
    (tmp_path / "other/assets/t0.obj").write_text("v 0 0 0\nf 1")
    assert "t0.obj" in project.label(LikeLabeler(other.folder)).notes[0]


def test_what_is_kept_labels_again_without_the_other_project(project: Project, other: Project) -> None:
    kept = project.layout.like("p").read_text()
    shutil.rmtree(other.folder.parent)
    project.set_labels("t0.obj", dict.fromkeys(NAMES))
    project.label("like")
    assert len(labels_of(project)) == 3 * len(NAMES)
    assert project.layout.like("p").read_text() == kept
    with pytest.raises(UsageError, match="this is no project whose labels"):
        project.label(LikeLabeler(other.folder))


def test_the_same_again_takes_what_changed_there(project: Project, other: Project) -> None:
    for asset in other.assets():
        other.set_labels(asset, {"top": "misc", "crumb": None})
    project.label(LikeLabeler(other.folder))
    assert {label for name, label in labels_of(project).items() if name.endswith("top")} == {"misc"}


def test_what_is_said_here_counts_more(project: Project, other: Project) -> None:
    project.set_labels("t0.obj", {**TRUE, "crumb": "top"})
    project.label(LikeLabeler(other.folder))
    assert project.labels("t0.obj").labels["crumb"] == Label("top")
    labels = project.labels("t1.obj").labels
    assert labels["left_low"].confidence >= SURE
    assert labels["crumb"].confidence < SURE or labels["crumb"].name == "top"
    project.label("propagate")
    crumb = project.labels("t1.obj").labels["crumb"]
    assert (crumb.name, crumb.source) == ("top", "propagated") and crumb.given and crumb.given.source == "like"


def test_a_label_of_a_name_or_a_file_takes_its_place_and_not_vice_versa(tmp_path: Path, project: Project) -> None:
    project.label("names")
    write_table(tmp_path / "own/assets/t1.obj", height=1.25)
    project.label("file")
    project.label("like")
    assert project.labels("t0.obj").labels["top"].source == "name"
    assert {label.source for label in project.labels("t1.obj").labels.values()} == {"file"}


def test_a_hull_like_nothing_there_stays_open_and_loses_what_it_was_given(tmp_path: Path, project: Project) -> None:
    rod = {f"rod{k}": ((3 + 0.1 * k, -9, 7), (3.01 + 0.1 * k, 12, 7.01)) for k in range(2)}
    (tmp_path / "own/assets/t2.obj").write_text(obj({**table_boxes(1.5), **rod}))
    project.set_labels("t2.obj", {"rod0": "leg"}, source="like", confidence=0.7)
    outcome = project.label("like").outcomes[2]
    assert outcome.open["rod0"] == outcome.open["rod1"] == "like nothing in p"
    assert "rod0" not in project.labels("t2.obj").labels


def test_words_that_differ_are_taken_by_their_synonyms_or_as_they_are_mapped(tmp_path: Path, other: Project) -> None:
    project = family(tmp_path / "own", 0.95, ("tabletop", "post", "drawer"))
    found = project.label(LikeLabeler(other.folder))
    assert found.notes == (
        "top of p is taken as tabletop",
        "leg of p is taken as post",
        "hulls like misc of p stay open; --map misc=LABEL says what they are",
    )
    assert found.outcomes[0].open == {"crumb": "like misc of p"}
    assert {*labels_of(project).values()} == {"tabletop", "post"}
    project.rename_label("post", "foot")
    assert read_references(project)["p"].words == {"top": "tabletop", "leg": "foot", "misc": ""}
    project.label("like")
    assert {*labels_of(project).values()} == {"tabletop", "foot"}
    project.label(LikeLabeler(other.folder, {"misc": "drawer", "leg": ""}))
    assert {*labels_of(project).values()} == {"tabletop", "drawer"}


def test_words_that_neither_has_are_named(tmp_path: Path, other: Project) -> None:
    project = family(tmp_path / "own", 0.95, ("leg", "posts"))
    with pytest.raises(UsageError, match=r"p has no label 'legs'\n  Did you mean 'leg'"):
        project.label(LikeLabeler(other.folder, {"legs": "leg"}))
    with pytest.raises(UsageError, match=r"'post' is not in the vocabulary\n  Did you mean 'posts'"):
        project.label(LikeLabeler(other.folder, {"leg": "post"}))
    project.set_vocabulary(("wing", "fuselage"))
    with pytest.raises(UsageError, match=r"no label of p \(top, leg, misc\) means one of the .*\n  .*--map top=L"):
        project.label(LikeLabeler(other.folder))


def _truncate(other: Project) -> None:
    path = other.layout.labels("t1.obj")
    path.write_text(path.read_text()[:60])


def _unlabel(other: Project) -> None:
    for asset in other.assets():
        other.set_labels(asset, dict.fromkeys(NAMES))
        other.set_labels(asset, {"top": "top"}, source="vlm", confidence=0.4)
        other.set_labels(asset, {"crumb": "misc"}, source="like", confidence=0.95)


@pytest.mark.parametrize(
    ("spoil", "problem"),
    [
        (_unlabel, "no hull has a label that others could be taken from\n  Label some there first"),
        (_truncate, r"t1\.obj\.json:.*the labels are no JSON"),
        (lambda other: shutil.move(other.folder, other.folder.with_name("q")), "this is no project whose labels"),
        (
            lambda other: [path.write_text("v 0 0 0\nf 1") for path in other.folder.parent.glob("assets/*.obj")],
            "t0.obj",
        ),
    ],
)
def test_another_project_that_cannot_be_used_is_named(
    tmp_path: Path, other: Project, spoil: Callable[[Project], object], problem: str
) -> None:
    project = family(tmp_path / "own", 0.95)
    spoil(other)
    with pytest.raises(MeshForgeError, match=problem):
        project.label(LikeLabeler(other.folder))
    assert not project.layout.like("p").exists() and not labels_of(project)


def test_a_wrong_name_the_project_itself_and_no_name_are_refused(tmp_path: Path) -> None:
    project = family(tmp_path / "own", 0.95)
    with pytest.raises(UsageError, match="there is no family 'cusp'\n  Did you mean 'cups'"):
        project.label(LikeLabeler("sample:cusp"))
    with pytest.raises(UsageError, match="this is the project itself"):
        project.label(LikeLabeler(project.folder / "../p"))
    with pytest.raises(UsageError, match="nothing says whose labels to take"):
        project.label("like")


def test_a_file_of_another_family_that_is_damaged_is_named(project: Project) -> None:
    path = project.layout.like("p")
    whole = path.read_text()
    for damaged in (whole[:99], whole.replace('["top","leg"', '["leg","leg"'), "{}"):
        path.write_text(damaged)
        with pytest.raises(
            ProjectError, match=r"like.p\.json(.|\n)*Remove it, and take the labels with --like once more"
        ):
            project.label("like")


def test_hulls_that_are_all_alike_get_a_label(tmp_path: Path) -> None:
    for place in ("other", "own"):
        for k in range(2):
            path = tmp_path / place / f"assets/c{k}.obj"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(obj({f"c{n}": ((3.0 * n, 0, 0), (3.0 * n + 1, 1, 1)) for n in range(3)}))
    other = Project.create(tmp_path / "other/p", [tmp_path / "other/assets"], vocabulary=("cube",))
    other.set_labels("c0.obj", {"c0": "cube", "c1": "cube", "c2": "cube"})
    own = Project.create(tmp_path / "own/p", [tmp_path / "own/assets"])
    own.label(LikeLabeler(other.folder))
    assert [*labels_of(own).values()] == ["cube"] * 6


@pytest.mark.slow
def test_another_kind_is_refused_with_the_nearest_ones(run: Run, tmp_path: Path) -> None:
    for name in ("table_01", "table_02"):
        (tmp_path / f"{name}.obj").write_bytes((TABLES / f"{name}.obj").read_bytes())
    Project.create(tmp_path / "p", [tmp_path / "*.obj"])
    done = run("label", "p", "--like", "sample:bottles", "--json")
    assert done.code == 2
    assert "most hulls are farther from those of bottles than these are from each other" in done.err
    assert "meshforge render table_01.obj --project" in done.err
    assert json.loads(done.out)["nearest"][0] == {"family": "tables", "distance": 0.0}
    assert not Project.open(tmp_path / "p").layout.like.ids
    assert "--like is for --with like" in run("label", "p", "--like", "sample:cups", "--with", "names").err
    with pytest.raises(LikeMismatchError):
        Project.open(tmp_path / "p").label(LikeLabeler("sample:bottles"), dry_run=True)
