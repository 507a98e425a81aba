"""What a person shows and says, of which a program is learned: the steps on an asset, checked and written; rules moved
or taken out of all demonstrations; answers to questions; and repairs of labels, confirmed or rejected.
"""

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from meshforge import batch, symbolic, synthesis
from meshforge import store as files
from meshforge.common import MeshForgeError, ProjectError, UsageError, quote_path, suggest_among, suggest_name
from meshforge.labels import merge
from meshforge.store import NO_ORIGIN, Origin, Store


def demonstrate(store: Store, asset: str, steps: Iterable[synthesis.Step]) -> None:
    """Set the steps that are demonstrated on an asset; no steps take the demonstration away.

    Raises DemonstrationError for steps that are not numbered in order, ProjectError for a hull that cannot be there:
    every name is a hull of the mesh, or, after the first step, one that an edit of such a hull can have made; and for
    a label that is not in the vocabulary, if there is one.
    """
    mesh, steps, words = store.mesh(asset), tuple(steps), store.vocabulary
    for rule, label in ((step.rule, step.label) for step in steps):
        if label and words and label not in words:
            problem = f"rule {rule}: the label {label!r} is not in the vocabulary"
            raise ProjectError(problem, where=asset, remedy=suggest_among(label, words))
    for rule, name in find_unknown_hulls(synthesis.Demonstration(mesh, steps, asset).steps, mesh.index):
        remedy = suggest_name(name, mesh.index)
        raise ProjectError(f"rule {rule}: there is no hull {name!r}", where=asset, remedy=remedy)
    with store.lock():
        verdict = store.feedback().verdict_on(asset)
        if steps and verdict:  # what is shown now counts, no more what was said of a result before
            if verdict.verdict == "wrong" and shows(steps, verdict.seen):
                store.add_events(files.VerdictEvent(asset=asset))
            elif verdict.meant:
                store.add_events(verdict.model_copy(update={"meant": ()}))
        store.write_steps(asset, steps)


def shows(steps: Iterable[synthesis.Step], done: Iterable[batch.RuleSelection]) -> bool:
    """Return whether steps select just what rules did, as far as they are not open."""
    selected = {one.rule: frozenset(one.select) for one in done}
    return bool(selected) and all(step.select is None or selected.get(step.rule) == step.select for step in steps)


def is_wrong_as_shown(steps: Iterable[synthesis.Step], verdict: files.VerdictEvent) -> bool:
    """Return whether a person called wrong what the steps of the asset show; where they show something else, that is
    the correction."""
    return verdict.verdict == "wrong" and not verdict.meant and shows(steps, verdict.seen)


def correct_selection(store: Store, asset: str, rule: int, select: Sequence[str], origin: Origin = NO_ORIGIN) -> None:
    """Select other hulls in a step of a demonstration after a mistake; on an asset that is not demonstrated by an
    answer, and what was accepted there counts no more. Raises ProjectError where there is no such step, and as
    `demonstrate` and `add_answer` do."""
    with store.lock():
        feedback = store.feedback()
        known = feedback.verdict_on(asset)
        if asset not in store.demonstration_ids() and (known or f"{rule}:{asset}" in feedback.answers):
            more = [files.VerdictEvent(asset=asset, **origin._asdict())] if known else []
            store.add_events(check_answer(store, synthesis.Answer(rule, asset, select)).with_origin(origin), *more)
            return
        steps = store.steps(asset)
        if rule > len(steps) or steps[rule - 1].open:
            raise ProjectError(f"rule {rule} is not demonstrated here any more", where=asset)
        demonstrate(
            store, asset, synthesis.Demonstration(store.mesh(asset), steps, asset).with_selection(rule, select).steps
        )


def find_unknown_hulls(steps: Iterable[synthesis.Step], hulls: Container[str]) -> Iterator[tuple[int, str]]:
    """Yield the rules and names of steps that cannot be meant: no such hull, and none that it could be made of."""
    for step in steps:
        for name in sorted(step.select or ()):
            stem = name.rpartition("~")[0] if step.rule > 1 else name
            if name not in hulls and stem not in hulls:
                yield step.rule, name


def move_rule(store: Store, rule: int, to: int) -> None:
    """Put a rule at another place in all demonstrations and answers. Raises UsageError for a wrong number.

    A demonstration that says nothing about a rule in between leaves it open.
    """
    with store.lock():
        kept = _read_demonstration_files(store)
        order = _rule_numbers(kept, rule, to)
        order.insert(to - 1, order.pop(rule - 1))
        _write_reordered(store, kept, order)


