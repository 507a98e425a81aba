"""What an output is made from, as digests: its asset, labels, program and all else that a job and its task name."""

from __future__ import annotations

from collections.abc import Iterator

from meshforge import language
from meshforge.batch import provenance
from meshforge.batch.jobs import ApplyTask, AssetJob
from meshforge.batch.manual_edits import manual_edits_digest, selections_digest
from meshforge.batch.preparation.storage import record_digest
from meshforge.common import Plugin
from meshforge.formats import plugin_of_suffix


def inputs_of(task: ApplyTask, job: AssetJob, files: dict[str, str]) -> provenance.OutputInputs:
    """Return the digests of all that decides the output of a job; files: those of the asset."""
    options, edits = task.options, (one.action for one in job.manual_edits)
    names = {*task.program.templates, *(name for action in edits for name in action.templates)}
    written = {"to": options.to, "names": options.names, "collision": options.collision}
    written |= {} if options.concave == "keep" else {"concave": options.concave}
    written |= {"urdf_capsules": "yes"} if options.urdf_capsules else {}
    return provenance.OutputInputs(
        asset=files,
        preparation=record_digest(job.preparation) if job.preparation else None,
        labels=provenance.content_digest(job.labels) if job.labels else None,
        program=provenance.program_digest(task.program),
        templates=provenance.template_digests({name: one for name, one in task.templates.items() if name in names}),
        manual_edits=manual_edits_digest(job.manual_edits),
        selections=selections_digest(job.selections),
        settings=" ".join([f"mass={options.mass}", *(f"{key}={value}" for key, value in written.items() if value)]),
        software=provenance.software_version(_plugins_of(task, job)),
    )


def _plugins_of(task: ApplyTask, job: AssetJob) -> Iterator[Plugin | None]:
    """The plug-ins that read, edit and write the asset; None for what is built in."""
    yield from map(plugin_of_suffix, {job.path.suffix, task.options.to or job.path.suffix})
    pairs = task.program.orient.pairs if task.program.orient else ()
    yield from (base.plugin for pair in pairs for base in (pair.start, pair.end))
    for rule in task.program.rules:
        yield from (one.plugin for leaf in language.leaves_of(rule.extractor) for one in (leaf, *leaf.bases))
        yield rule.action.plugin
