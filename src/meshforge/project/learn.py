"""The program of a project: learned from its demonstrations on some of its assets and from what a person said since,
accepted, and compared with what it was learned from.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from meshforge import batch, language, symbolic, synthesis
from meshforge import labels as labelling
from meshforge.common import (
    MeshForgeError,
    ProgramError,
    ProjectError,
    file_digest,
    quote_path,
    relative_name,
    write_atomically,
)
from meshforge.labels import classes
from meshforge.project import demonstrations
from meshforge.project.evidence import list_accepted, list_corrected, list_rejections, list_wrong, soften, sort_answers
from meshforge.store import ProgramRecord, Settings, Store

MOST_ASSETS = 400
"""Of more assets so many are looked at while a program is learned, besides those of which something was said: they are
all read and edited again after each answer. A variant that one asset in a hundred has is then missed once in fifty."""

MOST_COMPARED = 100
"""Of more assets so many are looked at, evenly over all: each has to be read."""


def select_assets(store: Store) -> tuple[str, ...]:
    """Return the assets to learn from: all, of very many those that a person said something about, and some evenly."""
    feedback, every = store.feedback(), store.assets()
    if len(every) <= MOST_ASSETS:
        return every
    known = {line.asset for line in feedback.answers.values()} | feedback.verdicts.keys()
    known.update(store.demonstration_ids())
    known.update(labelling.pick_evenly(every, MOST_ASSETS))
    return tuple(asset for asset in every if asset in known)


def sees_whole_family(store: Store) -> bool:
    """Return whether learning looks at all assets."""
    return len(store.assets()) <= MOST_ASSETS


def suggest_first_demonstration(store: Store, assets: Sequence[str]) -> str | None:
    """Return the id of the asset that tells most when it is demonstrated, None where there is nothing to choose by.

    assets: ids of those that come into question.
    """
    if len(assets) < 2:
        return next(iter(assets), None)
    meshes: dict[str, symbolic.SymbolicMesh] = {}
    for asset in labelling.pick_evenly(assets, MOST_COMPARED):
        try:
            meshes[asset] = store.mesh(asset)
        except MeshForgeError:  # the status names it, with the reason
            continue
    settings = store.settings
    limits = settings.thresholds
    return synthesis.choose_first_demonstration(
        meshes, settings.vocabulary, store.orientation, limits.contact, limits.extremity
    )


@dataclass(frozen=True, slots=True)
class ProgramState:
    """Whether a program is up to date with what it was learned from.

    outdated: whether that changed since; question: the id of the one that was open when it was learned;
    by_hand: whether a person wrote or changed the program, which then was learned from nothing.
    """

    outdated: bool = False
    question: str | None = None
    by_hand: bool = False


def accept_outcome(store: Store, outcome: synthesis.Found | synthesis.Ambiguous, inputs: str) -> None:
    """Keep a learned program, and what it was learned from."""
    store.write_program(outcome.program)
    question = outcome.open_rule.id if outcome.open_rule else None
    record = ProgramRecord(
        program=batch.program_digest(outcome.program), inputs_digest=inputs, status=outcome.status, question=question
    )
    store.write_program_record(record)


def program_by_hand(store: Store) -> synthesis.Found | None:
    """Return the program that a person wrote, as if it were learned; None where there is none."""
    program = store.program()
    if program is None or not program_state_of(store, program).by_hand:
        return None
    return synthesis.Found(rules=program.rules, candidates=(), tried=(), seconds={}, program=program)


def read_program_state(store: Store) -> ProgramState:
    """Return the state of the project's program; one that does not parse was written by a person."""
    try:
        return program_state_of(store, store.program())
    except ProgramError:
        return ProgramState(by_hand=True)


def program_state_of(store: Store, program: language.Program | None) -> ProgramState:
    """Return the state of a program; one that a person wrote or changed is never outdated."""
    if program is None:
        return ProgramState()
    record = store.program_record()
    if not record or record.program != batch.program_digest(program):
        return ProgramState(by_hand=True)
    outdated = record.inputs_digest != digest_learning_inputs(store)
    return ProgramState(outdated, None if outdated else record.question)


def replace_program(
    store: Store, old: language.Program, new: language.Program, inputs: str, settings: Settings
) -> None:
    """Keep a program in which a label was renamed, in the same state; under the lock that the caller holds.

    inputs: the digest of what was learned from, before anything was renamed; settings: what they are going to be.
    What it was learned from is written first: killed in between, it is that of the new program already.
    """
    record = store.program_record()
    if record and record.program in (batch.program_digest(old), batch.program_digest(new)):
        now = digest_learning_inputs(store, settings) if record.inputs_digest == inputs else record.inputs_digest
        store.write_program_record(
            record.model_copy(update={"program": batch.program_digest(new), "inputs_digest": now})
        )
    if new != old:
        write_atomically(store.layout.program, str(new))


