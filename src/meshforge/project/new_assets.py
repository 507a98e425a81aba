"""Assets that are not of a project, or came to it later, prepared as it says: decomposed as its own, bodies
rebuilt of which a hull surely spans parts, and hulls without a label given the one that files, names or plug-ins say,
if these labelled its own, else the likeliest one.

Each is compared with the project's labelled assets alone, in a worker process: what becomes of it does not depend on
the other new ones, nor on the number of workers, and no process holds more than these and one new asset.
"""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from meshforge import batch
from meshforge.common import MeshForgeError, describe_error
from meshforge.formats import read
from meshforge.geometry import cache_folder
from meshforge.labels import ReferenceFamily, ignore_stage, read_reference_family
from meshforge.labels.classes import format_classes
from meshforge.labels.label_sources import FamilyLabelSources
from meshforge.labels.labeler import Stage
from meshforge.labels.merge import LabelWriter, can_fill_gap
from meshforge.project.new_asset_result import NewAssetResult
from meshforge.project.preparation_plan import (
    PreparationPlan,
    RebuildSettings,
    extend_plan,
    find_new_assets,
    read_dismissed,
)
from meshforge.project.prepare import exchange_preparation
from meshforge.project.rebuild import Rebuild, plan_rebuild
from meshforge.store import Layout, Store, hull_digests
from meshforge.symbolic import Asset, Label, LabelFile, SymbolicMesh, read_labels, transfer_labels, write_labels

_NO_LABELS = "no hull of the project has a label, so nothing says which hulls span parts"


@dataclass(frozen=True, slots=True)
class NewAsset:
    """One asset that is to be prepared. labels: its labels file, None where it has none; preparation: the folder of
    what is done to it already, None for nothing."""

    id: str
    path: Path
    plan: PreparationPlan
    labels: Path | None = None
    preparation: Path | None = None


@dataclass(frozen=True, eq=False, slots=True)
class _WorkerOutcome:
    """What a worker made of an asset. seen: the digest of the preparation that was there."""

    preparation: batch.Preparation
    seen: str | None
    mesh: SymbolicMesh
    vocabulary: tuple[str, ...]
    result: NewAssetResult


@dataclass(frozen=True, eq=False, slots=True)
class _Task:
    """family: None where nothing is labelled; sources: by what hulls are labelled before likeness, None where they are
    not; rebuild: whether bodies are rebuilt; guess: whether hulls without a label get one; contact: the threshold, None
    for the language's own; dismissed: hulls that a person said span no parts, by asset."""

    family: ReferenceFamily | None
    sources: FamilyLabelSources | None
    rebuild: bool
    guess: bool
    contact: float | None
    dismissed: Mapping[str, Collection[str]]


@dataclass(frozen=True, slots=True)
class NewAssetOptions:
    """rebuild: whether bodies are rebuilt of which a hull spans parts, or these only named; guess: whether hulls
    without a label get the likeliest one; write_block: the block in which the files of an asset are written."""

    rebuild: bool = True
    guess: bool = True
    execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS
    stage: Stage = ignore_stage
    write_block: Callable[[str], AbstractContextManager[object]] = nullcontext


NEW_ASSET_DEFAULTS = NewAssetOptions()


def list_new(store: Store) -> tuple[list[NewAsset], str | None]:
    """Return the assets that came to a project after the others were prepared, or signed off, and have no label; and
    why they are not decomposed, where it is unclear how."""
    plans, unclear = find_new_assets(store)
    plans = {**dict.fromkeys(_find_unlabelled(store), PreparationPlan()), **plans}
    layout = store.layout
    return [
        NewAsset(one, store.path(one), plan, layout.labels(one), layout.preparation(one)) for one, plan in plans.items()
    ], unclear


def _find_unlabelled(store: Store) -> list[str]:
    """The assets without labels of a family with names of which some are signed off, where the program asks for
    labels; without names they get classes when it runs."""
    program = store.program()
    if program is None or not store.settings.vocabulary or not program.labels_asked or not store.sign_offs():
        return []
    assets, excluded = store.assets(), store.exclusions()
    bare = [asset for asset in assets if asset not in excluded and not _has_labels(store, asset)]
    return bare if len(bare) < len(assets) else []


