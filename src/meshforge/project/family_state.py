"""What a project knows of its family, as a review sees it: meshes, demonstrations, answers, and what a person said of
results, as far as that counts under the program as it is now; and measures of the results, by which some stand out:
what is not written yet is made in memory for that."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial

from meshforge import batch
from meshforge.common import MeshForgeError
from meshforge.language import Program
from meshforge.project import run
from meshforge.project.demonstrations import actions_of, is_wrong_as_shown
from meshforge.project.hull_mapping import describe_replaced
from meshforge.project.run import output_digest
from meshforge.project.sign_offs import is_written
from meshforge.signoff import EditMeasures, ReviewState, measure_edit
from meshforge.signoff.question import Selections
from meshforge.store import ConfidenceLine, Store, VerdictEvent
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import memoize


def read_family_state(
    store: Store,
    meshes: Mapping[str, SymbolicMesh],
    lost: Mapping[str, str],
    program: Program | None,
    by_hand: bool,
    inputs: Mapping[str, batch.OutputInputs],
) -> ReviewState:
    """Return all that is known. Raises MeshForgeError for files of the project that cannot be read.

    meshes: all assets that can be read, by id; lost: why others cannot be; program: the one that is reviewed, None
    where there is none; by_hand: whether a person wrote it, so that demonstrations say nothing about it; inputs: of the
    edits that it makes.
    """
    feedback, present = store.feedback(), program or store.program()
    demos = {
        asset: replace(demo, mesh=meshes[asset]) for asset, demo in store.demonstrations().items() if asset in meshes
    }
    every = {asset: some for asset, some in feedback.verdicts.items() if asset in meshes}
    last = {asset: some[-1] for asset, some in every.items()}
    own = {a for a, one in last.items() if a not in demos or is_wrong_as_shown(demos[a].steps, one)}
    meant = {a: last[a].meant or (last[a].seen if last[a].verdict == "accepted" else ()) for a in last if a in own}
    wrong = {a: [one.seen for one in some if one.verdict == "wrong"] for a, some in every.items() if a in own}
    accepted = {asset: one for asset, one in last.items() if one.verdict == "accepted"}
    corrected = frozenset(_fit({asset: one.meant for asset, one in last.items()}, present))
    unchanged = {a for a, one in accepted.items() if _stands(store, one, present, meshes[a], inputs.get(a))}
    changed = (
        a for a, one in accepted.items() if a not in {*unchanged, *demos} and _differs(store, one, present, meshes[a])
    )
    actions = actions_of([demo.steps for demo in demos.values()])
    shown = (asset for asset in store.demonstration_ids() if asset in meshes or asset in lost)
    return ReviewState(
        meshes,
        _read_frame(store, meshes, program),
        store.templates(program.templates if program else ()),
        demos,
        by_hand,
        tuple(line.answer for line in feedback.answers.values() if line.fits(actions)),
        meant=_fit(meant, present),
        failed=_fit({asset: some[-1] for asset, some in wrong.items() if some}, present),
        accepted=frozenset(unchanged),
        corrected=corrected,
        wrong=frozenset(a for a in own if last[a].verdict == "wrong") - corrected,
        edited=frozenset(meshes.keys() & store.layout.manual_edits.ids),
        changed=frozenset(changed),
        excluded={asset: why for asset, why in store.exclusions().items() if asset in store.every.ids},
        snoozed=frozenset(feedback.snoozed),
        lost=lost,
        unconfirmed={} if by_hand else {asset: tuple(describe_replaced(store, asset)) for asset in shown},
    )


def _read_frame(store: Store, meshes: Mapping[str, SymbolicMesh], program: Program | None) -> Program:
    settings, limits = store.settings, store.settings.thresholds
    seen = {hull.label for mesh in meshes.values() for hull in mesh.hulls if hull.label}
    words = settings.vocabulary or tuple(sorted(seen))
    return Program(words, program.orient if program else store.orientation, (), limits.contact, limits.extremity)


def _stands(
    store: Store, verdict: VerdictEvent, program: Program | None, mesh: SymbolicMesh, now: batch.OutputInputs | None
) -> bool:
    """Whether the output that a person accepted is there, and the program selects the same, or made that output."""
    stamp = batch.read_stamp(store.layout.edited, verdict.asset)
    if verdict.output != output_digest(stamp):
        return False
    if verdict.seen and not verdict.meant:
        return program is not None and run.run_for_selections(store, program, mesh) == verdict.seen
    return now is not None and is_written(stamp, now)


def _differs(store: Store, verdict: VerdictEvent, program: Program | None, mesh: SymbolicMesh) -> bool:
    """Whether an accepted result is another one by now: as it is written, or as the program would make it."""
    is_other = verdict.output != output_digest(batch.read_stamp(store.layout.edited, verdict.asset))
    own = program if verdict.seen and not verdict.meant else None
    return is_other or (own is not None and run.run_for_selections(store, own, mesh) != verdict.seen)


def _fit(rows: Mapping[str, Sequence[batch.RuleSelection]], program: Program | None) -> dict[str, Selections]:
    """What rules select, by asset, where they are rules of the program."""
    fitting = {asset: batch.selections_of(some, program) for asset, some in rows.items()} if program else {}
    return {asset: tuple(found[rule] for rule in sorted(found)) for asset, found in fitting.items() if found}


def measure_results(
    store: Store,
    program: Program,
    meshes: Mapping[str, SymbolicMesh],
    inputs: Mapping[str, batch.OutputInputs],
    stop: Callable[[], bool] | None = None,
) -> dict[str, EditMeasures]:
    """Return the measures of the results of a program, by asset; of some only once `stop` says so.

    meshes: of the family, by id; inputs: of the edits as they are now. What is known of an output, or of the last
    review, is not measured again while it is up to date; an asset on which the program cannot run has no result.
    """
    task, last, feedback = run.build_task(store, program), store.assessment(), store.feedback()
    digest, lines = batch.program_digest(program), last.assets if last else {}
    found = dict[str, EditMeasures]()
    for asset, mesh in meshes.items():
        if stop and stop():
            break
        now = inputs.get(asset)
        if now and now.program == digest and (known := _recall(store, asset, now, lines.get(asset))):
            found[asset] = known
            continue
        manual_edits, meant = store.manual_edits(asset), run.find_selections(feedback, asset)
        key = (digest, str(batch.template_digests(task.templates)), *map(str, (*manual_edits, *meant)))
        make = partial(_measure, task, mesh, manual_edits, meant)
        with suppress(MeshForgeError):
            found[asset] = memoize(mesh, ("measures", *key), EditMeasures, make)
    return found


def _recall(store: Store, asset: str, now: batch.OutputInputs, line: ConfidenceLine | None) -> EditMeasures | None:
    """The measures of an output or of the last review, None where neither is as this program would make it now."""
    stamp = batch.read_stamp(store.layout.edited, asset)
    if stamp and stamp.measures and is_written(stamp, now):
        return stamp.measures
    return line.measures if line and line.rests_on == now else None


def _measure(
    task: batch.ApplyTask,
    mesh: SymbolicMesh,
    manual_edits: Sequence[batch.ManualEdit],
    meant: Sequence[batch.RuleSelection],
) -> EditMeasures:
    program, templates = task.program, task.templates
    ran = program.run(mesh, templates, selections=batch.selections_of(meant, program), memo=memoize)
    after, _ = batch.replay_manual_edits(manual_edits, mesh, ran.mesh, program, templates)
    return measure_edit(mesh, after, trace=ran.trace)