def digest_learning_inputs(store: Store, settings: Settings | None = None) -> str:
    """Return the digest of all that is learned from: settings, what a person said, and all about the assets of which
    they said something: steps, labels and files. settings: in place of those that are written.
    """
    layout, feedback = store.layout, store.feedback()
    words: list[object] = [digest_settings(settings or store.settings), digest_demonstrations(store)]
    words += [line.model_dump(mode="json") for line in feedback.answers_and_fixes.values()]
    shown = set(store.demonstration_ids())
    last = [some[-1] for asset, some in feedback.verdicts.items() if asset not in shown]
    words += [f"{one.seen} {one.meant}" for one in last if one.meant or (one.verdict == "wrong" and one.seen)]
    concerned = {line.asset for line in feedback.answers.values()} | shown
    for asset, path in store.found.ids.items():
        if asset in concerned:
            labels = batch.content_digest(layout.labels(asset)) if layout.labels(asset).exists() else None
            asset_file = file_digest(path) if path.is_file() else None
            words.append([asset, labels, batch.record_digest(layout.preparation(asset)), asset_file])
    return batch.value_digest(words)


def digest_settings(settings: Settings) -> str:
    """Return the digest of the settings that decide labels and program."""
    words = [settings.orient, settings.vocabulary, settings.thresholds.model_dump(), *settings.extractors]
    return batch.value_digest(words)


def digest_demonstrations(store: Store) -> str:
    """Return the digest of all steps that people showed."""
    return batch.value_digest(
        {asset: batch.content_digest(store.layout.demonstration(asset)) for asset in store.demonstration_ids()}
    )


def renew_program(
    store: Store, meshes: Mapping[str, symbolic.SymbolicMesh]
) -> tuple[synthesis.LearningOutcome | None, bool]:
    """Learn what becomes the project's program, unless a person wrote one in its place; the outcome, and whether so."""
    if by_hand := program_by_hand(store):
        return by_hand, True
    if not store.demonstration_ids():
        return None, False
    program, inputs, some = store.program(), digest_learning_inputs(store), set(select_assets(store))
    outcome = learn_program(store, accept=False, meshes={name: mesh for name, mesh in meshes.items() if name in some})
    if isinstance(outcome, synthesis.Found | synthesis.Ambiguous):
        is_same = program is not None and batch.program_digest(program) == batch.program_digest(outcome.program)
        if not is_same or program_state_of(store, program).outdated:
            accept_outcome(store, outcome, inputs)
    return outcome, False


def update_classes(
    store: Store, meshes: Mapping[str, symbolic.SymbolicMesh], *, keep: bool = True
) -> dict[str, symbolic.SymbolicMesh]:
    """Return meshes by asset with the classes that follow from what was demonstrated and said; those whose classes stay
    are the same objects. keep: write what changed."""
    shown = [asset for asset in store.demonstration_ids() if asset in meshes]
    demos = {asset: synthesis.Demonstration(meshes[asset], store.steps(asset), asset) for asset in shown}
    if not demos and (program := store.program()) and {*program.labels_asked} & {*classes.class_names(meshes.values())}:
        return dict(meshes)
    feedback = store.feedback()
    fitting, _ = sort_answers(feedback, demos)
    answers = [*list_accepted(store, demos, fitting), *list_corrected(feedback, demos), *fitting]
    hidden = classes.find_hidden_labels(store, meshes)
    found = classes.infer_classes(meshes, demos, answers, store.templates_in(demos.values()), hidden)
    if keep:
        classes.keep_classes(store, meshes, found)
    return found


def forget_learned(store: Store) -> tuple[str, ...]:
    """Remove the program and the classes that were learned from steps of which none is left; the paths that are gone,
    from the project's folder. A program by hand stays, with its classes; one that goes stays as the previous one."""
    if store.demonstration_ids() or read_program_state(store).by_hand:
        return ()
    with store.lock():
        layout, program = store.layout, store.layout.program
        own = [program, layout.learned, *(layout.classes(asset) for asset in layout.classes.ids)]
        gone = tuple(relative_name(path, store.folder) for path in own if path.exists())
        if program.exists():
            program.replace(layout.previous_program)
        layout.learned.unlink(missing_ok=True)
        store.write_classes(dict.fromkeys(layout.classes.ids))
    return gone


