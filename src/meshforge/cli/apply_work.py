"""What is typed after `meshforge apply`, and what is to be run on what by that."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from meshforge import batch
from meshforge.cli import options
from meshforge.cli.console import progress
from meshforge.cli.terminal import remark
from meshforge.common import UsageError, join_names, suggest_name
from meshforge.language import Program, Template

if TYPE_CHECKING:
    from meshforge.project import NewAsset, NewAssetOptions, NewAssetResult, Project, ProjectReview
    from meshforge.signoff import ResultStatus


@dataclass(frozen=True, slots=True)
class ApplyArguments:
    """What is typed after `meshforge apply`."""

    program: Annotated[Path, typer.Argument(help="A program file (*.mf) or a project folder.")]
    assets: Annotated[
        list[str] | None,
        typer.Argument(
            help="Files, folders or globs; with a project they are prepared as it says, by default its own."
        ),
    ] = None
    out: Annotated[
        Path | None,
        typer.Option("-o", "--out", help="Folder for the edited assets; for its own a project has one, edited/."),
    ] = None
    labels: options.LabelsPath = None
    execution: options.ExecutionArguments = options.EXECUTION
    mass: Annotated[
        Literal["keep", "recompute"], typer.Option("--mass", help="Masses that a format derives from geometry.")
    ] = "keep"
    names: options.MarkNames = None
    collision: options.CollisionPlace = "beside"
    urdf_capsules: options.UrdfCapsules = False
    link: Annotated[bool, typer.Option("--link", help="Hard-link files that are only copied.")] = False
    dry_run: options.DryRun = False
    again: Annotated[bool, typer.Option("--again", help="Do again what an earlier run has done.")] = False
    report: options.ReportPath = None
    sarif: options.SarifPath = None
    junit: options.JunitPath = None
    check: Annotated[
        list[str] | None,
        typer.Option(
            "--check",
            help="fit, clearance, physics, speed, an engine or a check of a plug-in: checks for the report, of what it "
            "shows. May be repeated.",
        ),
    ] = None
    min_confidence: Annotated[
        float | None,
        typer.Option(
            "--min-confidence",
            help="Write only results that are right with this probability, or were looked at.",
            min=0.5,
            max=1.0,
        ),
    ] = None
    accept_outliers: Annotated[
        bool, typer.Option("--accept-outliers", help="Exit with 0 also where results of a project stand out.")
    ] = False
    no_rebuild: Annotated[
        bool, typer.Option("--no-rebuild", help="Leave bodies of new assets as they are; name hulls that span parts.")
    ] = False
    json: options.Json = False


_PREPARED = 600.0  # seconds for an asset at least, as `meshforge prepare` gives it
Alarms = Mapping[str, Sequence[str]]
"""Sentences about results that stand out, by asset."""


@dataclass(frozen=True, eq=False, slots=True)
class NewAssets:
    """What became of new assets before the program, by id. changes: of their jobs, where these are kept elsewhere."""

    results: Mapping[str, NewAssetResult] = field(default_factory=dict)
    changes: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    @staticmethod
    def collect(made: Iterable[tuple[NewAsset, NewAssetResult]]) -> NewAssets:
        """Return those whose preparation and labels are kept beside the project."""
        rows = {work.id: (work, result) for work, result in made}
        changes = {id: {"labels": work.labels, "preparation": work.preparation} for id, (work, _) in rows.items()}
        return NewAssets({id: result for id, (_, result) in rows.items()}, changes)

    @property
    def failed(self) -> list[batch.Failed]:
        """Those that could not be prepared, so that no program runs on them."""
        return [one.failure for one in self.results.values() if one.failure]

    @property
    def prepared(self) -> dict[str, NewAssetResult]:
        """All others."""
        return {asset: one for asset, one in self.results.items() if not one.problem}

    def update(self, jobs: Iterable[batch.AssetJob]) -> list[batch.AssetJob]:
        """Return the jobs as they are to be done now."""
        failed = {one.asset for one in self.failed}
        own = {id: {**self.changes.get(id, {}), "notes": one.describe()} for id, one in self.results.items()}
        return [replace(job, **own.get(job.id, {})) for job in jobs if job.id not in failed]


@dataclass(frozen=True, slots=True)
class ApplyWork:
    """What is to be run on what. need_review: assets that are not written; project: None where its own assets are not
    meant; confidences: how sure the edits of assets are that are not the project's, as far as asked."""

    program: Program
    jobs: Sequence[batch.AssetJob]
    out: Path
    templates: Mapping[str, Template]
    need_review: Sequence[batch.NeedsReview] = ()
    project: Project | None = None
    new: NewAssets = field(default_factory=NewAssets)
    confidences: Mapping[str, ResultStatus] = field(default_factory=dict)

    def readers(self, assets: Iterable[str]) -> Sequence[batch.MeshReader]:
        """Return functions that read assets as they were before the run."""
        if self.project:
            return self.project.readers(assets)
        by_id = {job.id: job for job in self.jobs}
        return [partial(batch.read_job, by_id[asset]) for asset in assets]

    def renew_sign_offs(self, alarms: Alarms) -> Mapping[str, str]:
        """Sign off what may be of the project's own outputs; say what is no longer signed off, and why, by asset."""
        is_own = self.project and self.out.absolute() == self.project.layout.edited
        return self.project.renew_sign_offs(alarms) if self.project and is_own else {}

    def describe_result_statuses(self) -> dict[str, dict[str, Any]]:
        """Return how sure each edit of a project is, as far as its last review holds, by asset."""
        rows = self.project.status().assets if self.project else ()
        result_statuses = {one.id: one.result_status.to_json() for one in rows}
        result_statuses |= {asset: one.to_json() for asset, one in self.confidences.items()}
        return result_statuses | {
            asset: {**result_statuses.get(asset, {}), **self.describe_new(asset)} for asset in self.new.prepared
        }

    def find_outliers(self, alarms: Alarms) -> list[str]:
        """Return the assets whose results stand out, and are neither demonstrated, accepted nor signed off."""
        rows = self.project.status().assets if self.project and alarms else ()
        known = {
            one.id
            for one in rows
            if one.result_status.state == "signed off" or one.review == "accepted" or one.demonstrated
        }
        return [asset for asset in alarms if asset not in known]

    def describe_new(self, asset: str) -> dict[str, Any]:
        """Return what was done to a new asset before, nothing of another."""
        result = self.new.prepared.get(asset)
        return result.to_json() if result else {}


