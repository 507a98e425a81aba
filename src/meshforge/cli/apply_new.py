"""Assets that `meshforge apply` prepares before the program: those that came to the project later, and others that are
given beside it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge import batch
from meshforge.cli.console import progress
from meshforge.cli.terminal import remark

if TYPE_CHECKING:
    from meshforge.project import NewAssetOptions, NewAssetResult, Project
    from meshforge.signoff import AssetConfidence

_PREPARED = 600.0  # seconds for an asset at least, as `meshforge prepare` gives it


@dataclass(frozen=True, eq=False, slots=True)
class NewAssets:
    """What became of new assets before the program. jobs: of those that could be prepared; failed: the others."""

    jobs: Sequence[batch.AssetJob]
    results: Mapping[str, NewAssetResult]
    failed: Sequence[batch.Failed]


def prepare_given(
    project: Project, assets: Sequence[str], labels: Path | None, folder: Path, options: NewAssetOptions
) -> NewAssets:
    """Prepare assets that are given beside a project, with what is done kept in a folder.

    One that is the project's own is taken as the project has it.
    """
    from meshforge.project import NewAsset, prepare_aside, read_preparation_plan  # lazy: 170 modules

    plan = read_preparation_plan(project)
    if plan.unclear:
        remark(plan.unclear)
    known = {path: asset for asset, path in project.found.ids.items()}
    given = batch.make_jobs(batch.expand(assets), labels)
    _, own, _ = project.work({known[job.path] for job in given if job.path in known})
    ours = {job.path: job for job in own}
    jobs = {job.id: replace(ours[job.path], id=job.id, base=job.base) if job.path in ours else job for job in given}
    new = [NewAsset(job.id, job.path, plan, job.labels) for job in given if job.path not in ours]
    results: dict[str, NewAssetResult] = {}
    for work, result in prepare_aside(project, new, folder, _with_stage(options)):
        results[work.id] = result
        jobs[work.id] = replace(
            jobs[work.id], labels=work.labels, preparation=work.preparation, notes=result.describe()
        )
    return _sort_out(jobs, results)


def prepare_later(
    project: Project, jobs: Sequence[batch.AssetJob], folder: Path | None, options: NewAssetOptions
) -> NewAssets:
    """Prepare the assets of some jobs that came to a project after the others were prepared.

    folder: where what is done is kept; None for in the project.
    """
    from meshforge.project import (  # lazy: 170 modules
        NewAsset,
        extend_plan,
        find_new_assets,
        prepare_aside,
        prepare_in_project,
    )

    plans, unclear = find_new_assets(project)
    if unclear:
        remark(unclear)
    by_id, layout = {job.id: job for job in jobs}, project.layout
    new = [
        NewAsset(job.id, job.path, plans[job.id], job.labels, layout.preparation(job.id))
        for job in jobs
        if job.id in plans
    ]
    options = _with_stage(options)
    results: dict[str, NewAssetResult] = {}
    if folder is not None:
        for work, result in prepare_aside(project, new, folder, options):
            by_id[work.id] = replace(by_id[work.id], labels=work.labels, preparation=work.preparation)
            results[work.id] = result
    else:
        results = {result.asset: result for result in prepare_in_project(project, new, options)}
        done = [asset for asset, result in results.items() if not result.problem]
        extend_plan(project, done, decomposed=unclear is None, split=options.split)
        by_id |= {job.id: job for job in project.work(done)[1]} if done else {}
    noted = {asset: replace(by_id[asset], notes=result.describe()) for asset, result in results.items()}
    return _sort_out(by_id | noted, results)


def _with_stage(options: NewAssetOptions) -> NewAssetOptions:
    execution = options.execution
    if execution.timeout is not None:
        execution = replace(execution, timeout=max(execution.timeout, _PREPARED))
    return replace(options, execution=execution, stage=progress)


def _sort_out(jobs: Mapping[str, batch.AssetJob], results: Mapping[str, NewAssetResult]) -> NewAssets:
    """The assets that could be prepared, and the others, which no program is run on."""
    failed = {
        asset: batch.Failed(asset, f"it could not be prepared: {result.problem}", 0.0)
        for asset, result in results.items()
        if result.problem
    }
    fine = {asset: result for asset, result in results.items() if asset not in failed}
    return NewAssets([job for job in jobs.values() if job.id not in failed], fine, tuple(failed.values()))


def hold_new(confidences: Mapping[str, AssetConfidence], bar: float, out: Path) -> tuple[batch.Held, ...]:
    """The new assets whose edits are less sure than a bar, the least sure first."""
    unsure = sorted((one for one in confidences.values() if one.probability < bar), key=lambda one: one.probability)
    return tuple(hold(one.asset, one, out) for one in unsure)


def hold(asset: str, found: AssetConfidence | None, out: Path, why: str | None = None) -> batch.Held:
    """An asset that is held back, since its edit is not sure enough; why: another reason."""
    from meshforge.project import format_share  # lazy: 170 modules that a program file does not need

    written = batch.read_stamp(out, asset)
    kept = str(out / written.out) if written and written.out else None
    if found and not why:
        doubt = found.doubts[0].text if found.doubts else "no single doubt stands out"
        why = f"{format_share(found.probability)} sure; {doubt}"
    why = why or ""
    if kept:
        why += "; the output of an earlier run stays as it is"
    doubts = tuple(doubt.to_json() for doubt in found.doubts) if found else ()
    return batch.Held(asset, found.probability if found else 0.0, doubts, why, kept)


def remark_new(results: Mapping[str, NewAssetResult]) -> None:
    """Say how many hulls of new assets were split, and how many were left that likely span parts."""
    from meshforge.project import describe_new  # lazy: 170 modules

    if text := describe_new(list(results.values())):
        remark(text)
