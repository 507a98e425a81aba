import shutil
from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS, ApplyOptions
from meshforge.batch.outcome import Skipped
from meshforge.common import MeshForgeError, ProjectError
from meshforge.language import Delete, Merge, Program
from meshforge.project import Project, demonstrations
from meshforge.symbolic import Label
from meshforge.synthesis import Answer, LabelFix, Step
from tests.unit.batch.families import tree
from tests.unit.deaths import deaths, needs_fork
from tests.unit.project.tables import FIRST, LEGS, SECOND, THIRD, applied, demonstrated, labelled, learned


def saying(folder: Path) -> Project:
    """A project that says `leg` wherever a label can be said."""
    project = learned(folder)
    project.demonstrate(FIRST, [Step(1, {"crumb"}, Delete()), Step(2, LEGS, Merge(), "leg")])
    project.set_orientation("+Z: Is(leg) -> Is(top)")
    text = "labels top, leg, misc\n\n# the legs\nDiff(Attach(Is(leg), Is(top)), Geo(Is(leg), +Z)) => Merge as leg\n"
    project.accept(Program.parse(text))
    project.correct(SECOND, ["top"], Merge(), "leg")
    project.add_answer(Answer(2, THIRD, LEGS))
    project.confirm(LabelFix(FIRST, "crumb", "misc", "leg"))
    demonstrations.reject(project, LabelFix(SECOND, "top", "top", "leg"))
    return project


def says(project: Project) -> str:
    """All that a project keeps, as text, without its own notes, the program before, and drafts of killed writers."""
    aside = (".meshforge/", "program.previous.mf")
    files = {name: data for name, data in tree(project.folder).items() if not name.startswith(aside)}
    return "".join(data.decode() for name, data in files.items() if not name.endswith(".tmp"))


def test_a_label_is_renamed_wherever_the_project_says_it_and_nothing_else_changes(tmp_path: Path) -> None:
    project = saying(tmp_path)
    before = says(project)
    project.rename_label("leg", "foot")
    assert before.count("leg") > 20
    renamed = before.replace("leg", "foot")
    for remark in ("# the legs", 'for example "+Z: Is(leg)'):
        renamed = renamed.replace(remark.replace("leg", "foot"), remark)
    assert says(project) == renamed


def test_a_learned_program_stands_as_it_stood(tmp_path: Path) -> None:
    project = learned(tmp_path / "a")
    project.rename_label("leg", "foot")
    assert not project.program_state().by_hand and not project.program_state().outdated
    project.set_labels(FIRST, {"crumb": "foot"})
    project.rename_label("foot", "leg")
    assert project.program_state().outdated and not project.program_state().by_hand
    by_hand = saying(tmp_path / "b")
    by_hand.rename_label("leg", "foot")
    assert by_hand.program_state().by_hand


