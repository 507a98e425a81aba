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
from meshforge.cli.apply_new import prepare_given, prepare_later, to_needs_review
from meshforge.cli.console import progress
from meshforge.cli.terminal import remark
from meshforge.common import UsageError, join_names, suggest_name
from meshforge.language import Program, Template

if TYPE_CHECKING:
    from meshforge.project import NewAssetOptions, NewAssetResult, Project, ProjectReview
    from meshforge.signoff import AssetConfidence


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
    check: Annotated[
        list[str] | None,
        typer.Option(
            "--check",
            help="fit, clearance, physics, an engine or a check of a plug-in: checks for the report, of what it shows. "
            "May be repeated.",
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


Alarms = Mapping[str, Sequence[str]]
"""Sentences about results that stand out, by asset."""


@dataclass(frozen=True, slots=True)
class ApplyWork:
    """What is to be run on what. need_review: assets that are not written; project: None where its own assets are not
    meant; new: what was done to new assets before, by id; failed: those of them that could not be prepared;
    confidences: how sure the edits of assets are that are not the project's, as far as asked."""

    program: Program
    jobs: Sequence[batch.AssetJob]
    out: Path
    templates: Mapping[str, Template]
    need_review: Sequence[batch.NeedsReview] = ()
    project: Project | None = None
    new: Mapping[str, NewAssetResult] = field(default_factory=dict)
    failed: Sequence[batch.Failed] = ()
    confidences: Mapping[str, AssetConfidence] = field(default_factory=dict)

    @staticmethod
    def of(given: ApplyArguments, stack: ExitStack) -> ApplyWork:
        """Return what was asked for; stack: keeps a folder for as long as the run takes."""
        return _work_of_project(given, stack) if given.program.is_dir() else _work_of_program(given)

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
        result_statuses = {one.id: one.confidence_to_json() for one in rows}
        result_statuses |= {
            asset: {"probability": round(one.probability, 4), "reasons": [reason.to_json() for reason in one.reasons]}
            for asset, one in self.confidences.items()
        }
        return result_statuses | {
            asset: {**result_statuses.get(asset, {}), **self.describe_new(asset)} for asset in self.new
        }

    def find_outliers(self, alarms: Alarms) -> list[str]:
        """Return the assets whose results stand out, and are neither demonstrated, accepted nor signed off."""
        rows = self.project.status().assets if self.project and alarms else ()
        known = {one.id for one in rows if one.sign_off == "signed off" or one.review == "accepted" or one.demonstrated}
        return [asset for asset in alarms if asset not in known]

    def describe_new(self, asset: str) -> dict[str, Any]:
        """Return what was done to a new asset before, nothing of another."""
        return self.new[asset].to_json() if asset in self.new else {}


def _work_of_project(given: ApplyArguments, stack: ExitStack) -> ApplyWork:
    """What is run on assets of a project or others given beside it; stack: keeps a folder for as long as that takes."""
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
    new = prepare_later(project, folder, new_options)
    need_review = _list_unsure(project, out, given.min_confidence) if given.min_confidence is not None else ()
    program, jobs, templates = project.work()
    if away := [f"{asset} ({why})" for asset, why in project.exclusions().items() if asset in project.every.ids]:
        remark(f"excluded, and not edited: {join_names(away)}")
    names = {one.asset for one in need_review}
    rest = [job for job in new.update(jobs) if job.id not in names]
    return ApplyWork(program, rest, out, templates, need_review, project, new.results, new.failed)


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
    jobs, new = prepare_given(project, given.assets or (), given.labels, folder, new_options)
    found: dict[str, AssetConfidence] = {}
    need_review: tuple[batch.NeedsReview, ...] = ()
    if review and given.min_confidence is not None:
        found = assess_new_assets(project, review, jobs, new.results, new_options.execution)
        unsure = (one for one in found.values() if one.probability < given.min_confidence)
        need_review = tuple(to_needs_review(one, out) for one in sorted(unsure, key=lambda one: one.probability))
    names = {one.asset for one in need_review}
    rest = [job for job in jobs if job.id not in names]
    return ApplyWork(program, rest, out, templates, need_review, new=new.results, failed=new.failed, confidences=found)


def _review(project: Project, threshold: float) -> ProjectReview:
    program = project.program()
    with progress(None, "looking at the family"):
        found = project.review(threshold)
    if program != project.program():
        remark("The program was learned again from what was said since.")
    return found


def _list_unsure(project: Project, out: Path, threshold: float) -> tuple[batch.NeedsReview, ...]:
    assessment = _review(project, threshold).assessment
    return tuple(to_needs_review(assessment.assets[name], out) for name in assessment.need_review)


def _work_of_program(given: ApplyArguments) -> ApplyWork:
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