def delete_rule(store: Store, rule: int) -> None:
    """Take a rule out of all demonstrations, and the answers about it. Raises UsageError for a wrong number.

    A demonstration without any step goes away with it.
    """
    with store.lock():
        kept = _read_demonstration_files(store)
        order = _rule_numbers(kept, rule)
        order.remove(rule)
        _write_reordered(store, kept, order)


def _read_demonstration_files(store: Store) -> dict[Path, files.DemonstrationFile]:
    """All demonstrations by file. Raises ProjectError where one cannot be read, or its steps are not in order."""
    layout = store.layout
    paths = map(layout.demonstration, layout.demonstration.ids)
    found = {path: files.read_json(path, files.DemonstrationFile) for path in paths}
    kept = {path: file for path, file in found.items() if file}
    for path, file in kept.items():
        if [line.rule for line in file.steps] != list(range(1, len(file.steps) + 1)):
            remedy = "Number them 1, 2, 3 and so on by hand, in the order in which they were done."
            raise ProjectError("its steps are not numbered in order", where=str(path), remedy=remedy)
    return kept


def _rule_numbers(kept: Mapping[Path, files.DemonstrationFile], *asked: int) -> list[int]:
    """The numbers of all rules. Raises UsageError where one that is asked for is not among them."""
    most = max((len(file.steps) for file in kept.values()), default=0)
    for rule in asked:
        if not 1 <= rule <= most:
            shown = f"rules 1 to {most} are demonstrated" if most else "nothing is demonstrated"
            raise UsageError(f"there is no rule {rule}: {shown}")
    return list(range(1, most + 1))


def _write_reordered(store: Store, kept: Mapping[Path, files.DemonstrationFile], order: Sequence[int]) -> None:
    """Write demonstrations and answers with the rules in another order, each file for itself.

    order: the old number of the rule that is first from now on, of the second, and so on.
    """
    lines = [line for file in [*kept.values()][::-1] for line in file.steps]
    actions = {line.rule: line.action for line in sorted(lines, key=lambda line: bool(line.select))}
    for path, file in kept.items():
        steps = _reorder(file.steps, order, actions)
        if not steps:
            path.unlink(missing_ok=True)
        elif steps != file.steps:
            files.write_json(path, file.model_copy(update={"steps": steps}))
    store.change_events(lambda events: _renumber(events, order, len(actions)))


def _reorder(
    lines: Sequence[files.StepLine], order: Sequence[int], actions: Mapping[int, str]
) -> tuple[files.StepLine, ...]:
    own = {line.rule: line for line in lines}
    last = max((place for place, rule in enumerate(order, 1) if rule in own), default=0)
    open_steps = {rule: files.StepLine(rule=rule, select=None, action=action) for rule, action in actions.items()}
    steps = [(open_steps | own)[rule] for rule in order[:last]]
    return tuple(step.model_copy(update={"rule": place}) for place, step in enumerate(steps, 1))


def _renumber(events: Iterable[files.Event], order: Sequence[int], before: int) -> Iterator[files.Event]:
    """The events with answers about other numbers; before: how many rules there were. Answers beyond these stay."""
    places = {rule: place for place, rule in enumerate(order, 1)}
    for event in events:
        if not isinstance(event, files.AnswerEvent) or event.rule > before:
            yield event
        elif event.rule in places:
            yield event.model_copy(update={"rule": places[event.rule]})


def add_answer(store: Store, answer: synthesis.Answer) -> str:
    """Answer for a rule by any selection, whether that was asked for or not; give the answer's id `RULE:ASSET`.

    It takes the place of an earlier answer to the same question. Raises ProjectError: no such asset or rule.
    """
    event = check_answer(store, answer)
    store.add_events(event)
    return event.id


def check_answer(store: Store, given: synthesis.Answer) -> files.AnswerEvent:
    """Return an answer as it is kept. Raises ProjectError: no such asset or rule. Its hulls may be made by a rule."""
    store.path(given.asset)
    actions = actions_of(map(store.steps, store.demonstration_ids()))
    if given.rule not in actions:
        shown = f"only rules 1 to {max(actions)} are" if actions else "nothing is"
        raise ProjectError(f"there is no rule {given.rule} to answer for: {shown} demonstrated", where=given.asset)
    select = None if given.select is None else tuple(sorted(given.select))
    refused = tuple(tuple(sorted(choice)) for choice in given.refused)
    return files.AnswerEvent(
        rule=given.rule, asset=given.asset, select=select, action=actions[given.rule], refused=refused
    )


