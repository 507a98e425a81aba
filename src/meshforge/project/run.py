"""Running the program: the job of each asset, the mesh before a rule, and edits by hand after the last one."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from meshforge.batch import RECORD_FILE, ApplyTask, AssetJob, Correction, replay_corrections
from meshforge.common import ProjectError, nearest_name
from meshforge.geometry import digest
from meshforge.language import Action, Program, Template
from meshforge.store import Store
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, advance, begin_replay


def build_jobs(store: Store, only: Collection[str] | None = None) -> tuple[AssetJob, ...]:
    """A job for each asset, or for some, with the project's labels and edits by hand."""
    layout, base = store.layout, store.found.base
    return tuple(
        AssetJob(
            asset,
            path,
            base,
            layout.labels(asset) if layout.labels(asset).exists() else None,
            store.corrections(asset),
            layout.preparation(asset) if (layout.preparation(asset) / RECORD_FILE).exists() else None,
        )
        for asset, path in store.found.ids.items()
        if only is None or asset in only
    )


def build_task(store: Store, program: Program) -> ApplyTask:
    """What `apply` does to each asset; the templates are those of the program and of all edits by hand."""
    corrected = store.found.ids.keys() & set(store.layout.ids_with("corrections"))
    edits = (edit for asset in sorted(corrected) for edit in store.corrections(asset))
    by_hand = (name for edit in edits for name in edit.action.templates)
    templates = store.templates(dict.fromkeys([*program.templates, *by_hand]))
    return ApplyTask(program, templates, store.layout.edited)


def build_work(
    store: Store, only: Collection[str] | None
) -> tuple[Program, tuple[AssetJob, ...], Mapping[str, Template]]:
    """The program, what it is to run on, and the templates. Raises ProjectError: no program yet, or no such asset."""
    for asset in only or ():
        store.path(asset)
    program = store.program()
    if program is None:
        raise ProjectError(
            "there is no program yet",
            where=str(store.folder),
            remedy=f"Learn it: meshforge synthesize {store.folder}",
        )
    return program, build_jobs(store, only), build_task(store, program).templates


def mesh_before_rule(
    store: Store, asset: str, rule: int, program: Program, meshes: Mapping[str, SymbolicMesh] | None = None
) -> SymbolicMesh:
    """The asset before a rule of a program, rules counted from 1; where a demonstration shows a step, after that step.

    meshes: assets in memory, by id. Raises MeshForgeError where the asset cannot be turned, or an action fails.
    """
    mesh = (meshes or {}).get(asset) or store.mesh(asset)
    replay = begin_replay(asset, Demonstration(mesh, store.steps(asset), asset), program.orient, program.contact)
    templates = store.templates(program.templates)
    for number, line in enumerate(program.rules[: rule - 1], 1):
        replay = advance(replay, number, line, templates, program.extremity)
    return replay.mesh


def correct(store: Store, asset: str, select: Sequence[str], action: Action, label: str | None) -> None:
    """Add one edit by hand. Raises ProjectError for a hull that is not there after the program and the other edits."""
    with store.lock():
        before = store.corrections(asset)
        mesh = _mesh_after_program(store, asset, before, action)
        for name in select:
            if name not in mesh.index:
                like = nearest_name(name, mesh.index)
                remedy = f"Did you mean {like!r}?" if like else None
                raise ProjectError(f"after the program there is no hull {name!r}", where=asset, remedy=remedy)
        added = Correction(tuple((name, digest(mesh.hull_of(name).shape)) for name in select), action, label)
        store.write_corrections(asset, (*before, added))


def _mesh_after_program(store: Store, asset: str, before: Sequence[Correction], action: Action) -> SymbolicMesh:
    """The asset after the program and the edits by hand so far."""
    program = store.program() or Program(orient=store.orientation)
    names = [*program.templates, *(name for c in before for name in c.action.templates), *action.templates]
    templates = store.templates(dict.fromkeys(names))
    source = store.mesh(asset)
    edited, _ = replay_corrections(before, source, program.run(source, templates).mesh, program, templates)
    return edited
