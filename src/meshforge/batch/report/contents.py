"""What the report is about: the assets that it shows and their pictures, and the figures of the whole run."""

from __future__ import annotations

import base64
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal

from meshforge.batch.execution import execute
from meshforge.batch.jobs import AssetJob
from meshforge.batch.outcome import RunSummary
from meshforge.batch.preparation.storage import read_prepared
from meshforge.batch.workers import EXECUTION_DEFAULTS, ExecutionOptions, WorkerFailure
from meshforge.checks import Examination, Finding, Speed, draw_examination
from meshforge.formats import load
from meshforge.language import RuleTrace
from meshforge.rendering import ColorBy, compare, draw_difference, render, to_data_url
from meshforge.symbolic import SymbolicMesh, transfer_labels

if TYPE_CHECKING:
    from meshforge.signoff import ResultStatus, ResultStatusWord


ReportStatus = Literal["edited", "unchanged", "skipped", "not written", "failed"]
"""What a program or a conversion made of an asset; not written: nothing, since its edit is not sure enough."""

MeshReader = Callable[[], SymbolicMesh]
"""Reads an asset, in this process or another."""
READ_TIMEOUT = 300.0
"""Seconds for one asset."""


@dataclass(frozen=True, eq=False, slots=True)
class ReportAsset:
    """One asset of a batch.

    before: None where the file could not be read; after: None where the program could not run on it.
    trace: of every rule; error: the whole message of a failed asset; demonstrated: whether a person edited it.
    notes: what else there is to say, as what the format had to write in another form; checked: what was measured of it
    after, where asked for; alarms: why the result stands out, a sentence each; standing: None without a project.
    """

    name: str
    before: SymbolicMesh | None
    after: SymbolicMesh | None = None
    trace: tuple[RuleTrace, ...] = ()
    status: ReportStatus = "edited"
    error: str | None = None
    demonstrated: bool = False
    notes: tuple[str, ...] = ()
    checked: Examination | None = None
    alarms: tuple[str, ...] = ()
    result_status: ResultStatus | None = None

    @property
    def counts(self) -> tuple[int, int] | None:
        """Numbers of hulls before and after, None unless both are known."""
        return (len(self.before.hulls), len(self.after.hulls)) if self.before and self.after else None

    @property
    def findings(self) -> list[Finding]:
        """What was found when it was checked, errors first."""
        return sorted(self.checked.findings if self.checked else (), key=lambda finding: finding.severity != "error")

    @property
    def has_errors(self) -> bool:
        """Whether an error was found when it was checked."""
        return any(finding.severity == "error" for finding in self.findings)

    @property
    def is_broken(self) -> bool:
        """Whether it failed, or an error was found when it was checked."""
        return self.status == "failed" or self.has_errors

    @property
    def needs_review(self) -> bool:
        """Whether it is to be looked at first: it needs review, or is broken."""
        return self.is_broken or bool(self.result_status and self.result_status.needs_review)

    @property
    def rank(self) -> tuple[bool, bool, float]:
        """Its place in an order of assets of a project: what needs review, then alarms, the least sure first."""
        return not self.needs_review, not self.alarms, self.result_status.confidence if self.result_status else -1.0

    @property
    def reasons(self) -> list[str]:
        """Why its edit may be wrong, a sentence each, but for alarms and goals."""
        reasons = self.result_status.reasons if self.result_status else ()
        return [one.text for one in reasons if one.kind not in ("alarm", "goal")]

    @property
    def kinds(self) -> list[str]:
        """The words by which the page can be filtered."""
        marks = (("demonstrated", self.demonstrated), ("doubtful", bool(self.findings or self.alarms)))
        words = [self.status, *([self.result_status.word] if self.result_status else [])]
        return [*words, *(word for word, holds in marks if holds)]


@dataclass(frozen=True, slots=True)
class RunFigures:
    """counts: of assets by what became of them; more: figures by name, each with a remark that is small.

    first: which of very many assets are shown first, in words; standings: of a project, how many assets stand how.
    """

    counts: Mapping[ReportStatus, int]
    more: Mapping[str, tuple[str, str | None]]
    first: str = "those that failed"
    result_statuses: Mapping[ResultStatusWord, int] = field(default_factory=dict)

    @property
    def total(self) -> int:
        """How many assets there were."""
        return sum(self.counts.values())

    @staticmethod
    def of_run(summary: RunSummary) -> RunFigures:
        """Return those of a program's run."""
        counts: dict[ReportStatus, int] = dict(summary.counts.items())
        counts |= {"not written": len(summary.need_review)} if summary.need_review else {}
        return RunFigures(counts, _hull_figures(summary.before, summary.after))

    @staticmethod
    def of_assets(assets: Iterable[ReportAsset]) -> RunFigures:
        """Return those of a run of which all assets are shown."""
        shown = list(assets)
        known = [asset.counts for asset in shown if asset.counts]
        before, after = (sum(counts[k] for counts in known) for k in (0, 1))
        result_statuses = Counter(asset.result_status.word for asset in shown if asset.result_status)
        return RunFigures(
            Counter(asset.status for asset in shown), _hull_figures(before, after), result_statuses=result_statuses
        )


