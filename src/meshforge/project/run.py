"""Running the program, the job of each asset and the mesh before a rule; and what follows: edits by hand, and which
edited assets a person has accepted or flagged.

A result that is accepted by itself was looked at: what each rule selected there is what was meant, and learning keeps
to it. Who accepts many at once says nothing of each.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from meshforge import batch
from meshforge.common import ProjectError, suggest_name
from meshforge.geometry import digest
from meshforge.labels import pick_evenly
from meshforge.language import Action, Program, RunResult, Template
from meshforge.store import Review, RuleSelection, Store, Verdict, action_text_without_each
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, advance, begin_replay


def build_jobs(store: Store, only: Collection[str] | None = None) -> tuple[batch.AssetJob, ...]:
    """A job for each asset, or for some, with the project's labels and edits by hand."""
    layout = store.layout
    return tuple(
        batch.AssetJob(
            asset,
            path,
            store.found.base_of(path),
            layout.labels(asset) if layout.labels(asset).exists() else None,
            store.corrections(asset),
            layout.preparation(asset) if (layout.preparation(asset) / batch.RECORD_FILE).exists() else None,
        )
        for asset, path in store.found.choose(only).items()
    )


def build_task(store: Store, program: Program) -> batch.ApplyTask:
    """What `apply` does to each asset; the templates are those of the program and of all edits by hand."""
    corrected = store.found.ids.keys() & set(store.layout.ids_with("corrections"))
    edits = (edit for asset in sorted(corrected) for edit in store.corrections(asset))
    by_hand = (name for edit in edits for name in edit.action.templates)
    templates = store.templates(dict.fromkeys([*program.templates, *by_hand]))
    return batch.ApplyTask(program, templates, store.layout.edited)


def build_work(
    store: Store, only: Collection[str] | None = None
) -> tuple[Program, tuple[batch.AssetJob, ...], Mapping[str, Template]]:
    """What `apply` runs on all assets or those of some ids: the program, a job for each, and the templates.

    Raises ProjectError: no program yet, or no such asset.
    """
    for asset in only or ():
        store.path(asset)
    program = store.program()
    if program is None:
        raise ProjectError(
            "there is no program yet", where=str(store.folder), remedy=f"Learn it: meshforge synthesize {store.folder}"
        )
    return program, build_jobs(store, only), build_task(store, program).templates


def mesh_before_rule(
    store: Store, asset: str, rule: int, program: Program, meshes: Mapping[str, SymbolicMesh] | None = None
) -> SymbolicMesh:
    """An asset as a rule of a program meets it, rules counted from 1: turned, and edited by the rules before.

    These are done on the hulls that a demonstration shows for them, if there is one. meshes: assets in memory, by id.
    Raises MeshForgeError where the asset cannot be turned, or an action fails.
    """
    mesh = (meshes or {}).get(asset) or store.mesh(asset)
    replay = begin_replay(asset, Demonstration(mesh, store.steps(asset), asset), program.orient, program.contact)
    templates = store.templates(program.templates)
    for number, line in enumerate(program.rules[: rule - 1], 1):
        replay = advance(replay, number, line, templates, program.extremity)
    return replay.mesh


def correct(store: Store, asset: str, select: Iterable[str], action: Action, label: str | None = None) -> None:
    """Add an edit by hand on hulls of an asset, by the names they have after the program and the edits before.

    Raises ProjectError for a hull that is not there then.
    """
    with store.lock():
        store.templates(action.templates)  # raises ProgramError
        before = run_with_corrections(store, asset, store.mesh(asset), store.program())
        added = make_correction(before.mesh, asset, sorted(set(select)), action, label)
        store.write_corrections(asset, (*before.corrections, added))


@dataclass(frozen=True, eq=False, slots=True)
class RunWithCorrections:
    """An asset after the program and the edits by hand; flags: a sentence for each of these that was left out."""

    program: Program
    templates: Mapping[str, Template]
    run: RunResult
    corrections: tuple[batch.Correction, ...]
    mesh: SymbolicMesh
    flags: tuple[str, ...]


