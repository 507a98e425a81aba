"""A program run over many assets: each becomes a draft of its output in a worker process, and is then put in place."""

import shutil
import time
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, nullcontext
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from meshforge import formats
from meshforge.batch import outputs, provenance
from meshforge.batch.discovery import STATE
from meshforge.batch.execution import execute
from meshforge.batch.jobs import APPLY_DEFAULTS, ApplyOptions, ApplyTask, AssetJob, inputs_of
from meshforge.batch.lock import hold_lock
from meshforge.batch.manual_edits import replay_manual_edits, selections_of
from meshforge.batch.outcome import AssetOutcome, Edited, Failed, RuleEffect, Unchanged
from meshforge.batch.preparation.decompose import replace_concave
from meshforge.batch.preparation.storage import prepare_from_folder
from meshforge.batch.workers import EXECUTION_DEFAULTS, ExecutionOptions, WorkerFailure
from meshforge.common import AssetError, UsageError, describe_error, join_names
from meshforge.geometry import proximity  # noqa: F401  # coal is there when workers are forked
from meshforge.language import Program, RuleTrace, Template
from meshforge.signoff import measure_edit
from meshforge.symbolic import Asset, LabelTransfer, SymbolicMesh, transfer_labels

_MEMORY = "More for one asset: --memory, or fewer --workers. The other assets are not affected."


def apply(
    program: Program,
    assets: Iterable[AssetJob],
    out: Path,
    *,
    templates: Mapping[str, Template] | None = None,
    options: ApplyOptions = APPLY_DEFAULTS,
    execution: ExecutionOptions = EXECUTION_DEFAULTS,
) -> Iterator[AssetOutcome]:
    """Run a program on assets and write each into `out`; one outcome an asset, in the order given.

    The outcomes come as the work goes on; an asset is in place when its outcome is there. What one asset does wrong
    is its own outcome. Outcomes and files do not depend on the number of workers, nor on where they are.

    Raises UsageError for arguments that do not fit, MeshForgeError when another run is writing into `out`,
    StoppedError when `execution.stop` said so: what is in place by then stays.
    """
    jobs = tuple(assets)
    task = ApplyTask(program, dict(templates or {}), Path(out).absolute(), options)
    _check_arguments(jobs, task)
    return _run_task(jobs, task, execution)


def _run_task(jobs: tuple[AssetJob, ...], task: ApplyTask, execution: ExecutionOptions) -> Iterator[AssetOutcome]:
    with ExitStack() as stack:
        ledger = None
        if not task.options.dry_run:
            stack.enter_context(hold_lock(task.out / STATE / "lock", str(task.out), wait=0))
            stack.callback(shutil.rmtree, outputs.drafts_folder(task.out), ignore_errors=True)
            shutil.rmtree(outputs.drafts_folder(task.out), ignore_errors=True)
            ledger = outputs.OutputFolder(task.out, (job.id for job in jobs))
        results = execute(partial(edit_asset, task), jobs, execution)
        stack.callback(results.close)  # the workers stop first, so that none writes a draft any more
        for job, result in zip(jobs, results, strict=True):
            if isinstance(result, WorkerFailure):
                why = f"{job.path}: {result.why}\n  The other assets are not affected."
                result = outputs.WorkerResult(Failed(job.id, why, result.seconds))
            yield ledger.commit(result) if ledger else result.outcome


def _check_arguments(jobs: tuple[AssetJob, ...], task: ApplyTask) -> None:
    options = task.options
    if options.names and options.to:
        formats.format_with_names(formats.format_for(Path(f"asset{options.to}"), ""), options.names)
    seen: dict[str, Path] = {}
    for job in jobs:
        if job.id in seen:
            raise UsageError(f"two assets have the id {job.id!r}: {seen[job.id]} and {job.path}")
        seen[job.id] = job.path
        if options.names and options.to is None:
            _refuse_names(job, options.names)
        if job.base.absolute() == task.out:
            raise UsageError(
                "the output folder is the folder of the assets", where=str(task.out), remedy="Choose another --out."
            )


def _refuse_names(job: AssetJob, names: formats.MarkName) -> None:
    """Raise UsageError where collision cannot be marked so in the format of an asset."""
    try:
        known = formats.format_of(formats.resolve_asset_path(job.path))
    except AssetError:
        return  # that asset fails by itself
    try:
        formats.format_with_names(known, names)
    except UsageError as error:
        raise error.at(str(job.path)) from None