def test_results_follow_as_a_new_run_would_make_them_unless_hulls_have_the_name_already(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_vocabulary(["top", "leg", "misc", "rail"])
    project.set_labels(SECOND, {"left_low": "rail"})
    project.set_vocabulary(["top", "leg", "misc"])
    list(project.apply(execution=IN_PROCESS))
    project.rename_label("leg", "foot")
    made = tree(project.layout.edited)
    assert {type(one) for one in project.apply(execution=IN_PROCESS)} == {Skipped}
    list(project.apply(options=ApplyOptions(resume=False), execution=IN_PROCESS))
    outputs = {name for name in made if not name.startswith(".")}
    assert len(outputs) == 6 and {name: tree(project.layout.edited)[name] for name in outputs} == {
        name: made[name] for name in outputs
    }
    project.rename_label("foot", "rail")
    assert Skipped not in {type(one) for one in project.apply(execution=IN_PROCESS)}


def test_what_an_inferred_label_replaced_is_renamed_too(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    for asset in (FIRST, SECOND):
        project.set_labels(asset, {"crumb": None})
        project.set_labels(asset, {"crumb": "leg"}, source="vlm", confidence=0.5)
        project.set_labels(asset, {"crumb": "misc"}, source="propagated", confidence=0.9)
    project.confirm(LabelFix(FIRST, "crumb", "misc", "top"))
    project.rename_label("leg", "foot")
    now = Label("misc", 0.9, "propagated", Label("foot", 0.5, "vlm"))
    assert project.labels(SECOND).labels["crumb"] == now
    assert project.take_back(f"{FIRST}#crumb=top") is None
    assert project.labels(FIRST).labels["crumb"] == now


def test_files_that_do_not_say_the_label_are_left_alone(tmp_path: Path) -> None:
    project = learned(tmp_path)
    project.set_vocabulary(["top", "leg", "misc", "wheel"])
    before = tree(project.folder)
    project.rename_label("wheel", "castor")
    after = tree(project.folder)
    changed = {name for name in before | after if before.get(name) != after.get(name)}
    assert changed == {"meshforge.toml"}


def test_a_label_keeps_its_description_under_its_other_name(tmp_path: Path) -> None:
    project = saying(tmp_path)
    told = '\n[vlm]\nnames = true\n\n[vlm.descriptions]\nleg = "what it stands on"\npanel = "boards"  # all of them\n'
    with project.layout.settings.open("a") as file:
        file.write(told)
    project.rename_label("leg", "chair leg")
    assert project.settings.vlm.descriptions == {"chair leg": "what it stands on", "panel": "boards"}
    assert 'panel = "boards"  # all of them\n' in project.layout.settings.read_text()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("legs", "foot", "there is no label 'legs'(.|\n)*Did you mean 'leg'"),
        ("leg", "top", "there is a label 'top' already"),
        ("leg", "leg", "there is a label 'leg' already"),
        ("leg", "", "no program could write"),
        ("leg", "a\nb", "no program could write"),
    ],
)
def test_what_cannot_be_renamed_is_refused_and_unchanged(tmp_path: Path, old: str, new: str, message: str) -> None:
    project = demonstrated(tmp_path)
    before = tree(project.folder)
    with pytest.raises(ProjectError, match=message):
        project.rename_label(old, new)
    assert tree(project.folder) == before


@pytest.mark.parametrize("name", ["Is", "as", "labels", 'say "leg"', "Füße 2", "back\\slash", "#1"])
def test_any_name_that_a_program_can_quote_will_do(tmp_path: Path, name: str) -> None:
    project = saying(tmp_path)
    project.rename_label("leg", name)
    program = project.program()
    assert program and name in program.labels_in_use
    assert [step.label for step in project.steps(FIRST)] == [None, name]


@pytest.mark.parametrize("damaged", [f"labels/{SECOND}.json", f"demonstrations/{SECOND}.json", "program.mf"])
def test_a_damaged_file_stops_it_before_anything_is_written(tmp_path: Path, damaged: str) -> None:
    project = applied(tmp_path)
    (project.folder / damaged).write_text("{nonsense")
    before = tree(project.folder)
    with pytest.raises(MeshForgeError, match=Path(damaged).name):
        project.rename_label("leg", "foot")
    assert tree(project.folder) == before


@pytest.mark.slow
@needs_fork
def test_a_killed_renaming_leaves_a_readable_project_and_is_completed_by_another(tmp_path: Path) -> None:
    project, before = saying(tmp_path), tmp_path / "before"
    shutil.copytree(project.folder, before)
    project.rename_label("leg", "foot")
    after = says(project)

    def again() -> None:
        shutil.rmtree(project.folder)
        shutil.copytree(before, project.folder)
        project.rename_label("leg", "foot")

    for _ in deaths(again, costly=True):
        assert project.vocabulary == ("top", "leg", "misc")
        assert len(project.demonstrations()) == 2 and project.program() and project.manual_edits(SECOND)
        assert project.status(workers=0).problem is None
        assert says(project) != after
        project.rename_label("leg", "foot")
        assert says(project) == after
