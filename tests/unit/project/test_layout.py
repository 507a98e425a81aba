"""The table of a project's files agrees with what lies in a project, and with what is named where it cannot be read."""

from pathlib import Path

from meshforge.batch import stamp_path
from meshforge.common import relative_name
from meshforge.store import Layout, identify_file, list_files
from meshforge.studio.edits import assets, program, replies
from meshforge.studio.edits.base import Edit
from tests.unit.batch.families import tree
from tests.unit.project.tables import FIRST, applied

LEFT = {".gitattributes"}


def test_every_file_of_a_project_is_in_the_table(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.cut(FIRST, "crumb", (5.05, 5.05, 5.05), (0, 0, 1))
    project.review()
    names = {name for name in tree(project.folder) if not name.endswith(".tmp")} - LEFT
    assert {name for name in names if identify_file(name) is None} == set()


def test_a_path_is_that_of_its_asset(tmp_path: Path) -> None:
    layout = Layout(tmp_path)
    for path in (layout.labels("deep/a.obj"), layout.preparation("deep/a.obj"), layout.stamps("deep/a.obj")):
        inside = path / "preparation.json" if path == layout.preparation("deep/a.obj") else path
        found = identify_file(relative_name(inside, tmp_path))
        assert found and found[1] == "deep/a.obj"
    assert layout.stamps("deep/a.obj") == stamp_path(layout.edited, "deep/a.obj")
    assert identify_file("notes.txt") is None


def test_what_people_make_can_be_undone() -> None:
    kept = {file for file in list_files() if file.words or file.hulls}
    edits = [kind for module in (assets, program, replies) for kind in vars(module).values() if isinstance(kind, type)]
    assert {file for kind in edits if issubclass(kind, Edit) for file in kind.touches} >= kept
