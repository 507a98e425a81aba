"""Requests of the page besides edits and jobs, and the short responses."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from meshforge.formats import DecomposeBy
from meshforge.studio.wire import Wire
from meshforge.studio.wire.actions import ActionCall
from meshforge.studio.wire.jobs import Model


class PreviewRequest(Wire):
    """What would an action do? steps: how many of the asset's own steps come before it; result: apply it to what the
    program makes of the asset instead, as an edit by hand."""

    asset: str
    steps: int = 0
    select: tuple[str, ...]
    action: ActionCall
    result: bool = False


class SelectRequest(Wire):
    """What does an extractor select on an asset, after some of its steps, or before a rule of the program?"""

    asset: str
    steps: int = 0
    rule: int | None = None
    extractor: str


class GeneraliseRequest(Wire):
    """What does an extractor select on all assets, before the rule of that number?"""

    extractor: str
    rule: int = 1


class HullOfAsset(Wire):
    """A hull of an asset, both by name."""

    asset: str
    hull: str


class SimilarRequest(Wire):
    """Which hulls look like some? assets: where to look besides the hulls' own assets; null: in these alone; step: from
    0 on, how much they may differ."""

    hulls: tuple[HullOfAsset, ...]
    assets: tuple[str, ...] | None = None
    step: int = 0


class HullsOfAsset(Wire):
    """Some hulls of an asset, by name, and their positions in it."""

    asset: str
    hulls: tuple[str, ...]
    positions: tuple[int, ...]


class SimilarView(Wire):
    """Hulls that look like those of the request, these included. step: the one that was taken; more: whether another
    step may take more; unread: assets that could not be looked in; passed_over: how many were not, as there are too
    many."""

    found: tuple[HullsOfAsset, ...]
    step: int
    more: bool
    unread: tuple[str, ...]
    passed_over: int


class CheckRequest(Wire):
    """Is this text a program?"""

    text: str


class JobCancel(Wire):
    """Stop a job."""

    id: str


class DownloadRequest(Wire):
    """Fetch the file that a job has made."""

    job: str


class DownloadTicket(Wire):
    """Where the file is, below the studio's own address: good once, and for a minute."""

    address: str


class UploadReceipt(Wire):
    """An upload is stored. names: of a template, as actions write it; or the paths of asset files; problems: why other
    assets of it cannot be read, and were left out."""

    names: tuple[str, ...]
    problems: tuple[str, ...] = ()


class EditReceipt(Wire):
    """An edit is on disk. said: what was done, in words; nothing: whether there was nothing to do."""

    message: str
    nothing: bool = False


class LabelSources(Wire):
    """Where labels could come from. files: how many assets have a labels file with new labels; names: how many hulls
    without a label have one in their name; model: the one that can be asked, null for none."""

    files: int
    names: int
    model: Model | None


class FolderRequest(Wire):
    """A folder, by its path."""

    folder: str


Method = Literal["coacd", "vhacd"]


class ProjectOfFolder(Wire):
    """Make a project of the assets in a folder, which stay where they are. project: the folder to make; decompose: the
    tool that makes hulls of what has none, null to leave it as it is; by: of each piece as a whole, or of each of its
    parts by itself, where these are known."""

    kind: Literal["folder"] = "folder"
    folder: str
    project: str
    decompose: Method | None = None
    by: DecomposeBy = "whole"


class ProjectOfUpload(Wire):
    """Make a project of the files that were sent, which come into its own folder; fields as in `ProjectOfFolder`."""

    kind: Literal["upload"] = "upload"
    project: str
    decompose: Method | None = None
    by: DecomposeBy = "whole"


class ProjectOfFamily(Wire):
    """Make a project of a bundled family, whose files are written into its own folder."""

    kind: Literal["family"] = "family"
    family: str
    project: str


NewProject = Annotated[ProjectOfFolder | ProjectOfUpload | ProjectOfFamily, Field(discriminator="kind")]


class OpenReceipt(Wire):
    """A project is open now."""

    folder: str
