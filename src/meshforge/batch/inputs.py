"""What an output is made from, as digests: its asset, labels, program and all else that a job and its task name."""

from __future__ import annotations

from meshforge.batch import provenance
from meshforge.batch.corrections import corrections_digest
from meshforge.batch.jobs import ApplyTask, AssetJob
from meshforge.batch.preparation.storage import record_digest


def inputs_of(task: ApplyTask, job: AssetJob, files: dict[str, str]) -> provenance.OutputInputs:
    """The digests of all that decides the output of a job; files: those of the asset."""
    to, names = task.options.to, task.options.names
    return provenance.OutputInputs(
        asset=files,
        preparation=record_digest(job.preparation) if job.preparation else None,
        labels=provenance.file_digest(job.labels) if job.labels else None,
        program=provenance.program_digest(task.program),
        templates=provenance.template_digests(task.templates),
        corrections=corrections_digest(job.corrections),
        settings=f"mass={task.options.mass}{f' to={to}' if to else ''}{f' names={names}' if names else ''}",
        software=provenance.software_version(),
    )
