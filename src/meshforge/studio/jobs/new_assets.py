"""Before the program runs: assets that came to the project after the others were prepared, prepared as these were."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from uuid import uuid4

from meshforge import batch
from meshforge.common import relative_name
from meshforge.project import NewAssetOptions, NewAssetResult, describe_new, list_new
from meshforge.studio.session.job_runner import JobProgress
from meshforge.studio.session.session import Session


@dataclass(frozen=True, eq=False, slots=True)
class NewAssetPreparation:
    """What became of new assets before the program, by id. unclear: why they were not decomposed, where it is not clear
    how."""

    results: Mapping[str, NewAssetResult] = field(default_factory=dict)
    unclear: str | None = None

    @property
    def failed(self) -> Iterator[batch.Failed]:
        """Those that could not be prepared, so that no program runs on them."""
        for one in self.results.values():
            if one.problem:
                yield batch.Failed(one.asset, f"it could not be prepared: {one.problem}", 0.0)

    def describe(self, asset: str) -> tuple[str, ...]:
        """What was done to an asset, in sentences."""
        return self.results[asset].describe() if asset in self.results else ()

    def add_notes(self, jobs: Iterable[batch.AssetJob]) -> list[batch.AssetJob]:
        """The jobs, of which those of new assets say what was done to these before."""
        return [replace(job, notes=self.describe(job.id)) for job in jobs]

    def __str__(self) -> str:
        """What was done to all, in sentences; empty where nothing was."""
        remarks = [self.unclear, describe_new(list(self.results.values()))]
        return " ".join(f"{text[0].upper()}{text[1:]}." for text in remarks if text)


def prepare_new(
    session: Session, progress: JobProgress, assets: Collection[str], *, rebuild: bool
) -> NewAssetPreparation:
    """Prepare those of some assets that are new; each is one edit, and all are undone at once.

    rebuild: whether bodies are rebuilt of which a hull spans parts, or these only named. Raises
    ProjectError where what the project keeps of how its assets were prepared is damaged.
    """
    project, group = session.project, uuid4().hex
    new, unclear = list_new(project)
    if not any(one.id in assets for one in new):
        return NewAssetPreparation(unclear=unclear)
    program = project.program()
    options = NewAssetOptions(
        rebuild=rebuild,
        guess=program is None or bool(program.labels_asked),
        execution=batch.ExecutionOptions(stop=progress.is_stopped),
        stage=progress.stage,
        write_block=lambda asset: session.record_preparation(f"{asset} prepared as the others", asset, group),
    )
    results = {one.asset: one for one in project.prepare_new(options, assets)}
    session.update([relative_name(project.layout.preparation_plan, project.folder)])
    return NewAssetPreparation(results, unclear)