def _has_labels(store: Store, asset: str) -> bool:
    try:
        return bool(store.labels(asset).labels)
    except MeshForgeError:  # whatever reads them says so
        return True


def prepare_new(
    store: Store, options: NewAssetOptions = NEW_ASSET_DEFAULTS, only: Collection[str] | None = None
) -> Iterator[NewAssetResult]:
    """Prepare the assets that came to a project after the others were prepared or signed off, as these were;
    `prepare --undo` takes it back, and it is not done again then. only: of these ids, all when None. Raises
    ProjectError where what the project keeps of that is damaged."""
    new, unclear = list_new(store)
    if not (chosen := [one for one in new if only is None or one.id in only]):
        return
    for work, found in zip(chosen, _prepare_all(_make_task(store, chosen, options), chosen, options), strict=True):
        if isinstance(found, str):
            yield NewAssetResult(work.id, problem=found)
            continue
        try:
            with options.write_block(work.id):
                notes = _keep_in_project(store, work.id, found)
        except MeshForgeError as error:
            yield NewAssetResult(work.id, problem=error.message)
            continue
        extend_plan(store, [work.id], decomposed=unclear is None, rebuilt=options.rebuild)
        yield replace(found.result, notes=(*notes, *found.result.notes))


def _keep_in_project(store: Store, asset: str, found: _WorkerOutcome) -> list[str]:
    """Write what was done step by step, since each is undone by itself; notes on that."""
    notes, seen, after = list[str](), found.seen, found.preparation
    before = len(batch.read_steps(store.layout.preparation(asset)) or ())
    labels = {name: label for name, label in found.result.new_labels.items() if label.name in store.vocabulary}
    for count in range(before + 1, len(after.steps) + 1):
        is_last = count == len(after.steps)
        part = after if is_last else after.with_only(after.steps[:count])
        notes += exchange_preparation(store, asset, part, seen, labels if is_last else None)
        seen = batch.record_digest(store.layout.preparation(asset))
    given = {**found.result.taken, **found.result.guesses}
    if labels := {name: label for name, label in given.items() if label.source != "class"}:
        LabelWriter(store).write(asset, hull_digests(found.mesh), labels, can_fill_gap)
    if len(labels) < len(given):
        with store.lock():
            store.write_classes({asset: format_classes(found.mesh)})
    return notes


def prepare_new_assets(
    store: Store, assets: Sequence[NewAsset], folder: Path, options: NewAssetOptions = NEW_ASSET_DEFAULTS
) -> Iterator[tuple[NewAsset, NewAssetResult]]:
    """Prepare assets with what is done kept in a folder, and neither in the project nor beside them: each as it is to
    be read now, with its labels and its preparation there."""
    if not assets:
        return
    layout = Layout(folder)
    found_all = _prepare_all(_make_task(store, assets, options), assets, options)
    for work, found in zip(assets, found_all, strict=True):
        if isinstance(found, str):
            yield work, NewAssetResult(work.id, problem=found)
            continue
        labels, preparation = layout.labels(work.id), layout.preparation(work.id)
        batch.write_preparation(preparation, found.preparation)
        if found.mesh.labels:
            write_labels(labels, found.mesh, found.vocabulary)
        else:
            labels.unlink(missing_ok=True)
        here = replace(work, labels=labels if found.mesh.labels else None)
        yield replace(here, preparation=preparation if found.preparation.steps else None), found.result


def _make_task(store: Store, assets: Sequence[NewAsset], options: NewAssetOptions) -> _Task:
    """What is the same for all assets; the project's labelled ones are read, but for those that are new themselves."""
    engine = next((one.plan.rebuild.pieces for one in assets if one.plan.rebuild), None)  # one for all of a project
    own = {path: asset for asset, path in store.found.ids.items()}
    without = {own[one.path] for one in assets if one.path in own}
    family = None
    if engine or options.guess:
        family = read_reference_family(
            store, options.execution, options.stage, engine or "coacd", without=without, spans=engine is not None
        )
    sources = FamilyLabelSources.of(store) if options.guess else None
    return _Task(
        family, sources, options.rebuild, options.guess, store.settings.thresholds.contact, read_dismissed(store)
    )


