import json
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS, ExecutionOptions
from meshforge.common import MeshForgeError, ProgramError, ProjectError
from meshforge.formats import load
from meshforge.labels import FileLabeler
from meshforge.language import Delete, Is, LandmarkPair, Merge, Orient, Replace
from meshforge.project import Project
from meshforge.synthesis import Step
from tests.unit.batch.families import PROGRAM, tree, write_table, write_urdf_table
from tests.unit.project.tables import FIRST, LEGS, SECOND, STEPS, THIRD, applied, demonstrated, fresh, labelled, learned

UP = Orient((LandmarkPair("+Z", Is("leg"), Is("top")),))


def test_a_new_project_is_one_readable_file(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    settings = tomllib.loads((project.folder / "meshforge.toml").read_text())
    assert settings == {"name": "tables", "assets": ["../assets"], "base": "../assets", "vocabulary": [], "orient": ""}
    assert project.assets() == (FIRST, SECOND, THIRD)


def test_a_project_is_not_made_twice(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    with pytest.raises(ProjectError, match="already"):
        Project.create(project.folder, [tmp_path / "assets"])


@pytest.mark.parametrize(
    ("act", "said"),
    [
        (Project.open, "meshforge new"),
        (lambda folder: fresh(folder).apply(), "meshforge demonstrate"),
        (lambda folder: labelled(folder).synthesize(), "nothing is demonstrated"),
    ],
)
def test_what_is_missing_is_said_with_what_to_do(tmp_path: Path, act: Callable[[Path], object], said: str) -> None:
    with pytest.raises(ProjectError, match=said):
        act(tmp_path)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('name = "tables"', "name = 3", "field name"),
        ('assets = ["../assets"]', 'assets = ["../gone"]', "../gone"),
        ("vocabulary = []", "vocabulary = [", "no TOML"),
        ('orient = ""', 'orient = ""\nthresholds = {contact = 2}', "thresholds.contact"),
    ],
)
def test_settings_that_do_not_fit_are_named(tmp_path: Path, old: str, new: str, message: str) -> None:
    project = fresh(tmp_path)
    toml = project.folder / "meshforge.toml"
    toml.write_text(toml.read_text().replace(old, new))
    with pytest.raises(ProjectError, match=message) as caught:
        Project.open(project.folder)
    assert "meshforge.toml" in caught.value.message


