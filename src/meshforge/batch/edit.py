"""One asset of a batch, from its file to a draft of its output; runs in a worker process."""

from __future__ import annotations

import errno
import time
from dataclasses import dataclass, replace

from meshforge.asset import Asset
from meshforge.batch.assets.digests import (
    asset_digests,
    corrections_digest,
    file_digest,
    program_digest,
    same_files,
    software,
    template_digests,
)
from meshforge.batch.assets.job import AssetJob, Task
from meshforge.batch.correction import replay
from meshforge.batch.outcome import Edited, Failed, Outcome, RuleLine, Unchanged
from meshforge.batch.outputs.draft import STAMP, Draft, planned, written
from meshforge.batch.outputs.stamp import Inputs, Stamp, read_stamp
from meshforge.errors import told
from meshforge.formats import read
from meshforge.language import RunResult
from meshforge.preparation import prepared_by, record_digest
from meshforge.symbolic import Followed, LabelFile, SymbolicMesh, follow_labels, read_labels
from meshforge.words import listed

NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EROFS)
"""What is wrong with the disk, not with a file: all assets would fail alike."""
_MEMORY = "More for one asset: --memory, or fewer --workers. The other assets are not affected."


@dataclass(frozen=True, slots=True)
class Worked:
    """What a worker made of one asset.

    draft: its new files with their stamp, None where there are none to put in place; inputs: of a failed asset, as far
    as they are known; disk: what is wrong with it, where nothing can be written any more.
    """

    outcome: Outcome
    inputs: Inputs | None = None
    draft: Draft | None = None
    disk: str | None = None


def edit(task: Task, job: AssetJob) -> Worked:
    """Run a task on one asset. Never raises: whatever goes wrong is the asset's outcome."""
    started, inputs = time.perf_counter(), None
    try:
        skipped = _skipped(task, job)
        if skipped:
            return skipped
        asset = read(job.path)
        inputs = inputs_of(task, job, asset_digests(job.path, asset.files, job.base))
        ready = prepared_by(asset, job.preparation) if job.preparation else asset
        return _edited(task, job, ready, inputs, started)
    except MemoryError:
        why = f"{job.path}: there is not enough memory for it\n  {_MEMORY}"
        return Worked(Failed(job.id, why, time.perf_counter() - started), inputs)
    except Exception as error:  # a failed asset never stops the others
        failed = Failed(job.id, told(error, str(job.path)), time.perf_counter() - started)
        disk = error.strerror if isinstance(error, OSError) and error.errno in NO_ROOM else None
        return Worked(failed, inputs, disk=disk)


def inputs_of(task: Task, job: AssetJob, files: dict[str, str]) -> Inputs:
    """The digests of all that decides the output of a job; files: those of the asset."""
    return Inputs(
        asset=files,
        preparation=record_digest(job.preparation) if job.preparation else None,
        labels=file_digest(job.labels) if job.labels else None,
        program=program_digest(task.program),
        templates=template_digests(task.templates),
        corrections=corrections_digest(job.corrections),
        settings=f"mass={task.mass}{f' to={task.to}' if task.to else ''}{f' names={task.names}' if task.names else ''}",
        software=software(),
    )


def _skipped(task: Task, job: AssetJob) -> Worked | None:
    """The outcome `skipped`, where the output of an earlier run is whole and made from the same."""
    stamp = read_stamp(task.out, job.id) if task.resume else None
    if not stamp or not stamp.inputs or inputs_of(task, job, stamp.inputs.asset) != stamp.inputs:
        return None
    if not same_files(stamp.inputs.asset, job.path, job.base) or not stamp.is_whole(task.out):
        return None
    return Worked(stamp.to_skipped(task.out))


def _edited(task: Task, job: AssetJob, asset: Asset, inputs: Inputs, started: float) -> Worked:
    labels = read_labels(job.labels) if job.labels else LabelFile()
    followed = follow_labels(labels, SymbolicMesh.of(asset))
    source = followed.mesh
    result = task.program.run(source, task.templates)
    mesh, flags = replay(job.corrections, source, result.mesh, task.program, task.templates)
    draft = planned(task, job, asset)
    if not task.dry_run:
        known = labels.vocabulary or task.program.labels
        draft = written(draft, mesh, known, mass=task.mass, link=task.link, names=task.names)
    outcome = (Unchanged if _same_hulls(source, mesh) and not job.preparation else Edited)(
        asset=job.id,
        out=str(task.out / draft.main),
        rules=_lines(result),
        before=len(source.hulls),
        after=len(mesh.hulls),
        seconds=time.perf_counter() - started,
        notes=(*asset.notes, *_opaque_notes(asset), *_label_notes(followed), *draft.notes),
        flags=flags,
    )
    if task.dry_run:
        return Worked(outcome)
    Stamp.of(outcome, inputs, draft).write(draft.root / STAMP)
    return Worked(replace(outcome, seconds=time.perf_counter() - started), draft=draft)


def _lines(result: RunResult) -> tuple[RuleLine, ...]:
    return tuple(RuleLine(line.rule, line.selected, line.made, line.note) for line in result.trace)


def _opaque_notes(asset: Asset) -> tuple[str, ...]:
    """What the program cannot have seen."""
    names = [piece.name for piece in asset.opaque]
    return (f"no convex hulls, so left as they are: {listed(names)} ({asset.opaque[0].reason})",) if names else ()


def _label_notes(followed: Followed) -> tuple[str, ...]:
    """What a person should know about labels that were given to another state of the asset."""
    renamed = [f"{old} to {new}" for old, new in followed.renamed]
    told = (
        ("labels followed renamed hulls", renamed),
        ("hulls changed since they were labelled", followed.changed),
        ("labels of hulls that are gone were left out", followed.gone),
    )
    return tuple(f"{what}: {listed(names)}" for what, names in told if names)


def _same_hulls(before: SymbolicMesh, after: SymbolicMesh) -> bool:
    """Whether no hull was removed, made or reshaped."""
    return len(before.hulls) == len(after.hulls) and all(
        a.name == b.name and a.shape is b.shape for a, b in zip(before.hulls, after.hulls, strict=True)
    )
