"""Running the program, the job of each asset and the mesh before a rule; and what follows: edits by hand, and what a
person said of results.

A result that is accepted by itself was looked at: what each rule selected there is what was meant, and learning keeps
to it. Who accepts many at once says nothing of each.
"""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from types import MappingProxyType

from meshforge import batch, language, symbolic, synthesis
from meshforge import labels as labelling
from meshforge.common import MeshForgeError, ProjectError, quote_path, suggest_name
from meshforge.geometry import digest
from meshforge.labels.merge import set_labels_of
from meshforge.store import NO_ORIGIN, ExclusionEvent, Feedback, Origin, Store, Verdict, VerdictEvent


def build_jobs(store: Store, only: Collection[str] | None = None) -> tuple[batch.AssetJob, ...]:
    """Return a job for each asset, or for some, with the project's labels and edits by hand."""
    layout, feedback = store.layout, store.feedback()
    return tuple(
        batch.AssetJob(
            asset,
            path,
            store.found.base_of(path),
            layout.labels(asset) if layout.labels(asset).exists() else None,
            store.manual_edits(asset),
            layout.preparation(asset) if (layout.preparation(asset) / batch.RECORD_FILE).exists() else None,
            find_selections(feedback, asset),
            classes=layout.classes(asset) if layout.classes(asset).exists() else None,
        )
        for asset, path in (store.found if only is None else store.every).choose(only).items()
    )


def build_task(store: Store, program: language.Program) -> batch.ApplyTask:
    """Return what `apply` does to each asset; the templates are those of the program and of all edits by hand."""
    corrected = store.found.ids.keys() & set(store.layout.manual_edits.ids)
    edits = (edit for asset in sorted(corrected) for edit in store.manual_edits(asset))
    by_hand = (name for edit in edits for name in edit.action.templates)
    templates = store.templates(dict.fromkeys([*program.templates, *by_hand]))
    options = batch.ApplyOptions(urdf_capsules=store.settings.urdf_capsules)
    return batch.ApplyTask(program, templates, store.layout.edited, options)


def build_work(
    store: Store, only: Collection[str] | None = None
) -> tuple[language.Program, tuple[batch.AssetJob, ...], Mapping[str, language.Template]]:
    """Return what `apply` runs on all assets that are not excluded, or on some: the program, their jobs, and the
    templates.

    Where there is no program, but something is prepared, it is one without rules, which writes what is prepared. Assets
    without classes get some where the program asks for them.
    Raises ProjectError: no program yet and nothing prepared, or no such asset.
    """
    for asset in only or ():
        store.path(asset)
    program = store.program() or make_empty_program(store)
    if program is None:
        word, learn = quote_path(store.folder), bool(store.demonstration_ids())
        show_it = f"Show the steps on an asset or two: meshforge demonstrate {word} ASSET 'HULLS => ACTION' ..."
        remedy = f"Learn it: meshforge synthesize {word}" if learn else show_it
        raise ProjectError("there is no program yet, and nothing is prepared", where=str(store.folder), remedy=remedy)
    if any(map(symbolic.is_class_name, program.labels_asked)):
        labelling.complete_classes(store)
    away = store.exclusions().keys() - set(only or ())
    jobs = tuple(job for job in build_jobs(store, only) if job.id not in away)
    return program, jobs, build_task(store, program).templates


def make_empty_program(store: Store) -> language.Program | None:
    """Return a program without rules, by which assets are written as they are prepared; None where nothing is."""
    return language.Program() if store.found.ids.keys() & set(store.layout.preparation.ids) else None


def mesh_before_rule(
    store: Store,
    asset: str,
    rule: int,
    program: language.Program,
    meshes: Mapping[str, symbolic.SymbolicMesh] | None = None,
) -> symbolic.SymbolicMesh:
    """Return an asset as a rule of a program meets it, rules counted from 1: turned, and edited by the rules before.

    These are done on the hulls that a demonstration shows for them, if there is one. meshes: assets in memory, by id.
    Raises MeshForgeError where the asset cannot be turned, or an action fails.
    """
    mesh = (meshes or {}).get(asset) or store.mesh(asset)
    shown, templates = synthesis.Demonstration(mesh, store.steps(asset)).selections, store.templates(program.templates)
    replays = program.replay(mesh, templates, name=asset, selections=shown, memo=synthesis.memoize)
    *_, met = islice(replays, rule)
    return met.mesh