def run_with_corrections(store: Store, asset: str, mesh: SymbolicMesh, program: Program | None) -> RunWithCorrections:
    """An asset after a program and its corrections; None changes nothing. Raises MeshForgeError where it cannot run."""
    plan = program or Program(orient=store.orientation)
    corrections = store.corrections(asset)
    names = [*plan.templates, *(name for one in corrections for name in one.action.templates)]
    templates = store.templates(dict.fromkeys(names))
    run = plan.run(mesh, templates)
    after, flags = batch.replay_corrections(corrections, mesh, run.mesh, plan, templates)
    return RunWithCorrections(plan, templates, run, corrections, after, flags)


def make_correction(
    mesh: SymbolicMesh, asset: str, select: Sequence[str], action: Action, label: str | None
) -> batch.Correction:
    """One more edit by hand, on hulls of the mesh. Raises ProjectError for a hull that is not there."""
    for name in select:
        if name not in mesh.index:
            remedy = suggest_name(name, mesh.index)
            raise ProjectError(f"after the program there is no hull {name!r}", where=asset, remedy=remedy)
    return batch.Correction(tuple((name, digest(mesh.hull_of(name).shape)) for name in select), action, label)


MOST_ACCEPTED = 100
"""Of more accepted results so many are learned from: each is one more mesh on which every rule must be right."""


def review_assets(store: Store, assets: str | Iterable[str], verdict: Verdict | None, note: str | None = None) -> None:
    """Accept or flag the output of one or several assets, or take that back by None, also that they were set aside; it
    counts until that changes.

    One that is accepted by itself was looked at: learning keeps to what the program selected there.
    Raises ProjectError, with nothing written, where there is no output that a verdict could be about.
    """
    assets = (assets,) if isinstance(assets, str) else tuple(assets)
    own = {asset: _build_review(store, asset, verdict, note) for asset in assets}
    if len(assets) == 1 and (review := own[assets[0]]):
        own = {assets[0]: review.model_copy(update={"seen": _read_selections(store, assets[0])})}
    with store.lock():
        store.write_reviews(own)
        store.write_sign_offs(store.sign_offs().without_aside(assets))


def _build_review(store: Store, asset: str, verdict: Verdict | None, note: str | None) -> Review | None:
    store.path(asset)
    output = output_digest(batch.read_stamp(store.layout.edited, asset))
    if verdict and not output:
        raise ProjectError(
            f"{asset} has no output to be {verdict}",
            where=str(store.folder),
            remedy=f"Make it: meshforge apply {store.folder}",
        )
    return Review(verdict=verdict, note=note, output=output) if verdict else None


def find_accepted_results(store: Store) -> dict[str, tuple[RuleSelection, ...]]:
    """What the program did on the results that were looked at and accepted, by asset; of very many some, evenly."""
    rows = sorted(
        (asset, review)
        for asset, review in store.reviews().items()
        if review.verdict == "accepted" and review.seen and asset in store.found.ids
    )
    some = pick_evenly(rows, MOST_ACCEPTED)
    present = {asset: output_digest(batch.read_stamp(store.layout.edited, asset)) for asset, _ in some}
    return {asset: review.seen for asset, review in some if review.output == present[asset]}


def _read_selections(store: Store, asset: str) -> tuple[RuleSelection, ...]:
    """What the rules selected on an asset; nothing where another program did that, or it was edited by hand."""
    stamp, program = batch.read_stamp(store.layout.edited, asset), store.program()
    made = stamp and stamp.inputs
    if not stamp or not made or not program or made.corrections or made.program != batch.program_digest(program):
        return ()
    return number_selections(program, {line.rule: line.selected for line in stamp.rules})


def number_selections(program: Program, selected: Mapping[int, Iterable[str]]) -> tuple[RuleSelection, ...]:
    """What the rules of a program do to which hulls; selected: names of hulls, by the number of the rule."""
    actions = {
        number: action_text_without_each(rule.action, rule.label) for number, rule in enumerate(program.rules, 1)
    }
    return tuple(
        RuleSelection(rule=rule, action=actions[rule], select=tuple(sorted(hulls))) for rule, hulls in selected.items()
    )


def output_digest(stamp: batch.Stamp | None) -> str | None:
    """One digest of all files of an output, None where there is none."""
    if not stamp or stamp.status not in ("edited", "unchanged"):
        return None
    return batch.text_digest("\n".join(f"{name} {digest}" for name, digest in sorted(stamp.outputs.items())))