def work_of_project(given: ApplyArguments, stack: ExitStack) -> ApplyWork:
    """Return what is run on assets of a project, or on others given beside it; stack: keeps a folder meanwhile."""
    from meshforge.project import NewAssetOptions, Project  # lazy: 170 modules that a program file does not need

    if given.labels and not given.assets:
        raise UsageError("a project has its own labels", remedy="Leave out --labels.")
    project = Project.open(given.program)
    if project.program() is None and project.work(()):  # else it raises
        remark("There is no program yet: assets are written as they are prepared, and nothing else is edited.")
    new_options = NewAssetOptions(rebuild=not given.no_rebuild, execution=given.execution.to_options())
    if given.assets:
        return _work_of_others(given, project, new_options, stack)
    out = given.out or project.layout.edited
    folder = Path(stack.enter_context(TemporaryDirectory())) if given.dry_run else None
    new = _prepare_later(project, folder, new_options)
    need_review = _list_unsure(project, out, given.min_confidence) if given.min_confidence is not None else ()
    program, jobs, templates = project.work()
    if away := [f"{asset} ({why})" for asset, why in project.exclusions().items() if asset in project.every.ids]:
        remark(f"excluded, and not edited: {join_names(away)}")
    names = {one.asset for one in need_review}
    rest = [job for job in new.update(jobs) if job.id not in names]
    return ApplyWork(program, rest, out, templates, need_review, project, new)


def _work_of_others(
    given: ApplyArguments, project: Project, new_options: NewAssetOptions, stack: ExitStack
) -> ApplyWork:
    from meshforge.project import assess_new_assets  # lazy: as above

    if given.out is None:
        raise UsageError("--out DIR is missing", remedy="meshforge apply PROJECT ASSETS... --out DIR")
    out = given.out
    if out.absolute() == project.layout.edited:
        raise UsageError("this folder is for the project's own assets", where=str(out), remedy="Choose another --out.")
    review = _review(project, given.min_confidence) if given.min_confidence is not None else None
    program, _, templates = project.work(())
    folder = Path(stack.enter_context(TemporaryDirectory())) if given.dry_run else out / batch.STATE
    new_options = replace(new_options, guess=bool(program.labels_asked))
    jobs, new = _prepare_given(project, given.assets or (), given.labels, folder, new_options)
    found: dict[str, ResultStatus] = {}
    need_review: tuple[batch.NeedsReview, ...] = ()
    if review and given.min_confidence is not None:
        found = assess_new_assets(project, review, jobs, new.prepared, new_options.execution)
        unsure = [asset for asset, one in found.items() if one.confidence < given.min_confidence]
        unsure.sort(key=lambda asset: found[asset].confidence)
        need_review = _leave_out(unsure, found, out)
    names = {one.asset for one in need_review}
    rest = [job for job in jobs if job.id not in names]
    return ApplyWork(program, rest, out, templates, need_review, new=new, confidences=found)


