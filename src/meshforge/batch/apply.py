"""Running a program over many assets."""

from __future__ import annotations

import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack
from functools import partial
from pathlib import Path

from meshforge.batch.discovery import STATE
from meshforge.batch.edit import edit_asset
from meshforge.batch.execution import execute
from meshforge.batch.jobs import APPLY_DEFAULTS, ApplyOptions, ApplyTask, AssetJob
from meshforge.batch.lock import hold_lock
from meshforge.batch.outcome import AssetOutcome, Failed
from meshforge.batch.outputs import OutputFolder, WorkerResult, drafts_folder
from meshforge.batch.workers import EXECUTION_DEFAULTS, ExecutionOptions, WorkerFailure
from meshforge.common import UsageError
from meshforge.formats import format_for, format_with_names
from meshforge.language import Program, Template


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
            stack.callback(shutil.rmtree, drafts_folder(task.out), ignore_errors=True)
            shutil.rmtree(drafts_folder(task.out), ignore_errors=True)
            ledger = OutputFolder(task.out, (job.id for job in jobs))
        results = execute(partial(edit_asset, task), jobs, execution)
        stack.callback(results.close)  # the workers stop first, so that none writes a draft any more
        for job, result in zip(jobs, results, strict=True):
            if isinstance(result, WorkerFailure):
                why = f"{job.path}: {result.why}\n  The other assets are not affected."
                result = WorkerResult(Failed(job.id, why, result.seconds))
            yield ledger.commit(result) if ledger else result.outcome


def _check_arguments(jobs: tuple[AssetJob, ...], task: ApplyTask) -> None:
    options = task.options
    if options.names:
        format_with_names(format_for(Path(f"asset{options.to or ''}"), ""), options.names)
    seen: dict[str, Path] = {}
    for job in jobs:
        if job.id in seen:
            raise UsageError(f"two assets have the id {job.id!r}: {seen[job.id]} and {job.path}")
        seen[job.id] = job.path
        if job.base.absolute() == task.out:
            raise UsageError(
                "the output folder is the folder of the assets", where=str(task.out), remedy="Choose another --out."
            )