def correct(store: Store, asset: str, select: Iterable[str], action: language.Action, label: str | None = None) -> None:
    """Add an edit by hand on hulls of an asset, by the names they have after the program and the edits before; what the
    program made there counts as wrong.

    Raises ProjectError for a hull that is not there then.
    """
    with store.lock():
        store.templates(action.templates)  # raises ProgramError
        before = run_with_manual_edits(store, asset, store.mesh(asset), store.program())
        added = make_manual_edit(before.mesh, asset, sorted(set(select)), action, label)
        if not before.manual_edits:
            seen = number_selections(before.program, before.run.trace)
            meant = find_selections(store.feedback(), asset)  # what was edited by hand was made with these
            store.add_events(VerdictEvent(asset=asset, verdict="wrong", note="edited by hand", seen=seen, meant=meant))
        store.write_manual_edits(asset, (*before.manual_edits, added))


@dataclass(frozen=True, eq=False, slots=True)
class RunWithManualEdits:
    """An asset after the program and the edits by hand; flags: a sentence for each of these that was left out."""

    program: language.Program
    templates: Mapping[str, language.Template]
    run: language.RunResult
    manual_edits: tuple[batch.ManualEdit, ...]
    mesh: symbolic.SymbolicMesh
    flags: tuple[str, ...]


def run_with_manual_edits(
    store: Store, asset: str, mesh: symbolic.SymbolicMesh, program: language.Program | None
) -> RunWithManualEdits:
    """Return an asset after a program and its corrections; None changes nothing. Raises MeshForgeError."""
    plan = program or language.Program(orient=store.orientation)
    manual_edits = store.manual_edits(asset)
    names = [*plan.templates, *(name for one in manual_edits for name in one.action.templates)]
    templates = store.templates(dict.fromkeys(names))
    run = plan.run(mesh, templates, selections=batch.selections_of(find_selections(store.feedback(), asset), plan))
    after, flags = batch.replay_manual_edits(manual_edits, mesh, run.mesh, plan, templates)
    return RunWithManualEdits(plan, templates, run, manual_edits, after, flags)


def make_manual_edit(
    mesh: symbolic.SymbolicMesh, asset: str, select: Sequence[str], action: language.Action, label: str | None
) -> batch.ManualEdit:
    """Return one more edit by hand, on hulls of the mesh. Raises ProjectError for a hull that is not there."""
    for name in select:
        if name not in mesh.index:
            remedy = suggest_name(name, mesh.index)
            raise ProjectError(f"after the program there is no hull {name!r}", where=asset, remedy=remedy)
    return batch.ManualEdit(tuple((name, digest(mesh.hull_of(name).shape)) for name in select), action, label)


MOST_ACCEPTED = 100
"""Of more accepted results so many are learned from: each is one more mesh on which every rule must be right."""


def find_selections(feedback: Feedback, asset: str) -> tuple[batch.RuleSelection, ...]:
    """Return what a person said that rules select on an asset, when they called its result wrong."""
    verdict = feedback.verdict_on(asset)
    return verdict.meant if verdict else ()


def review_assets(
    store: Store,
    assets: str | Iterable[str],
    verdict: Verdict | None,
    note: str | None = None,
    *,
    selections: Mapping[int, Collection[str]] = MappingProxyType({}),
    labels: Mapping[str, str] = MappingProxyType({}),
    goals: Sequence[str] = (),
    origin: Origin = NO_ORIGIN,
) -> None:
    """Accept the result of one or several assets, or call it wrong; None takes back what was said, an exclusion too.

    Who judges one by itself looked at it: learning keeps to what the program selected there, or to `selections`: names
    of hulls that rules should have selected, by their numbers; its output is made with these from now on. labels: of
    its hulls, where these are wrong; goals: texts of those that fail on an accepted result, and do not count there.
    Raises ProjectError, with nothing written: no output that could be accepted, no such rule, hull or label.
    """
    names = (assets,) if isinstance(assets, str) else tuple(assets)
    with store.lock():
        events = [_judge(store, asset, verdict, note, selections, origin, alone=len(names) == 1) for asset in names]
        events = [event.model_copy(update={"goals": tuple(goals)}) for event in events] if goals else events
        more = [ExclusionEvent(asset=asset) for asset in names if asset in store.feedback().exclusions]
        given = dict.fromkeys(names, labels) if labels else {}
        store.add_events_before(lambda: set_labels_of(store, given), *events, *more)