def _review(project: Project, threshold: float) -> ProjectReview:
    program = project.program()
    with progress(None, "looking at the family"):
        found = project.review(threshold)
    if program != project.program():
        remark("The program was learned again from what was said since.")
    return found


def _list_unsure(project: Project, out: Path, threshold: float) -> tuple[batch.NeedsReview, ...]:
    found = _review(project, threshold).assessment
    return _leave_out(found.need_review, found.assets, out)


def work_of_program(given: ApplyArguments) -> ApplyWork:
    """Return what is run on assets without a project."""
    if given.min_confidence is not None:
        raise UsageError("--min-confidence needs a project: a program alone does not say how sure its results are")
    if given.no_rebuild:
        raise UsageError("--no-rebuild needs a project: a program alone rebuilds no bodies")
    if not given.program.exists():
        names = (path.name for path in given.program.parent.glob("*") if path.suffix == ".mf" or path.is_dir())
        near = suggest_name(given.program.name, names)
        raise UsageError("there is no such project or program", where=str(given.program), remedy=near)
    if not given.assets or given.out is None:
        lacking = "assets" if not given.assets else "--out DIR"
        raise UsageError(f"{lacking} is missing", remedy="meshforge apply PROGRAM ASSETS... --out DIR")
    program = Program.read(given.program)
    templates = batch.load_templates(program.templates, batch.template_folders(given.program))
    jobs = batch.make_jobs(batch.expand(given.assets), given.labels)
    return ApplyWork(program, jobs, given.out, templates)


def _prepare_given(
    project: Project, assets: Sequence[str], labels: Path | None, folder: Path, options: NewAssetOptions
) -> tuple[list[batch.AssetJob], NewAssets]:
    """Prepare assets that are given beside a project, with what is done kept in a folder; the job of each. One that is
    the project's own is taken as the project has it."""
    from meshforge.project import NewAsset, prepare_new_assets, read_preparation_plan  # lazy: 170 modules

    plan = read_preparation_plan(project)
    if plan.unclear:
        remark(plan.unclear)
    known = {path: asset for asset, path in project.every.ids.items()}
    given = batch.make_jobs(batch.expand(assets), labels)
    ours = {job.path: job for job in project.jobs({known[job.path] for job in given if job.path in known})}
    jobs = [replace(ours[job.path], id=job.id, base=job.base) if job.path in ours else job for job in given]
    new = [NewAsset(job.id, job.path, plan, job.labels) for job in given if job.path not in ours]
    found = NewAssets.collect(prepare_new_assets(project, new, folder, _with_stage(options)))
    return found.update(jobs), found


def _prepare_later(project: Project, folder: Path | None, options: NewAssetOptions) -> NewAssets:
    """Prepare the assets that came to a project after the others were prepared. folder: where what is done is kept;
    None for in the project."""
    from meshforge.project import list_new, prepare_new_assets  # lazy: 170 modules that a program file does not need

    new, unclear = list_new(project)
    if unclear:
        remark(unclear)
    program = project.program()
    options = replace(_with_stage(options), guess=program is None or bool(program.labels_asked))
    if folder is None:
        return NewAssets({result.asset: result for result in project.prepare_new(options)})
    return NewAssets.collect(prepare_new_assets(project, new, folder, options))


def _with_stage(options: NewAssetOptions) -> NewAssetOptions:
    execution = options.execution
    if execution.timeout is not None:
        execution = replace(execution, timeout=max(execution.timeout, _PREPARED))
    return replace(options, execution=execution, stage=progress)


def _leave_out(assets: Iterable[str], found: Mapping[str, ResultStatus], out: Path) -> tuple[batch.NeedsReview, ...]:
    """Hold assets back, since their edits are not sure enough."""
    rows = ((asset, batch.read_stamp(out, asset)) for asset in assets)
    return tuple(
        batch.NeedsReview(asset, found[asset], str(out / kept.out) if kept and kept.out else None)
        for asset, kept in rows
    )
