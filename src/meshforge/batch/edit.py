"""One asset of a batch, from its file to a draft of its output; runs in a worker process."""

from __future__ import annotations

import time
from dataclasses import replace

from meshforge.batch.corrections import corrections_digest, replay_corrections
from meshforge.batch.jobs import ApplyTask, AssetJob
from meshforge.batch.outcome import Edited, Failed, RuleEffect, Unchanged
from meshforge.batch.outputs import DISK_ERRORS, DRAFT_STAMP, WorkerResult, plan_draft, write_draft
from meshforge.batch.preparation.storage import prepare_from_folder, record_digest
from meshforge.batch.provenance import (
    OutputInputs,
    Stamp,
    asset_digests,
    file_digest,
    has_same_files,
    program_digest,
    read_stamp,
    software_version,
    template_digests,
)
from meshforge.common import describe_error, join_names
from meshforge.formats import read
from meshforge.language import RunResult
from meshforge.symbolic import Asset, LabelFile, LabelTransfer, SymbolicMesh, read_labels, transfer_labels

_MEMORY = "More for one asset: --memory, or fewer --workers. The other assets are not affected."


def edit_asset(task: ApplyTask, job: AssetJob) -> WorkerResult:
    """Run a task on one asset. Never raises: whatever goes wrong is the asset's outcome."""
    started, inputs = time.perf_counter(), None
    try:
        skipped = _find_up_to_date(task, job)
        if skipped:
            return skipped
        asset = read(job.path)
        inputs = inputs_of(task, job, asset_digests(job.path, asset.files, job.base))
        ready = prepare_from_folder(asset, job.preparation) if job.preparation else asset
        return _run_program(task, job, ready, inputs, started)
    except MemoryError:
        why = f"{job.path}: there is not enough memory for it\n  {_MEMORY}"
        return WorkerResult(Failed(job.id, why, time.perf_counter() - started), inputs)
    except Exception as error:  # a failed asset never stops the others
        failed = Failed(job.id, describe_error(error, str(job.path)), time.perf_counter() - started)
        disk = error.strerror if isinstance(error, OSError) and error.errno in DISK_ERRORS else None
        return WorkerResult(failed, inputs, disk=disk)


def inputs_of(task: ApplyTask, job: AssetJob, files: dict[str, str]) -> OutputInputs:
    """The digests of all that decides the output of a job; files: those of the asset."""
    to, names = task.options.to, task.options.names
    return OutputInputs(
        asset=files,
        preparation=record_digest(job.preparation) if job.preparation else None,
        labels=file_digest(job.labels) if job.labels else None,
        program=program_digest(task.program),
        templates=template_digests(task.templates),
        corrections=corrections_digest(job.corrections),
        settings=f"mass={task.options.mass}{f' to={to}' if to else ''}{f' names={names}' if names else ''}",
        software=software_version(),
    )


def _find_up_to_date(task: ApplyTask, job: AssetJob) -> WorkerResult | None:
    """The outcome `skipped`, where the output of an earlier run is whole and made from the same."""
    stamp = read_stamp(task.out, job.id) if task.options.resume else None
    if not stamp or not stamp.inputs or inputs_of(task, job, stamp.inputs.asset) != stamp.inputs:
        return None
    if not has_same_files(stamp.inputs.asset, job.path, job.base) or not stamp.is_whole(task.out):
        return None
    return WorkerResult(stamp.to_skipped(task.out))


def _run_program(task: ApplyTask, job: AssetJob, asset: Asset, inputs: OutputInputs, started: float) -> WorkerResult:
    labels = read_labels(job.labels) if job.labels else LabelFile()
    followed = transfer_labels(labels, SymbolicMesh.of(asset))
    source = followed.mesh
    result = task.program.run(source, task.templates)
    mesh, flags = replay_corrections(job.corrections, source, result.mesh, task.program, task.templates)
    draft = plan_draft(task, job, asset)
    if not task.options.dry_run:
        known = labels.vocabulary or task.program.labels
        draft = write_draft(draft, mesh, known, task.options)
    outcome = (Unchanged if _has_same_hulls(source, mesh) and not job.preparation else Edited)(
        asset=job.id,
        out=str(task.out / draft.main),
        rules=_rule_effects(result),
        before=len(source.hulls),
        after=len(mesh.hulls),
        seconds=time.perf_counter() - started,
        notes=(*asset.notes, *_opaque_notes(asset), *_label_notes(followed), *draft.notes),
        flags=flags,
    )
    if task.options.dry_run:
        return WorkerResult(outcome)
    Stamp.of(outcome, inputs, draft).write(draft.root / DRAFT_STAMP)
    return WorkerResult(replace(outcome, seconds=time.perf_counter() - started), draft=draft)


def _rule_effects(result: RunResult) -> tuple[RuleEffect, ...]:
    return tuple(RuleEffect(line.rule, line.selected, line.made, line.note) for line in result.trace)


def _opaque_notes(asset: Asset) -> tuple[str, ...]:
    """What the program cannot have seen."""
    names = [piece.name for piece in asset.opaque]
    return (f"no convex hulls, so left as they are: {join_names(names)} ({asset.opaque[0].reason})",) if names else ()


def _label_notes(followed: LabelTransfer) -> tuple[str, ...]:
    """What a person should know about labels that were given to another state of the asset."""
    renamed = [f"{old} to {new}" for old, new in followed.renamed]
    kinds = (
        ("labels followed renamed hulls", renamed),
        ("hulls changed since they were labelled", followed.changed),
        ("labels of hulls that are gone were left out", followed.gone),
    )
    return tuple(f"{what}: {join_names(names)}" for what, names in kinds if names)


def _has_same_hulls(before: SymbolicMesh, after: SymbolicMesh) -> bool:
    """Whether no hull was removed, made or reshaped."""
    return len(before.hulls) == len(after.hulls) and all(
        a.name == b.name and a.shape is b.shape for a, b in zip(before.hulls, after.hulls, strict=True)
    )