def _judge(
    store: Store,
    asset: str,
    verdict: Verdict | None,
    note: str | None,
    selections: Mapping[int, Collection[str]],
    origin: Origin,
    *,
    alone: bool,
) -> VerdictEvent:
    store.path(asset)
    stamp = batch.read_stamp(store.layout.edited, asset)
    output = output_digest(stamp) if verdict else None
    if verdict == "accepted" and not output:
        remedy = f"Make it: meshforge apply {quote_path(store.folder)}"
        raise ProjectError(f"{asset} has no output to be accepted", where=str(store.folder), remedy=remedy)
    program, seen = store.program(), _read_selections(store, stamp) if verdict and alone else ()
    if verdict == "wrong" and alone and program and not seen:  # what it selects is not written as it is
        seen = run_for_selections(store, program, dict(store.meshes_by_id([asset])).get(asset)) or ()
    before = find_selections(store.feedback(), asset) if verdict == "accepted" else ()  # it is made with these
    meant = _replace_selections(store, asset, seen, selections) if selections else before
    return VerdictEvent(
        asset=asset, verdict=verdict, note=note, output=output, seen=seen, meant=meant, **origin._asdict()
    )


def run_for_selections(
    store: Store, program: language.Program, mesh: symbolic.SymbolicMesh | None
) -> tuple[batch.RuleSelection, ...] | None:
    """Return what the rules of a program select on an asset; None where it cannot be read, or the program not run."""
    if mesh is None:
        return None
    try:
        trace = program.run(mesh, store.templates(program.templates), memo=synthesis.memoize).trace
    except MeshForgeError:
        return None
    return number_selections(program, trace)


def _replace_selections(
    store: Store, asset: str, seen: Sequence[batch.RuleSelection], selections: Mapping[int, Collection[str]]
) -> tuple[batch.RuleSelection, ...]:
    """What rules should have selected. Raises ProjectError for one that cannot be: it is tried."""
    program = store.program()
    known = {one.rule: one for one in seen}
    if program is None or not known:
        raise ProjectError("there is no result that selections could correct", where=asset)
    for rule in selections:
        if rule not in known:
            raise ProjectError(f"there is no rule {rule}: the program has {len(known)}", where=asset)
    meant = tuple(
        replace(one, select=tuple(sorted(selections.get(rule, one.select)))) for rule, one in sorted(known.items())
    )
    program.run(
        store.mesh(asset), store.templates(program.templates), selections=batch.selections_of(meant, program)
    )  # raises ProgramError
    return meant


def find_accepted_results(store: Store) -> dict[str, tuple[batch.RuleSelection, ...]]:
    """Return what the program did by itself on results looked at and accepted, by asset; of very many some."""
    verdicts = ((asset, some[-1]) for asset, some in store.feedback().verdicts.items() if asset in store.found.ids)
    rows = [(asset, one) for asset, one in verdicts if one.verdict == "accepted" and one.seen and not one.meant]
    some = labelling.pick_evenly(rows, MOST_ACCEPTED)
    present = {asset: output_digest(batch.read_stamp(store.layout.edited, asset)) for asset, _ in some}
    return {asset: one.seen for asset, one in some if one.output == present[asset]}


def _read_selections(store: Store, stamp: batch.Stamp | None) -> tuple[batch.RuleSelection, ...]:
    """What the rules selected on an asset; nothing where another program did that, or it was edited by hand."""
    made, program = stamp and stamp.inputs, store.program()
    if not stamp or not made or not program or made.manual_edits or made.program != batch.program_digest(program):
        return ()
    return number_selections(program, stamp.rules)


def number_selections(
    program: language.Program, trace: Iterable[language.RuleTrace | batch.RuleEffect]
) -> tuple[batch.RuleSelection, ...]:
    """Return what the rules of a program did to which hulls, by what was noted of each."""
    actions = [batch.action_text_without_each(rule.action, rule.label) for rule in program.rules]
    return tuple(batch.RuleSelection(line.rule, actions[line.rule - 1], tuple(sorted(line.selected))) for line in trace)


def output_digest(stamp: batch.Stamp | None) -> str | None:
    """Return one digest of all files of an output but its labels, which change with every answer though the result is
    the same; None where there is none."""
    if not stamp or stamp.status not in ("edited", "unchanged"):
        return None
    rows = (f"{name} {digest}" for name, digest in sorted(stamp.outputs.items()) if not name.endswith(".labels.json"))
    return batch.text_digest("\n".join(rows))