def actions_of(demonstrations: Iterable[Iterable[synthesis.Step]]) -> dict[int, str]:
    """Return what each rule does, as the first demonstration that shows it says, without `Each`."""
    found: dict[int, str] = {}
    for step in (step for steps in demonstrations for step in steps if step.shown):
        found.setdefault(step.rule, batch.action_text_without_each(step.action, step.label))
    return dict(sorted(found.items()))


def confirm(store: Store, right: synthesis.LabelFix, origin: Origin = NO_ORIGIN) -> str:
    """Repair a label, as a `Repair` proposes it or not, remembering the one before; give the repair's id
    `ASSET#HULL=LABEL`.

    Raises ProjectError where the asset, the hull or the label is not there, or the hull has another label by now.
    """
    with store.lock():
        mesh, fixed = store.mesh(right.asset), _label_of_repair(right)
        given = {right.hull: fixed}
        labels, report = merge.merge_labels(right.asset, mesh.index, mesh.labels, given, store.vocabulary)
        problem = report.problems[0] if report.problems else None
        if not problem and (label := mesh.hull_of(right.hull).label) not in (right.was, right.to):
            problem = f"{right.hull} is labelled {label or 'nothing'} now, no longer {right.was or 'nothing'}"
        if problem:
            raise ProjectError(
                problem, where=right.asset, remedy=f"Learn again: meshforge synthesize {quote_path(store.folder)}"
            )
        event = files.LabelFixEvent(asset=right.asset, hull=right.hull, was=right.was, to=right.to, accepted=True)
        known, current = store.feedback().fixes.get(event.id), mesh.hull_of(right.hull).annotation
        is_repeated = known and known.accepted and current == fixed
        before = known.before if known and is_repeated else files.LabelBefore.of(current)
        # the record first: killed in between, the repair is merely proposed again
        store.add_events(event.model_copy(update={"before": before}).with_origin(origin))
        store.write_labels(right.asset, files.hull_digests(mesh), labels, store.vocabulary)
    return event.id


def reject(store: Store, wrong: synthesis.LabelFix, origin: Origin = NO_ORIGIN) -> str:
    """Refuse a repair, so that it is not proposed again; give its id."""
    store.path(wrong.asset)
    event = files.LabelFixEvent(asset=wrong.asset, hull=wrong.hull, was=wrong.was, to=wrong.to, accepted=False)
    store.add_events(event.with_origin(origin))
    return event.id


def take_back(store: Store, answer: str) -> str | None:
    """Take back an answer or a repair by its id, or what was said of the result of an asset; the hull of a confirmed
    repair gets the label it had before.

    Gives a sentence where that label was changed since, and is left alone. Raises ProjectError, naming the nearest id,
    where there is no such one.
    """
    with store.lock():
        feedback = store.feedback()
        kept = feedback.answers_and_fixes
        if answer in feedback.verdicts or answer in feedback.exclusions:
            store.add_events(files.VerdictEvent(asset=answer), files.ExclusionEvent(asset=answer))
            return None
        if answer not in kept:
            listing = f"See what was said: meshforge review {quote_path(store.folder)} --list-answers"
            remedy = suggest_name(answer, kept, listing)
            raise ProjectError(f"there is no answer or repair {answer!r}", where=str(store.folder), remedy=remedy)
        event = kept[answer]
        note = _restore_label(store, event) if isinstance(event, files.LabelFixEvent) and event.accepted else None
        store.add_events(files.WithdrawalEvent(id=answer))
    return note


def forget_answers(store: Store) -> tuple[str, ...]:
    """Take back everything; gives the sentences about labels that are left alone."""
    notes = [take_back(store, entry) for entry in store.feedback().answers_and_fixes]
    return tuple(note for note in notes if note)


def _label_of_repair(fix: synthesis.LabelFix) -> symbolic.Label:
    return symbolic.Label(fix.to, 1.0, "repair")


def _restore_label(store: Store, line: files.LabelFixEvent) -> str | None:
    """Give a hull the label back that it had before a repair; a sentence on why, where that is not done."""
    try:
        mesh = store.mesh(line.asset)
        current = mesh.hull_of(line.hull).annotation
    except MeshForgeError as error:
        return f"the label of {line.hull} in {line.asset} is left as it is: {error.problem}"
    before = line.before.annotation if line.before else None
    if current not in (before, _label_of_repair(line.fix)):
        state = f"labelled {current.name}" if current else "without a label"
        return f"{line.hull} in {line.asset} is left {state}, as it was changed after the repair"
    if current != before:
        labels = mesh.with_labels({line.hull: before}).labels
        store.write_labels(line.asset, files.hull_digests(mesh), labels, store.vocabulary)
    return None
