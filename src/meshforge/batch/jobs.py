"""What a batch is given: one job an asset, one task that is the same for all, and the hull templates of its program."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge import formats, language
from meshforge.batch.discovery import AssetSet, asset_id
from meshforge.batch.manual_edits import ManualEdit, RuleSelection, manual_edits_digest, selections_digest
from meshforge.batch.preparation.storage import record_digest
from meshforge.batch.provenance import (
    OutputInputs,
    content_digest,
    program_digest,
    software_version,
    template_digests,
    value_digest,
)
from meshforge.common import Plugin, ProgramError, UsageError, pluralize
from meshforge.symbolic import LabelFile, read_classes, read_labels

if TYPE_CHECKING:
    from meshforge.batch.preparation.decompose import Concave


@dataclass(frozen=True, slots=True)
class AssetJob:
    """One asset of a batch.

    id: its path below `base`, which the output mirrors; labels: its labels file, None for no labels; selections: what a
    person said that rules select there;
    corrections: edits by hand, replayed after the program; preparation: the folder of what is done to it before;
    notes: what its outcome says of that; classes: the file of classes of hulls without a label, None for none.
    """

    id: str
    path: Path
    base: Path
    labels: Path | None = None
    manual_edits: tuple[ManualEdit, ...] = ()
    preparation: Path | None = None
    selections: tuple[RuleSelection, ...] = ()
    notes: tuple[str, ...] = ()
    classes: Path | None = None

    def read_labels(self) -> LabelFile:
        """Return its labels, and the classes of hulls without one. Raises AssetError where they cannot be read."""
        return (read_labels(self.labels) if self.labels else LabelFile()).fill(read_classes(self.classes))


@dataclass(frozen=True, slots=True)
class ApplyOptions:
    """How edited assets are written.

    mass: whether bodies keep their masses where a format derives them from geometry; link: files that are only copied
    become hard links; dry_run: nothing is written; resume: an output that is whole and was made from the same is
    skipped; to: the suffix of the format that all are written in, each one's own when None; names: how collision is
    marked; collision: where the hulls of scenes go in which nothing is marked; urdf_capsules: whether URDFs get
    `<capsule>`; one_file_a_hull: whether in URDFs and SDFs each hull of a mesh gets a file of its own. The last four
    are as of `formats.save`. concave: what is done with non-convex collision meshes first, see `replace_concave`.
    """

    mass: formats.Mass = "keep"
    link: bool = False
    dry_run: bool = False
    resume: bool = True
    to: str | None = None
    names: formats.MarkName | None = None
    collision: formats.Collision | None = "beside"
    concave: Concave = "keep"
    urdf_capsules: bool = False
    one_file_a_hull: bool = False


APPLY_DEFAULTS = ApplyOptions()


@dataclass(frozen=True, eq=False, slots=True)
class ApplyTask:
    """What is done to every asset of a batch. out: the folder that is written."""

    program: language.Program
    templates: Mapping[str, language.Template]
    out: Path
    options: ApplyOptions = APPLY_DEFAULTS


def inputs_of(task: ApplyTask, job: AssetJob, files: dict[str, str]) -> OutputInputs:
    """Return the digests of all that decides the output of a job; files: those of the asset."""
    options, edits = task.options, (one.action for one in job.manual_edits)
    names = {*task.program.templates, *(name for action in edits for name in action.templates)}
    written = {"to": options.to, "names": options.names, "collision": options.collision}
    written |= {} if options.concave == "keep" else {"concave": options.concave}
    written |= {"urdf_capsules": "yes"} if options.urdf_capsules else {}
    written |= {"one_file_a_hull": "yes"} if options.one_file_a_hull else {}
    return OutputInputs(
        asset=files,
        preparation=record_digest(job.preparation) if job.preparation else None,
        labels=_digest_labels(job),
        program=program_digest(task.program),
        templates=template_digests({name: one for name, one in task.templates.items() if name in names}),
        manual_edits=manual_edits_digest(job.manual_edits),
        selections=selections_digest(job.selections),
        settings=" ".join([f"mass={options.mass}", *(f"{key}={value}" for key, value in written.items() if value)]),
        software=software_version(_plugins_of(task, job)),
    )


def _digest_labels(job: AssetJob) -> str | None:
    """Of classes their names count alone: how sure they are changes with each answer, and no edit with it."""
    labels = content_digest(job.labels) if job.labels else None
    if job.classes is None:
        return labels
    return value_digest([labels, {name: label.name for name, label in read_classes(job.classes).labels.items()}])


def _plugins_of(task: ApplyTask, job: AssetJob) -> Iterator[Plugin | None]:
    """The plug-ins that read, edit and write the asset; None for what is built in."""
    yield from map(formats.plugin_of_suffix, {job.path.suffix, task.options.to or job.path.suffix})
    pairs = task.program.orient.pairs if task.program.orient else ()
    yield from (base.plugin for pair in pairs for base in (pair.start, pair.end))
    for rule in task.program.rules:
        yield from (one.plugin for leaf in language.leaves_of(rule.extractor) for one in (leaf, *leaf.bases))
        yield rule.action.plugin


def make_jobs(found: AssetSet, labels: Path | None = None) -> tuple[AssetJob, ...]:
    """Return a job for each asset, with its labels.

    labels: a labels file for a single asset, or a folder that mirrors the assets' (`ID.json` or the name it would have
    beside the asset); without it, the file beside each asset, if present.
    Raises UsageError: no such file or folder, or one file for several assets.
    """
    if labels is not None and labels.is_file() and len(found) > 1:
        remedy = "Give a folder that mirrors theirs."
        raise UsageError(f"one labels file cannot serve {len(found)} assets", where=str(labels), remedy=remedy)
    return tuple(
        AssetJob(key, path, found.base_of(path), find_labels_file(path, labels, found.base_of(path)))
        for key, path in found.ids.items()
    )


def find_labels_file(path: Path, labels: Path | None, base: Path) -> Path | None:
    """Return the labels file of one asset, None where it has none; the arguments are those of `make_jobs`."""
    if labels is None:
        beside = formats.labels_beside(path)
        return beside if beside.is_file() else None
    if labels.is_file():
        return labels
    if not labels.is_dir():
        raise UsageError("there is no such labels file or folder", where=str(labels))
    mirrored = labels / asset_id(path, base)
    candidates = (mirrored.with_name(mirrored.name + ".json"), formats.labels_beside(mirrored))
    return next((place for place in candidates if place.is_file()), None)


def template_folders(program: Path) -> tuple[Path, ...]:
    """Return where the templates of a program file are looked for: beside it, then in the folder templates/ there."""
    return program.parent, program.parent / "templates"


def load_templates(names: Iterable[str], folders: Sequence[Path]) -> dict[str, language.Template]:
    """Return the templates of these names, by the path that a program writes, from the first folder that has each.

    Raises ProgramError: a template is in none of the folders, holds no hull, or is not convex.
    """
    return {name: read_template(_find_template(name, folders), name) for name in names}


def read_template(path: Path, name: str) -> language.Template:
    """Return the template in a file. Raises ProgramError, naming it, where it holds no hull or is not convex."""
    asset = formats.read(path)
    if asset.non_convex:
        out = path.with_name(f"{path.stem}_hulls{path.suffix}")
        problem = f'the template "{name}" is no convex hull: {asset.non_convex[0].reason}'
        remedy = f"Split it into convex hulls first: meshforge decompose {path} -o {out}"
        raise ProgramError(problem, where=str(path), remedy=remedy)
    if not asset.geoms:
        raise ProgramError(f'the template "{name}" holds no hull', where=str(path))
    return language.Template(tuple(geom.shape for geom in asset.geoms), name)


def _find_template(name: str, folders: Sequence[Path]) -> Path:
    places = [folder / name for folder in folders]
    for place in places:
        if place.is_file():
            return place
    looked = ", then ".join(str(place) for place in places) or "no folder"
    raise ProgramError(f'the template "{name}" is not there', remedy=f"Looked for {looked}.")


def describe_jobs(jobs: Sequence[AssetJob]) -> str:
    """Return how many assets there are of what, without reading them: `3 assets (3 OBJ), 2 with labels`."""
    suffixes = (job.path.suffix.lower().lstrip(".").upper() or "folder" for job in jobs)
    kinds = ", ".join(f"{number:,} {kind}" for kind, number in Counter(suffixes).most_common())
    labelled = sum(bool(job.labels or job.classes) for job in jobs)
    return f"{pluralize(len(jobs), 'asset')} ({kinds}), {labelled:,} with labels"
