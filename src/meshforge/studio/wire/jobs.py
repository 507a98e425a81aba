"""Long work: its progress, and what came of it."""

from __future__ import annotations

from typing import Literal

from meshforge.studio.wire.base import Wire

JobKind = Literal["read", "apply", "decompose", "export", "add", "propagate", "forecast", "ask", "check"]


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


Mode = Literal["cheap", "balanced", "exact"]
"""How many pictures and questions a model is asked for a hull."""


class ForecastJob(Wire):
    """Find out what asking a model for labels would send and cost; nothing is sent."""

    kind: Literal["forecast"] = "forecast"
    mode: Mode


class AskJob(Wire):
    """Ask the model that meshforge.toml names for labels. max_cost: dollars it may spend, null as that says."""

    kind: Literal["ask"] = "ask"
    mode: Mode
    max_cost: float | None = None


class CheckJob(Wire):
    """Measure the outputs of all assets in every way."""

    kind: Literal["check"] = "check"


JobRequest = ApplyJob | DecomposeJob | ExportJob | PropagateJob | ForecastJob | AskJob | CheckJob
