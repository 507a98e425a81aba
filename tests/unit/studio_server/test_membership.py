"""Assets that are left out and added, each undone: the settings, the ids, and what is kept for them."""

import shutil
from pathlib import Path

import pytest

from meshforge.common import ProjectError
from meshforge.project import Project
from meshforge.signoff.question import NOT_OF_FAMILY
from meshforge.store import History
from meshforge.studio.edits.assets import AddAssets, ExcludeAssets
from meshforge.studio.edits.base import make_edit
from tests.unit.batch.families import tree
from tests.unit.project.tables import FIRST, SECOND, THIRD, demonstrated, fresh

OUT = ExcludeAssets(ids=(FIRST,), reason=NOT_OF_FAMILY)


def _kept(project: Project) -> dict[str, bytes]:
    return {name: data for name, data in tree(project.folder).items() if not name.startswith(".meshforge")}


def _now(project: Project) -> tuple[str, ...]:
    return Project.open(project.folder).assets()


def test_an_asset_that_is_left_out_keeps_what_is_known_of_it(tmp_path: Path) -> None:
    project = demonstrated(tmp_path)
    before, history = _kept(project), History.open(project.folder)
    make_edit(history, project, OUT)
    found = Project.open(project.folder)
    assert project.assets() == found.assets() == (SECOND, THIRD) and found.exclusions() == {FIRST: NOT_OF_FAMILY}
    assert (found.status().lost, found.status().not_of_family) == ((), (FIRST,))
    assert {name: data for name, data in _kept(project).items() if name != "events.jsonl"} == before
    make_edit(history, found, ExcludeAssets(ids=(FIRST,), reason=None))
    assert project.assets() == _now(project) == (FIRST, SECOND, THIRD)
    history.undo()
    history.undo()
    assert _kept(project) == before


def test_the_last_asset_of_a_family_stays(tmp_path: Path) -> None:
    project, edit = fresh(tmp_path), ExcludeAssets(ids=(FIRST, SECOND, THIRD), reason=NOT_OF_FAMILY)
    before = _kept(project)
    with pytest.raises(ProjectError, match="would be left"):
        make_edit(History.open(project.folder), project, edit)
    assert _kept(project) == before


def test_assets_that_the_settings_of_before_leave_out_are_excluded_and_can_come_back(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    toml = project.folder / "meshforge.toml"
    text = toml.read_text() + "\n# mine\n[thresholds]\ncontact = 0.01\n"
    toml.write_text(text.replace("\n# mine", f'left_out = ["{FIRST}"]\nremoved = ["{SECOND}"]\n\n# mine'))
    before, history = _kept(project), History.open(project.folder)
    assert _now(project) == (THIRD,) and project.exclusions() == dict.fromkeys([FIRST, SECOND], NOT_OF_FAMILY)
    assert _kept(project) == before, "reading changes nothing"
    make_edit(history, project, ExcludeAssets(ids=(FIRST,), reason=None))
    assert _now(project) == (FIRST, THIRD) and toml.read_text() == text
    assert Project.open(project.folder).add_assets([project.path(SECOND)]).assets() == (FIRST, SECOND, THIRD)


def test_an_asset_that_is_added_lands_in_the_folder_of_the_project(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    staged, sources = tmp_path / "staged", tree(tmp_path / "assets")
    (staged / "new").mkdir(parents=True)
    shutil.copyfile(project.path(FIRST), staged / "new" / "x.obj")
    home, history = project.found.added, History.open(project.folder)
    edit = AddAssets(staged=str(staged), files=("new/x.obj",), added=("new/x.obj",), home=str(home))
    make_edit(history, project, edit)
    found = Project.open(project.folder)
    assert home == project.folder / "added"
    assert "added/new/x.obj" in found.assets() and tree(tmp_path / "assets") == sources
    assert found.mesh("added/new/x.obj").hulls
    history.undo()
    assert _now(project) == (FIRST, SECOND, THIRD) and not (home / "new" / "x.obj").exists()