def _hull_figures(before: int, after: int) -> dict[str, tuple[str, str | None]]:
    return {"hulls": (f"{before:,} → {after:,}", format_change(before, after))} if before or after else {}


def sum_speeds(assets: Iterable[ReportAsset]) -> dict[str, tuple[str, str | None]]:
    """Return what an edit is worth in MuJoCo over all assets whose speed was measured before and after."""
    found = [speed for asset in assets if asset.checked and (speed := asset.checked.get("speed", Speed))]
    runs = [(one.before, one.now) for one in found if one.before]
    if not runs:
        return {}
    contacts = [sum(pair[k].contacts for pair in runs) for k in (0, 1)]
    times = [sum(1000 / pair[k].steps for pair in runs) for k in (0, 1)]  # [ms]
    remark = f"{times[0] / times[1]:.1f} times as fast, measured on this machine"
    return {
        "contacts at the end": (f"{contacts[0]:,} → {contacts[1]:,}", format_change(*contacts)),
        "one step of all in MuJoCo": (f"{times[0]:.3g} ms → {times[1]:.3g} ms", remark),
    }


def read_again(
    readers: Sequence[MeshReader | None], execution: ExecutionOptions = EXECUTION_DEFAULTS
) -> list[SymbolicMesh | None]:
    """Return the meshes, in their order, read in worker processes: one that crashes or hangs costs no more than itself.

    None for what cannot be read any more, or has no reader. Raises StoppedError where `execution.stop` says so.
    """
    found = execute(_try_read, [reader for reader in readers if reader], replace(execution, timeout=READ_TIMEOUT))
    meshes = [next(found) if reader else None for reader in readers]
    return [None if isinstance(mesh, WorkerFailure) else mesh for mesh in meshes]


def read_job(job: AssetJob) -> SymbolicMesh:
    """Return an asset with its labels, as it is prepared. Raises as `load` and `read_prepared`."""
    mesh = SymbolicMesh.of(read_prepared(job.path, job.preparation)) if job.preparation else load(job.path)
    return transfer_labels(job.read_labels(), mesh).mesh


def _try_read(reader: MeshReader) -> SymbolicMesh | None:
    try:
        return reader()
    except Exception:  # why it cannot be read is reported already, or is not what the report is about
        return None


def format_change(before: int, after: int) -> str:
    """Return how much less or more, in per cent, with a true minus sign; `no change` where there is none."""
    if before == after:
        return "no change"
    if before == 0:
        return f"+{after}"
    share = round(100 * (after - before) / before)
    return f"{'−' if after < before else '+'}{abs(share)} %"


def format_duration(seconds: float) -> str:
    """Return seconds below two minutes with one decimal, else minutes."""
    return f"{seconds:.1f} s" if seconds < 120 else f"{seconds / 60:.0f} min"


PICTURE_SIZE = (600, 450)
CHECK_PICTURE_SIZE = (420, 315)


@dataclass(frozen=True, slots=True)
class PictureOptions:
    """How pictures are drawn.

    vocabulary: the order in which labels take their colours; by_label: whether hulls have those, else each its own.
    """

    vocabulary: tuple[str, ...]
    by_label: bool


@dataclass(frozen=True, slots=True)
class AssetPictures:
    """Addresses `data:…` of an asset's pictures; after and changes are None where nothing changed.

    checks, goals: what pictures of checks and of goals that fail show, and these.
    """

    before: str
    after: str | None = None
    changes: str | None = None
    checks: tuple[tuple[str, str], ...] = ()
    goals: tuple[tuple[str, str], ...] = ()


def draw_asset(asset: ReportAsset, options: PictureOptions) -> AssetPictures | None:
    """Return the pictures of an asset, on transparent ground; None where there is no mesh to be seen."""
    before, after = asset.before, asset.after
    if before is None:
        return None
    color_by: ColorBy = "label" if options.by_label else "hull"
    checks, goals = _draw_checks(asset, after or before), tuple(_read_goal_pictures(asset))
    if after is None or asset.status == "unchanged" or not (before.hulls or after.hulls):
        image = render(
            before, color_by=color_by, size=PICTURE_SIZE, vocabulary=options.vocabulary, background=None, legend=False
        )
        return AssetPictures(to_data_url(image), checks=checks, goals=goals)
    pair = compare(before, after, color_by=color_by, size=PICTURE_SIZE, vocabulary=options.vocabulary, background=None)
    changes = to_data_url(draw_difference(before, after, size=PICTURE_SIZE, background=None))
    return AssetPictures(to_data_url(pair[0]), to_data_url(pair[1]), changes, checks=checks, goals=goals)


def _draw_checks(asset: ReportAsset, mesh: SymbolicMesh) -> tuple[tuple[str, str], ...]:
    if asset.checked is None:
        return ()
    drawn = draw_examination(mesh, asset.checked, CHECK_PICTURE_SIZE)
    return tuple((words, to_data_url(image)) for _, words, image in drawn)


def _read_goal_pictures(asset: ReportAsset) -> Iterator[tuple[str, str]]:
    """What fails on an asset, and the address of its picture."""
    for goal in asset.result_status.goals if asset.result_status else ():
        if goal.picture and goal.picture.exists():
            picture = base64.b64encode(goal.picture.read_bytes()).decode()
            yield goal.describe(), f"data:image/png;base64,{picture}"
