import tomllib
from pathlib import Path

import pytest

from meshforge.common import ProjectError
from meshforge.project import Project
from tests.unit.batch.families import write_table, write_urdf_table
from tests.unit.project.tables import FIRST, SECOND, THIRD, labelled


def patterns(project: Project) -> list[str]:
    found: list[str] = tomllib.loads((project.folder / "meshforge.toml").read_text())["assets"]
    return found


def test_assets_that_no_pattern_means_are_named(tmp_path: Path) -> None:
    write_table(tmp_path / "assets/a.obj")
    project = Project.create(tmp_path / "p", [tmp_path / "assets/*.obj"])
    more = [write_table(tmp_path / "assets/added" / name) for name in ("c.obj", "b[1].obj")]
    opened = project.add_assets(more)
    assert opened.assets() == ("a.obj", "added/b[1].obj", "added/c.obj")
    assert patterns(opened) == ["../assets/*.obj", "../assets/added/c.obj", "../assets/added/b[1].obj"]
    assert opened.add_assets(more).assets() == opened.assets()
    assert len(patterns(opened)) == 3
    assert project.assets() == ("a.obj",)


def test_assets_that_a_pattern_means_already_are_found_and_not_named(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    before = (project.folder / "meshforge.toml").read_text()
    opened = project.add_assets([write_table(tmp_path / "assets/table3/model.obj")])
    assert opened.assets() == (FIRST, SECOND, THIRD, "table3/model.obj")
    assert (project.folder / "meshforge.toml").read_text() == before


def test_assets_that_new_files_would_hide_stay(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    path = write_urdf_table(tmp_path / "assets/added")
    opened = project.add_assets([path])
    assert opened.assets() == ("added/table.urdf", FIRST, SECOND, THIRD)
    assert Project.open(project.folder).assets() == opened.assets()


def test_a_file_outside_of_the_base_is_refused(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    path = write_table(tmp_path / "other/a.obj")
    for way in (path, tmp_path / "assets/../other/a.obj"):
        with pytest.raises(ProjectError, match="lies outside of"):
            project.add_assets([way])


@pytest.mark.parametrize("name", ["notes.txt", "absent.obj", "table0"])
def test_what_no_format_reads_is_refused_with_nothing_changed(tmp_path: Path, name: str) -> None:
    project = labelled(tmp_path)
    (tmp_path / "assets/notes.txt").write_text("v 0 0 0")
    good = write_table(tmp_path / "assets/table0/other.obj")
    before = (project.folder / "meshforge.toml").read_text()
    with pytest.raises(ProjectError, match=f"{name}: this is no asset"):
        project.add_assets([good, tmp_path / "assets" / name])
    assert (project.folder / "meshforge.toml").read_text() == before
