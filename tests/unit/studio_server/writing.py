"""An edit that writes files, as simple as can be, for tests of the history."""

from pathlib import Path

from meshforge.batch import AssetSet
from meshforge.common import ProjectError, write_atomically
from meshforge.project import Project
from meshforge.studio.edits.base import Edit
from tests.unit.batch.families import tree


class Write(Edit):
    """Let some files of `data/` hold something; None removes one. fails: raises after that many files."""

    files: dict[str, str | None]
    fails: int | None = None

    def apply(self, project: Project) -> None:
        for number, (name, content) in enumerate(self.files.items()):
            if number == self.fails:
                raise ProjectError("no more")
            path = project.folder / "data" / name
            if content is None:
                path.unlink(missing_ok=True)
            else:
                write_atomically(path, content)

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return (project.folder / "data",)

    def describe(self, project: Project) -> str:
        return f"wrote {', '.join(self.files)}"


def bare(folder: Path) -> Project:
    """A project that is nothing but a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    return Project(folder, AssetSet(folder, ()))


def data(project: Project) -> dict[str, bytes]:
    """The files that edits write, drafts of killed writers aside."""
    root = project.folder / "data"
    return {name: text for name, text in tree(root).items() if not name.endswith(".tmp")} if root.exists() else {}
