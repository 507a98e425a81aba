"""Jobs: what the page asks for, their progress and outcome; what an edit of all labels did, and the model that can
be asked."""

from __future__ import annotations

from typing import Literal

from meshforge.studio.wire import Wire

JobKind = Literal["read", "apply", "decompose", "export", "add", "propagate", "forecast", "ask", "check"]

VlmMode = Literal["cheap", "balanced", "exact"]
"""How many pictures and questions a model is asked for a hull."""

LabelEditKind = Literal["propagate", "label-files", "label-names", "label-vlm"]


class JobLine(Wire):
    """What became of one asset in a job."""

    asset: str
    status: Literal["done", "edited", "unchanged", "failed", "skipped"]
    text: str = ""


class Job(Wire):
    """Work that takes long. state: how it stands; lines: what became of assets, those that failed first, at most 200.

    message: its result in a sentence; out: the folder that was written.
    """

    id: str
    kind: JobKind
    title: str
    done: int = 0
    total: int = 0
    state: Literal["running", "done", "failed", "cancelled"] = "running"
    message: str = ""
    lines: tuple[JobLine, ...] = ()
    out: str | None = None


class ApplyJob(Wire):
    """Run the program on all assets, or on some."""

    kind: Literal["apply"] = "apply"
    assets: tuple[str, ...] | None = None


class DecomposeJob(Wire):
    """Make hulls of what has none; method: the tool that does it."""

    kind: Literal["decompose"] = "decompose"
    assets: tuple[str, ...]
    method: Literal["coacd", "vhacd"] = "coacd"


class ExportJob(Wire):
    """Copy outputs into a folder: those that were accepted, or all. folder: below the project, or absolute."""

    kind: Literal["export"] = "export"
    accepted_only: bool = True
    folder: str = "export"


class PropagateJob(Wire):
    """Carry the labels that people and files gave over to all other hulls of the family."""

    kind: Literal["propagate"] = "propagate"


class ForecastJob(Wire):
    """Find out what asking a model for labels would send and cost; nothing is sent."""

    kind: Literal["forecast"] = "forecast"
    mode: VlmMode


class AskJob(Wire):
    """Ask the model that meshforge.toml names for labels. max_cost: dollars it may spend, null as that says."""

    kind: Literal["ask"] = "ask"
    mode: VlmMode
    max_cost: float | None = None


class CheckJob(Wire):
    """Measure the outputs of all assets in every way."""

    kind: Literal["check"] = "check"


JobRequest = ApplyJob | DecomposeJob | ExportJob | PropagateJob | ForecastJob | AskJob | CheckJob


class RelabelledAsset(Wire):
    """Hulls of an asset that got another label, by their positions. new: those that had none; changed: those that had
    another one; was: the label that each of these had."""

    asset: str
    new: tuple[int, ...] = ()
    changed: tuple[int, ...] = ()
    was: tuple[str, ...] = ()


class Relabelled(Wire):
    """What the last edit did, where that was one of all labels. entry: its number in the history; way: what it was.

    settled: how many labels are sure since, which were not before.
    """

    entry: int
    way: LabelEditKind
    assets: tuple[RelabelledAsset, ...]
    settled: int = 0


class CarriedOver(Wire):
    """Labels were carried over. unused: how many labels people and files gave since; next: the asset that would help
    most if it were labelled, null where its hulls are, or where all are."""

    unused: int
    next: str | None = None


class Model(Wire):
    """The model that can be asked for labels. host: where it is; mode, max_cost: as meshforge.toml has them; why: what
    is in the way of asking it, null where nothing is."""

    name: str
    host: str
    mode: VlmMode
    max_cost: float | None = None
    why: str | None = None
