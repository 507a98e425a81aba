"""Assets that `meshforge apply` prepares before the program: those that came to the project later, and others that are
given beside it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from meshforge import batch
from meshforge.cli.console import progress
from meshforge.cli.terminal import remark
from meshforge.common import format_share

if TYPE_CHECKING:
    from meshforge.project import NewAsset, NewAssetOptions, NewAssetResult, Project
    from meshforge.signoff import AssetConfidence

_PREPARED = 600.0  # seconds for an asset at least, as `meshforge prepare` gives it


@dataclass(frozen=True, eq=False, slots=True)
class NewAssets:
    """What became of new assets before the program, by id. changes: fields of the jobs of those that could be prepared;
    failed: the others, which no program is run on."""

    results: Mapping[str, NewAssetResult]
    changes: Mapping[str, Mapping[str, Any]]
    failed: Sequence[batch.Failed]

    @staticmethod
    def of(results: Mapping[str, NewAssetResult], changes: Mapping[str, Mapping[str, Any]]) -> NewAssets:
        """Return those that could be prepared, and those that could not."""
        failed = [
            batch.Failed(asset, f"it could not be prepared: {result.problem}", 0.0)
            for asset, result in results.items()
            if result.problem
        ]
        fine = {asset: result for asset, result in results.items() if not result.problem}
        own = {asset: {**changes.get(asset, {}), "notes": result.describe()} for asset, result in fine.items()}
        return NewAssets(fine, own, failed)

    @staticmethod
    def aside(made: Iterable[tuple[NewAsset, NewAssetResult]]) -> NewAssets:
        """Return those whose preparation and labels are kept beside the project."""
        rows = list(made)
        changes = {work.id: {"labels": work.labels, "preparation": work.preparation} for work, _ in rows}
        return NewAssets.of({work.id: result for work, result in rows}, changes)

    def update(self, jobs: Iterable[batch.AssetJob]) -> list[batch.AssetJob]:
        """Return the jobs as they are to be done now."""
        failed = {one.asset for one in self.failed}
        return [replace(job, **self.changes.get(job.id, {})) for job in jobs if job.id not in failed]


def prepare_given(
    project: Project, assets: Sequence[str], labels: Path | None, folder: Path, options: NewAssetOptions
) -> tuple[list[batch.AssetJob], NewAssets]:
    """Prepare assets that are given beside a project, with what is done kept in a folder; the job of each.

    One that is the project's own is taken as the project has it.
    """
    from meshforge.project import NewAsset, prepare_new_assets, read_preparation_plan  # lazy: 170 modules

    plan = read_preparation_plan(project)
    if plan.unclear:
        remark(plan.unclear)
    known = {path: asset for asset, path in project.every.ids.items()}
    given = batch.make_jobs(batch.expand(assets), labels)
    ours = {job.path: job for job in project.jobs({known[job.path] for job in given if job.path in known})}
    jobs = [replace(ours[job.path], id=job.id, base=job.base) if job.path in ours else job for job in given]
    new = [NewAsset(job.id, job.path, plan, job.labels) for job in given if job.path not in ours]
    found = NewAssets.aside(prepare_new_assets(project, new, folder, _with_stage(options)))
    return found.update(jobs), found


def prepare_later(project: Project, folder: Path | None, options: NewAssetOptions) -> NewAssets:
    """Prepare the assets that came to a project after the others were prepared.

    folder: where what is done is kept; None for in the project.
    """
    from meshforge.project import list_new, prepare_new_assets  # lazy: 170 modules that a program file does not need

    new, unclear = list_new(project)
    if unclear:
        remark(unclear)
    program = project.program()
    options = replace(_with_stage(options), guess=program is None or bool(program.labels_asked))
    if folder is None:
        return NewAssets.of({result.asset: result for result in project.prepare_new(options)}, {})
    return NewAssets.aside(prepare_new_assets(project, new, folder, options))


def _with_stage(options: NewAssetOptions) -> NewAssetOptions:
    execution = options.execution
    if execution.timeout is not None:
        execution = replace(execution, timeout=max(execution.timeout, _PREPARED))
    return replace(options, execution=execution, stage=progress)


def to_needs_review(found: AssetConfidence, out: Path) -> batch.NeedsReview:
    """Hold an asset back, since its edit is not sure enough."""
    written = batch.read_stamp(out, found.asset)
    kept = str(out / written.out) if written and written.out else None
    reason = found.reasons[0].text if found.reasons else "no single doubt stands out"
    why = f"{format_share(found.probability)} sure; {reason}"
    why += "; the output of an earlier run stays as it is" if kept else ""
    return batch.NeedsReview(
        found.asset, found.probability, tuple(reason.to_json() for reason in found.reasons), why, kept
    )