def test_settings_are_changed_in_place(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    toml = project.folder / "meshforge.toml"
    toml.write_text(toml.read_text() + "\n[labelling] # mine\nmodel = 'x'\n")
    before = toml.read_text()
    project.set_vocabulary(["top", "leg"])
    project.set_orientation(UP)
    assert project.vocabulary == ("top", "leg")
    assert project.orientation == UP
    expected = before.replace("vocabulary = []", 'vocabulary = ["top", "leg"]')
    assert toml.read_text() == expected.replace('orient = ""', 'orient = "+Z: Is(leg) -> Is(top)"')
    project.set_orientation("orient +X: All -> Is(top)")
    project.set_orientation(None)
    assert project.orientation is None
    with pytest.raises(ProjectError, match="orientation"):
        project.set_orientation("up")
    with pytest.raises(ProgramError):
        project.set_vocabulary(["top", "top"])


def test_unknown_hulls_and_labels_in_a_file_are_told_with_the_nearest(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    project.set_vocabulary(["top", "leg", "misc"])
    file = tmp_path / "given.json"
    file.write_text(json.dumps({"hulls": {"left_lo": "leg", "top": "topp", "crumb": "misc"}}))
    folder = tmp_path / "labels"
    (folder / "table0").mkdir(parents=True)
    file.rename(folder / f"{FIRST}.json")
    (report,) = project.label(FileLabeler(folder)).outcomes
    assert report.asset == FIRST and report.taken == 1
    assert report.problems == (
        "there is no hull 'left_lo'; did you mean 'left_low'?",
        "top: the label 'topp' is not in the vocabulary; did you mean 'top'?",
    )


def test_wrong_labels_given_by_hand_are_refused_whole(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    project.set_vocabulary(["top"])
    for labels in ({"top": "top", "topp": "top"}, {"top": "tap"}, {"nothing": None}, {"top": "part_q"}):
        with pytest.raises(ProjectError):
            project.set_labels(FIRST, labels)
    assert not (project.folder / "labels").exists()
    with pytest.raises(ProjectError, match=r"Did you mean 'table0/model\.obj'"):
        project.set_labels("table0/modl.obj", {})


def test_demonstrations_are_kept_as_the_steps_that_were_shown(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    steps = (*STEPS, Step(3, (), Delete()), Step(4, None, Replace("capsule", "native"), "top"))
    project.demonstrate(FIRST, steps)
    path = project.folder / "demonstrations" / f"{FIRST}.json"
    assert json.loads(path.read_text()) == {
        "asset": FIRST,
        "steps": [
            {"rule": 1, "select": ["crumb"], "action": "Delete"},
            {"rule": 2, "select": sorted(LEGS), "action": "Each(Merge)"},
            {"rule": 3, "select": [], "action": "Delete"},
            {"rule": 4, "select": None, "action": "Replace(capsule, native) as top"},
        ],
    }
    assert project.steps(FIRST) == steps
    assert list(project.demonstrations()) == [FIRST]
    project.demonstrate(FIRST, ())
    assert not path.exists() and project.demonstrations() == {}


def test_fields_that_this_version_does_not_know_are_kept(tmp_path: Path) -> None:
    project = demonstrated(tmp_path)
    path = project.folder / "demonstrations" / f"{FIRST}.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | {"author": "me"}))
    project.demonstrate(FIRST, STEPS[:1])
    assert json.loads(path.read_text())["author"] == "me"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('{"asset": "x", "steps": [{"rule": 0, "select": null, "action": "Delete"}]}', r"steps\[0\]\.rule"),
        ('{"asset": "x", "steps": [{"rule": 1, "select": null, "action": "Delte"}]}', "'Delte' is no action"),
        ('{"asset": "x"}', "field steps"),
        ("{", "JSON"),
    ],
)
def test_a_damaged_demonstration_is_named(tmp_path: Path, text: str, message: str) -> None:
    project = demonstrated(tmp_path)
    path = project.folder / "demonstrations" / f"{FIRST}.json"
    path.write_text(text)
    with pytest.raises(ProjectError, match=message) as caught:
        project.steps(FIRST)
    assert str(path) in caught.value.message


def test_the_program_is_applied_into_the_project(tmp_path: Path) -> None:
    project = applied(tmp_path)
    edited = project.folder / "edited"
    assert sorted(p.name for p in edited.glob("*/*.obj")) == ["model.obj"] * 3
    assert {h.name: h.label for h in load(edited / THIRD).hulls} == {
        "top": "top",
        "left_low~1": "leg",
        "right_low~1": "leg",
    }
    assert [o.status for o in project.apply(execution=IN_PROCESS)] == ["skipped"] * 3
    assert [o.status for o in project.apply(execution=IN_PROCESS, out=tmp_path / "else")] == ["edited"] * 3


def test_an_edit_by_hand_is_replayed_after_the_program(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.correct(SECOND, ["left_low~1", "right_low~1"], Merge(), "top")
    assert [o.status for o in project.apply(execution=IN_PROCESS)] == ["skipped", "edited", "skipped"]
    mesh = load(project.folder / "edited" / SECOND)
    assert {h.name: h.label for h in mesh.hulls} == {"top": "top", "left_low~2": "top"}
    project.correct(SECOND, ["left_low~2"], Delete())
    assert len(project.manual_edits(SECOND)) == 2
    project.write_manual_edits(SECOND, ())
    assert project.manual_edits(SECOND) == ()


def test_an_edit_by_hand_whose_hull_is_gone_or_changed_is_flagged_and_left_out(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.correct(FIRST, ["left_low~1"], Delete())
    project.correct(SECOND, ["top"], Replace("box"))
    (project.folder / "program.mf").write_text("labels top, leg, misc\nIs(misc) => Delete\n")
    write_table(tmp_path / "assets" / SECOND, 3.0)
    outcomes = {o.asset: o for o in project.apply(execution=IN_PROCESS)}
    assert getattr(outcomes[FIRST], "flags", None) == ("edit 1 by hand was left out: left_low~1 is gone",)
    assert getattr(outcomes[SECOND], "flags", None) == ("edit 1 by hand was left out: top has another shape now",)
    assert len(load(project.folder / "edited" / FIRST).hulls) == 5


def test_an_edit_by_hand_in_a_turned_frame_leaves_the_other_hulls_alone(tmp_path: Path) -> None:
    project = learned(tmp_path)
    text = PROGRAM.replace("\nIs(misc)", "\norient +X: Is(leg) -> Is(top)\n\nIs(misc)")
    (project.folder / "program.mf").write_text(text)
    list(project.apply(execution=IN_PROCESS))
    before = load(project.folder / "edited" / FIRST)
    project.correct(FIRST, ["top"], Delete())
    list(project.apply(execution=IN_PROCESS))
    after = load(project.folder / "edited" / FIRST)
    assert [h.name for h in after.hulls] == ["left_low~1", "right_low~1"]
    for hull in after.hulls:
        assert hull.vertices.tobytes() == before.hull_of(hull.name).vertices.tobytes()


def test_assets_of_a_project_are_never_written_to(tmp_path: Path) -> None:
    write_urdf_table(tmp_path / "robots")
    before = tree(tmp_path / "robots")
    project = Project.create(tmp_path / "p", [tmp_path / "robots"])
    project.label("file")
    project.demonstrate("table.urdf", [Step(1, {"body/crumb"}, Delete())])
    project.synthesize()
    assert [o.status for o in project.apply(execution=ExecutionOptions(1))] == ["edited"]
    assert tree(tmp_path / "robots") == before


def test_a_project_among_its_assets_does_not_take_its_own_files_for_assets(tmp_path: Path) -> None:
    write_table(tmp_path / "a.obj")
    project = Project.create(tmp_path, [tmp_path], vocabulary=["top", "leg", "misc"])
    project.label("file")
    (project.folder / "program.mf").write_text(PROGRAM)
    write_table(project.folder / "templates/knob.obj")
    list(project.apply(execution=IN_PROCESS))
    assert Project.open(tmp_path).assets() == ("a.obj",)


def test_an_unreadable_asset_is_left_out_of_learning_and_fails_in_applying(tmp_path: Path) -> None:
    project = demonstrated(tmp_path)
    (tmp_path / "assets" / THIRD).write_text("nothing of use")
    with pytest.raises(MeshForgeError):
        project.mesh(THIRD)
    project.synthesize()
    assert [o.status for o in project.apply(execution=IN_PROCESS)] == ["edited", "edited", "failed"]