def edit_asset(task: ApplyTask, job: AssetJob) -> outputs.WorkerResult:
    """Run a task on one asset. Never raises: whatever goes wrong is the asset's outcome."""
    started, inputs = time.perf_counter(), None
    try:
        skipped = _find_up_to_date(task, job)
        if skipped:
            return skipped
        asset = formats.read(job.path)
        asset.refuse_missing()
        inputs = inputs_of(task, job, provenance.asset_digests(job.path, asset.files, job.base))
        ready = prepare_from_folder(asset, job.preparation) if job.preparation else asset
        ready = replace_concave(ready, task.options.concave)
        return _run_program(task, job, ready, inputs, started)
    except MemoryError:
        why = f"{job.path}: there is not enough memory for it\n  {_MEMORY}"
        return outputs.WorkerResult(Failed(job.id, why, time.perf_counter() - started), inputs)
    except Exception as error:  # a failed asset never stops the others
        failed = Failed(job.id, describe_error(error, str(job.path)), time.perf_counter() - started)
        return outputs.WorkerResult(failed, inputs, disk=outputs.find_disk_problem(error))


def _find_up_to_date(task: ApplyTask, job: AssetJob) -> outputs.WorkerResult | None:
    """The outcome `skipped`, where the output of an earlier run is whole and made from the same."""
    stamp = provenance.read_stamp(task.out, job.id) if task.options.resume else None
    if not stamp or not stamp.inputs or inputs_of(task, job, stamp.inputs.asset) != stamp.inputs:
        return None
    if not provenance.has_same_files(stamp.inputs.asset, job.path, job.base) or not stamp.is_whole(task.out):
        return None
    return outputs.WorkerResult(stamp.to_skipped(task.out))


def _run_program(
    task: ApplyTask, job: AssetJob, asset: Asset, inputs: provenance.OutputInputs, started: float
) -> outputs.WorkerResult:
    labels = job.read_labels()
    followed = transfer_labels(labels, SymbolicMesh.of(asset))
    source = followed.mesh
    result = task.program.run(source, task.templates, selections=selections_of(job.selections, task.program))
    mesh, flags = replay_manual_edits(job.manual_edits, source, result.mesh, task.program, task.templates)
    with TemporaryDirectory() if task.options.dry_run else nullcontext() as draft_folder:
        draft = outputs.plan_draft(task, job, asset, Path(draft_folder) if draft_folder else None)
        draft = outputs.write_draft(draft, mesh, labels.vocabulary or task.program.labels, task.options)
    outcome = (Unchanged if _has_same_hulls(source, mesh) and not job.preparation else Edited)(
        asset=job.id,
        out=str(task.out / draft.main),
        rules=tuple(_list_effects(source, mesh, result.trace)),
        before=len(source.hulls),
        after=len(mesh.hulls),
        seconds=time.perf_counter() - started,
        notes=(*job.notes, *draft.read_notes, *_label_notes(followed), *draft.notes),
        flags=flags,
        measures=measure_edit(source, mesh, trace=result.trace),
        labels=tuple(sorted({hull.label for hull in source.hulls if hull.label})),
    )
    if task.options.dry_run:
        return outputs.WorkerResult(outcome)
    provenance.Stamp.of(outcome, inputs, draft).write(draft.root / outputs.DRAFT_STAMP)
    return outputs.WorkerResult(replace(outcome, seconds=time.perf_counter() - started), draft=draft)


def _list_effects(source: SymbolicMesh, mesh: SymbolicMesh, trace: Iterable[RuleTrace]) -> Iterator[RuleEffect]:
    named = mesh.names_in_file
    left = {named.get(hull.name, hull.name) for hull in mesh.hulls}
    for line in trace:
        gone = tuple(name for name in line.selected if line.made and name in source.index and name not in left)
        made = tuple(named.get(name, name) for name in line.made)
        yield RuleEffect(line.rule, line.selected, made, line.note, gone)


def _label_notes(followed: LabelTransfer) -> tuple[str, ...]:
    """What a person should know about labels that were given to another state of the asset."""
    kinds = (
        ("labels followed renamed hulls", [f"{old} to {new}" for old, new in followed.renamed]),
        ("hulls changed since they were labelled", followed.changed),
        ("labels of hulls that are gone were left out", followed.gone),
    )
    return tuple(f"{what}: {join_names(names)}" for what, names in kinds if names)


def _has_same_hulls(before: SymbolicMesh, after: SymbolicMesh) -> bool:
    return len(before.hulls) == len(after.hulls) and all(
        a.name == b.name and a.shape is b.shape for a, b in zip(before.hulls, after.hulls, strict=True)
    )
