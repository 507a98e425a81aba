"""The start page: recent projects, folders of this machine, and what a new project would be made of."""

from typing import Annotated, Literal

from pydantic import Field

from meshforge.studio.wire import Wire
from meshforge.studio.wire.jobs import DecomposeOptions


class RecentProject(Wire):
    """A project that was open before. assets: how many it had then; opened: when, as ISO 8601; gone: whether there is
    no project in that folder any more; state: how far it was then, or why it cannot be read now, empty where that is
    not known; picture: the name of one of its thumbnails, empty where there is none."""

    folder: str
    name: str
    assets: int = 0
    opened: str = ""
    gone: bool = False
    state: str = ""
    picture: str = ""


class FamilyOffer(Wire):
    """A bundled family. about: what it is, in a line; project: the folder that is offered for it."""

    name: str
    about: str
    project: str


class StartView(Wire):
    """What the start page shows. places: folders to begin looking for assets in; tour: the folder that is offered for
    the project of the guided tour."""

    version: str
    recent: tuple[RecentProject, ...]
    families: tuple[FamilyOffer, ...]
    places: tuple[str, ...]
    tour: str


class FolderEntry(Wire):
    """A folder in another. project: whether it is a project."""

    name: str
    project: bool = False


class FolderView(Wire):
    """A folder of this machine. parent: the one it lies in, null at the root; entries: the folders in it by name, but
    for hidden ones; more: how many are left out; files: how many files of assets and meshes lie in it itself."""

    folder: str
    parent: str | None
    project: bool
    entries: tuple[FolderEntry, ...]
    more: int = 0
    files: int = 0


class AssetsFound(Wire):
    """What a folder or an upload holds, before a project is made of it.

    folder: where it lies; kinds: how many of which format, in words; assets: how many; read: how many of them were
    looked at, the first ones. Of these, pieces: how many pieces and bodies have no hulls and can be decomposed; seen:
    how many of these are bodies that are only seen, while others of their asset collide; bare: how many assets have
    such pieces; divided: how many of these have a piece with several parts that are known; parts:
    some names of these; broken: how many cannot be read; problem: why the first of them cannot be read;
    left_out: whether a project gets these not. project: the folder that is offered for the new project.
    """

    folder: str
    kinds: str
    assets: int
    read: int
    pieces: int = 0
    seen: int = 0
    bare: int = 0
    divided: int = 0
    parts: tuple[str, ...] = ()
    broken: int = 0
    problem: str | None = None
    left_out: bool = False
    project: str


class ProjectOfFolder(Wire):
    """Make a project of the assets in a folder, which stay where they are. project: the folder to make; decompose: how
    hulls are made of what has none, null to leave it as it is."""

    kind: Literal["folder"] = "folder"
    folder: str
    project: str
    decompose: DecomposeOptions | None = None


class ProjectOfUpload(Wire):
    """Make a project of the files that were sent, which come into its own folder; fields as in `ProjectOfFolder`."""

    kind: Literal["upload"] = "upload"
    project: str
    decompose: DecomposeOptions | None = None


class ProjectOfFamily(Wire):
    """Make a project of a bundled family, whose files are written into its own folder."""

    kind: Literal["family"] = "family"
    family: str
    project: str


class ProjectOfTour(Wire):
    """Make the project of the guided tour: the bundled tables with their labels."""

    kind: Literal["tour"] = "tour"
    project: str


NewProject = Annotated[ProjectOfFolder | ProjectOfUpload | ProjectOfFamily | ProjectOfTour, Field(discriminator="kind")]
