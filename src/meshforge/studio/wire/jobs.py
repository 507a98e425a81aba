"""Jobs: requests, progress and outcome; and the model that can be asked."""

from typing import Literal

from pydantic import Field

from meshforge.formats import DecomposeBy
from meshforge.studio.wire import Wire

JobKind = Literal["read", "apply", "decompose", "preview", "rebuild", "export", "add", "label", "check", "goal"]
JobStatus = Literal["done", "edited", "unchanged", "failed", "skipped"]


class JobLine(Wire):
    """What became of one asset in a job. before: what was done to a new asset before the program, in sentences;
    picture: the key of that of a goal that fails; body, hulls: one in which these hulls were found to span parts."""

    asset: str
    status: JobStatus
    text: str = ""
    before: tuple[str, ...] = ()
    picture: str | None = None
    body: str | None = None
    hulls: tuple[str, ...] = ()


class Job(Wire):
    """Work that takes long. done, total: of the things to do now; doing: what that is, empty where the title says it;
    left: [s] that they may still take at this rate, null where that is not known; lines: what became of assets, at
    most 200: those that failed first, then those that were prepared before.

    message: its result in a sentence; out: the folder that was written.
    """

    id: str
    kind: JobKind
    title: str
    done: int = 0
    total: int = 0
    doing: str = ""
    left: float | None = None
    state: Literal["running", "done", "failed", "cancelled"] = "running"
    message: str = ""
    lines: tuple[JobLine, ...] = ()
    out: str | None = None


class ApplyJob(Wire):
    """Run the program on all assets, or on some; those that are new are prepared before. rebuild: whether bodies of
    these are rebuilt of which a hull spans parts, if the project's own were."""

    kind: Literal["apply"] = "apply"
    assets: tuple[str, ...] | None = None
    rebuild: bool = True


class DecomposeOptions(Wire):
    """How hulls are made of what has none. method: the tool that makes them, null for what made those of the project's
    other assets, else CoACD, whatever the rest says; by: of each piece as a whole, or of each of its parts by itself,
    where these are known; most: hulls of a piece; threshold: of CoACD, the concavity at which splitting stops; null is
    what the tool takes by itself."""

    method: Literal["coacd", "vhacd"] | None = None
    by: DecomposeBy = "whole"
    most: int | None = Field(default=None, ge=1, le=4096)
    threshold: float | None = Field(default=None, ge=0.01, le=1)


class DecomposeJob(DecomposeOptions):
    """Make hulls for pieces and bodies that have none."""

    kind: Literal["decompose"] = "decompose"
    assets: tuple[str, ...]


class PreviewJob(DecomposeOptions):
    """Make the hulls of one asset to be looked at, and keep none. assets: those that they may be made for then."""

    kind: Literal["preview"] = "preview"
    asset: str
    assets: tuple[str, ...]


class RebuildJob(Wire):
    """Find the hulls of all assets that span parts, or rebuild some of their bodies. bodies: these by asset, null to
    find; every: whether they are all that were found, so that those of new assets are rebuilt likewise."""

    kind: Literal["rebuild"] = "rebuild"
    bodies: dict[str, tuple[str, ...]] | None = None
    every: bool = False


class ExportJob(Wire):
    """Copy outputs into a folder: those that are signed off, or all. folder: below the project, or absolute."""

    kind: Literal["export"] = "export"
    signed_only: bool = True
    folder: str = "export"


class LabelJob(Wire):
    """Label all hulls of the family from files, names, and the labels that there are, weighed together."""

    kind: Literal["label"] = "label"


class CheckJob(Wire):
    """Run all checks on the outputs of all assets, or try a goal on them that is not kept."""

    kind: Literal["check"] = "check"
    goal: str | None = None


JobRequest = ApplyJob | DecomposeJob | PreviewJob | RebuildJob | ExportJob | LabelJob | CheckJob