Confirm = Callable[[synthesis.Repair], bool]


def learn_program(
    store: Store,
    *,
    accept: bool = True,
    options: synthesis.Options | None = None,
    confirm: Confirm | None = None,
    stop: Callable[[], bool] | None = None,
    meshes: Mapping[str, symbolic.SymbolicMesh] | None = None,
) -> synthesis.LearningOutcome:
    """Learn the program from the demonstrations and from what a person said since.

    Where steps take hulls without a label, these get classes, which rules then ask for.

    accept: what is found becomes the project's program, and classes and what `confirm` says of repairs are kept.
    confirm, stop: as of `meshforge.synthesize`.
    meshes: the assets by id, where they are in memory already; else they are read, of very many some.
    Raises ProjectError where nothing is demonstrated.
    """
    meshes = dict(store.meshes_by_id(select_assets(store))) if meshes is None else meshes
    meshes = update_classes(store, meshes, keep=accept)
    demos = _read_demonstrations(store, meshes)
    inputs = digest_learning_inputs(store)
    feedback = store.feedback()
    fitting, unfit = sort_answers(feedback, demos)
    accepted, wrong = list_accepted(store, demos, fitting), list_wrong(feedback, demos, meshes)
    asker = _RepairAsker(store, confirm) if accept and confirm else None
    settings = store.settings
    ask = _ask_once(asker or confirm) if confirm else None
    templates = store.templates_in(demos.values())
    options = options or synthesis.Options()
    wanted = () if options.strategy == "paper" else (*settings.extractors, *options.extractors)
    options = replace(
        options,
        extractors=wanted,
        contact=settings.thresholds.contact,
        extremity=settings.thresholds.extremity,
        rejected=tuple(list_rejections(feedback)),
        stop=stop,
    )

    def learn(answers: Sequence[synthesis.Answer]) -> synthesis.LearningOutcome:
        return synthesis.synthesize(
            tuple(demos.values()),
            family=meshes,
            orient=store.orientation,
            templates=templates,
            vocabulary=(*settings.vocabulary, *classes.class_names(meshes.values())) or None,
            options=options,
            confirm=ask,
            answers=answers,
        )

    outcome = learn([*accepted, *fitting, *wrong])
    if isinstance(outcome, synthesis.NoProgram | synthesis.NeedsRepair) and wrong:
        wrong = soften(wrong)  # other labels may be at fault there
        outcome = learn([*accepted, *fitting, *wrong])
    if isinstance(outcome, synthesis.NoProgram) and accepted:
        overruled = tuple(dict.fromkeys(answer.asset for answer in accepted))
        outcome = replace(learn([*fitting, *wrong, *soften(accepted)]), overruled=overruled)
    stale = [answer for answer in outcome.stale if answer not in (*accepted, *wrong)]
    outcome = replace(outcome, stale=tuple(dict.fromkeys([*unfit, *stale])))
    if accept and isinstance(outcome, synthesis.Found | synthesis.Ambiguous):
        accept_outcome(store, outcome, asker.inputs if asker and asker.inputs else inputs)
    return outcome


def _ask_once(confirm: Confirm) -> Confirm:
    answers: dict[synthesis.LabelFix, bool] = {}

    def ask(repair: synthesis.Repair) -> bool:
        if repair.fix not in answers:
            answers[repair.fix] = confirm(repair)
        return answers[repair.fix]

    return ask


class _RepairAsker:
    """Asks about repairs and keeps the answers at once. inputs: the digest of what is learned from, since then."""

    def __init__(self, store: Store, confirm: Confirm) -> None:
        self._store, self._confirm = store, confirm
        self.inputs: str | None = None

    def __call__(self, repair: synthesis.Repair) -> bool:
        right = self._confirm(repair)
        (demonstrations.confirm if right else demonstrations.reject)(self._store, repair.fix)
        self.inputs = digest_learning_inputs(self._store)
        return right


def _read_demonstrations(
    store: Store, meshes: Mapping[str, symbolic.SymbolicMesh]
) -> dict[str, synthesis.Demonstration]:
    ids = store.demonstration_ids()
    if not ids:
        command = f"meshforge demonstrate {quote_path(store.folder)} ASSET 'HULLS => ACTION' ..."
        remedy = f"Show the steps on an asset or two: {command}"
        raise ProjectError("nothing is demonstrated yet", where=str(store.folder), remedy=remedy)
    # one that cannot be read is missing among the meshes; reading it again says why
    return {
        asset: synthesis.Demonstration(meshes.get(asset) or store.mesh(asset), store.steps(asset), asset)
        for asset in ids
    }