def _prepare_all(task: _Task, assets: Sequence[NewAsset], options: NewAssetOptions) -> Iterator[_WorkerOutcome | str]:
    with options.stage(len(assets), "preparing") as advance:
        execution = replace(options.execution, progress=advance)
        for found in batch.execute(partial(_prepare, task), assets, execution):
            yield found.why if isinstance(found, batch.WorkerFailure) else found


def _prepare(task: _Task, work: NewAsset) -> _WorkerOutcome | str:
    try:
        seen = batch.record_digest(work.preparation) if work.preparation else None
        before = (batch.read_preparation(work.preparation) if work.preparation else None) or batch.Preparation()
        source = read(work.path)
        after, notes = _decompose(source, before, work.plan)
        labels = read_labels(work.labels) if work.labels and work.labels.exists() else LabelFile()
        mesh, taken, notes_of_labels = _take_labels(task, work, _build_mesh(source, after, labels, task.contact))
        found = Rebuild(after)
        if work.plan.rebuild and mesh.hulls:
            dismissed = frozenset(task.dismissed.get(work.id, ()) if work.preparation else ())
            found = _rebuild(task, source, after, mesh, work.plan.rebuild, dismissed)
            if found.bodies:
                mesh = _build_mesh(source, found.after, labels, task.contact).with_labels(found.labels)
                mesh, taken, _ = _take_labels(task, work, mesh)  # what is odd of hulls that are gone was said
        guesses = task.family.infer_labels(mesh) if task.guess and task.family and mesh.hulls else {}
        notes = (*found.notes, *notes, *notes_of_labels)
        result = NewAssetResult(work.id, found.bodies, found.left, guesses, notes, taken=taken)
        words = labels.vocabulary or (task.family.words if task.family else ())
        return _WorkerOutcome(found.after, seen, mesh.with_labels(guesses), words, result)
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(work.path))


def _build_mesh(
    source: Asset, preparation: batch.Preparation, labels: LabelFile, contact: float | None
) -> SymbolicMesh:
    mesh = transfer_labels(labels, SymbolicMesh.of(batch.apply_preparation(source, preparation))).mesh
    return mesh if contact is None else replace(mesh, epsilon=contact)


def _take_labels(
    task: _Task, work: NewAsset, mesh: SymbolicMesh
) -> tuple[SymbolicMesh, Mapping[str, Label], Sequence[str]]:
    taken, notes_of_labels = task.sources.label(work.id, work.path, mesh) if task.sources else ({}, ())
    return mesh.with_labels(taken), taken, notes_of_labels


def _decompose(
    source: Asset, before: batch.Preparation, plan: PreparationPlan
) -> tuple[batch.Preparation, tuple[str, ...]]:
    notes = list[str]()
    for one in plan.decompose:
        done = batch.decompose_asset(
            source, before, one.settings, only=one.only, hollow=one.hollow, by=one.by, cache=cache_folder()
        )
        before = done.preparation
        notes += [f"{entry.what} decomposed by {one.settings.engine}: {entry.remark}" for entry in done.made]
        notes += [f"{lost.what} could not be decomposed: {lost.why}" for lost in done.failed]
    return before, tuple(notes)


def _rebuild(
    task: _Task,
    source: Asset,
    before: batch.Preparation,
    mesh: SymbolicMesh,
    how: RebuildSettings,
    dismissed: frozenset[str],
) -> Rebuild:
    """Rebuild bodies of which a hull surely spans parts, or only say which, as is asked for."""
    if task.family is None:
        return Rebuild(before, notes=(_NO_LABELS,))
    found = plan_rebuild(task.family, source, before, mesh, how, dismissed)
    lost = tuple(f"not compared with {asset}: {why}" for asset, why in task.family.lost.items())
    if task.rebuild:
        return replace(found, notes=(*lost, *found.notes))
    spans = (span for one in found.bodies for span in one.spans)
    return Rebuild(before, left=(*spans, *found.left), notes=(*lost, *found.notes))
