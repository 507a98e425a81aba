"""Running a program over many assets."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack
from functools import partial
from pathlib import Path

from meshforge.batch.discovery import STATE
from meshforge.batch.edit import edit_asset
from meshforge.batch.execution import TIMEOUT, Backend, ExecutionOptions
from meshforge.batch.jobs import ApplyTask, AssetJob
from meshforge.batch.lock import hold_lock
from meshforge.batch.outcome import AssetOutcome, Failed
from meshforge.batch.outputs import OutputFolder, WorkerResult, drafts_folder
from meshforge.batch.workers import WorkerFailure
from meshforge.common import UsageError
from meshforge.formats import EngineName, Mass, format_for, format_with_names
from meshforge.language import Program, Template


def apply(
    program: Program,
    assets: Iterable[AssetJob],
    out: Path,
    *,
    templates: Mapping[str, Template] | None = None,
    workers: int | None = None,
    mass: Mass = "keep",
    link: bool = False,
    dry_run: bool = False,
    resume: bool = True,
    to: str | None = None,
    names: EngineName | None = None,
    timeout: float | None = TIMEOUT,
    memory: int | None = None,
    backend: Backend = "local",
    progress: Callable[[], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> Iterator[AssetOutcome]:
    """Run a program on assets and write each into `out`; one outcome an asset, in the order given.

    The outcomes come as the work goes on; an asset is in place when its outcome is there. What one asset does wrong
    is its own outcome. Outcomes and files do not depend on the number of workers, nor on where they are.

    workers: processes, None takes one a processor, 0 works in this process (no bounds, no protection against crashes of
    native code); mass: whether bodies keep their masses where a format derives them from geometry;
    link: files that are only copied become hard links; dry_run: nothing is written; resume: an output that is whole
    and was made from the same is skipped; to: the suffix of the format that all are written in, each one's own when
    None; names: the engine by whose names for collision they are made; timeout: seconds for one asset; memory: bytes
    for one, an even share of the machine's when None; backend: the workers of this machine, or those of a Ray cluster,
    as of `run_on_cluster`;
    progress: called for each finished asset; stop: as of `isolated`.
    Raises UsageError for arguments that do not fit, MeshForgeError when another run is writing into `out`,
    StoppedError when it was told to stop: what is in place by then stays.
    """
    jobs = tuple(assets)
    task = ApplyTask(program, dict(templates or {}), Path(out).absolute(), mass, link, dry_run, resume, to, names)
    _check_arguments(jobs, task)
    return _run_task(jobs, task, ExecutionOptions(workers, timeout, memory, stop, backend), progress)


def _run_task(
    jobs: tuple[AssetJob, ...], task: ApplyTask, spread: ExecutionOptions, progress: Callable[[], None] | None
) -> Iterator[AssetOutcome]:
    with ExitStack() as stack:
        ledger = None
        if not task.dry_run:
            stack.enter_context(hold_lock(task.out / STATE / "lock", str(task.out), wait=0))
            stack.callback(shutil.rmtree, drafts_folder(task.out), ignore_errors=True)
            shutil.rmtree(drafts_folder(task.out), ignore_errors=True)
            ledger = OutputFolder(task.out, (job.id for job in jobs))
        results = spread.run(partial(edit_asset, task), jobs, progress)
        stack.callback(results.close)  # the workers stop first, so that none writes a draft any more
        for job, result in zip(jobs, results, strict=True):
            worked = _to_failed(job, result) if isinstance(result, WorkerFailure) else result
            yield ledger.commit(worked) if ledger else worked.outcome


def _to_failed(job: AssetJob, lost: WorkerFailure) -> WorkerResult:
    return WorkerResult(Failed(job.id, f"{job.path}: {lost.why}\n  The other assets are not affected.", lost.seconds))


def _check_arguments(jobs: tuple[AssetJob, ...], task: ApplyTask) -> None:
    if task.names:
        format_with_names(format_for(Path(f"asset{task.to or ''}"), ""), task.names)
    seen: dict[str, Path] = {}
    for job in jobs:
        if job.id in seen:
            raise UsageError(f"two assets have the id {job.id!r}: {seen[job.id]} and {job.path}")
        seen[job.id] = job.path
        if job.base.absolute() == task.out:
            raise UsageError(
                "the output folder is the folder of the assets", where=str(task.out), remedy="Choose another --out."
            )
