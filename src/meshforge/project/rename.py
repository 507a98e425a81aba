"""Another name for a label, or a name for a class, in every file of a project; results and sign-offs go with it."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from meshforge import batch, common
from meshforge import store as files
from meshforge.common import ProjectError, quote_path, suggest_name, write_all_atomically, write_atomically
from meshforge.formats import labels_beside
from meshforge.labels.label_sources import LabelSourcesFile, rename_in_label_sources
from meshforge.labels.like_reference import read_references
from meshforge.language import Program, rename_in_orient, rename_in_program
from meshforge.project import learn
from meshforge.project.goals import rename_in_goal
from meshforge.project.run import output_digest
from meshforge.project.sign_offs import find_bases, find_inputs, is_written
from meshforge.store import AssetOutput, Store, VerdictEvent, find_outputs
from meshforge.symbolic import NO_PART, LabelFile, format_labels, is_class_name, read_labels, refuse_class_names


def rename_label(store: Store, old: str, new: str) -> None:
    """Rename a label of the vocabulary in all that the project keeps; labels files beside the assets stay. A class gets
    a name by it: the hulls that steps took are then labelled by a person, and their likes as propagation labels them.

    A file that cannot be read stops it before anything is written. The vocabulary is written last: killed in between,
    every file is whole and says one name or the other, and renaming again completes it, since the vocabulary has the
    old name still. Only that the program was learned from what there is now may be forgotten by that.
    Raises ProjectError: no such label or class, the new one is there already, or no program could write it;
    UsageError for a new name that stands for hulls of steps.
    """
    with store.lock():
        settings = store.settings
        named = dict(_name_class(store, old, new)) if is_class_name(old) and old != NO_PART else {}
        _check_names(store, old if named else None, old, new)
        texts = dict(_rewrite_files(store, old, new)) | named
        program = store.program()
        after = _rename_in_settings(store, settings, old, new)
        fresh = files.edit_settings(store.folder, {"vocabulary": after.vocabulary, "orient": after.orient})
        fresh = _rename_in_tables(store, fresh, settings, old, new)
        inputs, results = learn.digest_learning_inputs(store), _find_results(store, new)
        for path, text in texts.items():
            write_all_atomically({path: text})
        if program:
            learn.replace_program(store, program, rename_in_program(program, old, new), inputs, after)
        write_atomically(store.layout.settings, fresh)
        _rename_in_results(store, *results, old, new)


def list_renamed_files(store: Store) -> tuple[Path, ...]:
    """Return the files and folders that `rename_label` may write."""
    beside = store.layout.edited.rglob("*.labels.json")
    return (*(file.path(store.folder) for file in files.list_files() if file.words), *beside)


def _check_names(store: Store, named: str | None, old: str, new: str) -> None:
    """Refuse names that make no sense. named: the class that hulls have."""
    where, words = str(store.folder), dict.fromkeys([*store.words, *([named] if named else [])])
    if old not in (*store.vocabulary, named):
        remedy = suggest_name(old, words, f"Labels are: {', '.join(words)}." if words else "No hull has a label yet.")
        raise ProjectError(f"there is no label {old!r}", where=where, remedy=remedy)
    refuse_class_names([new])
    others = {word.casefold(): word for word in words if word != old or new == old}
    if known := others.get(new.casefold()):
        command = f"meshforge label {quote_path(store.folder)} ASSET 'HULLS={known}'"
        remedy = f"Choose another name; or, if both are one part, label the hulls of {old} so: {command}"
        raise ProjectError(f"there is a label {known!r} already", where=where, remedy=remedy)
    if not _is_writable(new):
        remedy = "A label is text of at least one character, without line breaks and control characters."
        raise ProjectError(f"no program could write the label {new!r}", where=where, remedy=remedy)


def _is_writable(label: str) -> bool:
    try:
        return label.isprintable() and Program.parse(str(Program(labels=(label,)))).labels == (label,)
    except common.ProgramError:
        return False


def _name_class(store: Store, old: str, new: str) -> Iterator[tuple[Path, str | None]]:
    """The files of labels in which the hulls of a class have a label, and those of classes without it."""
    layout = store.layout
    for asset in layout.classes.ids:
        classes = store.classes(asset)
        own = {hull: label for hull, label in classes.labels.items() if label.name == old}
        if not own:
            continue
        file = store.labels(asset)
        given = {hull: label.rename(old, new) for hull, label in own.items()}
        labels, words = file.rename(old, new).labels, tuple(dict.fromkeys([*file.vocabulary, new]))
        every = LabelFile(words, {**given, **labels}, {**classes.digests, **file.digests})
        yield layout.labels(asset), format_labels(every)
        rest = {hull: label for hull, label in classes.labels.items() if hull not in own}
        yield layout.classes(asset), format_labels(LabelFile((), rest, classes.digests)) if rest else None


def _rewrite_files(store: Store, old: str, new: str) -> Iterator[tuple[Path, str | None]]:
    layout = store.layout
    for path in map(layout.labels, layout.labels.ids):
        file = read_labels(path)
        if old in (*file.vocabulary, *(name for label in file.labels.values() for name in label.names)):
            yield path, format_labels(file.rename(old, new))
    for path in map(layout.demonstration, layout.demonstration.ids):
        yield from _rename_in_steps(path, files.DemonstrationFile, old, new)
    for path in map(layout.manual_edits, layout.manual_edits.ids):
        yield from _rename_in_steps(path, files.ManualEditsFile, old, new)
    kept = files.read_json(layout.label_sources, LabelSourcesFile) or LabelSourcesFile()
    if (after := files.json_text(rename_in_label_sources(kept, old, new))) != files.json_text(kept):
        yield layout.label_sources, after
    for name, reference in read_references(store).items():
        if old in reference.words.values():
            names = {there: new if here == old else here for there, here in reference.words.items()}
            yield layout.like(name), reference.model_copy(update={"words": names}).format()
    events = files.load_events(layout)
    now = [_rename_in_event(event, layout.events, old, new) for event in events]
    if now != list(events):
        yield layout.events, files.format_lines(now)


def _rename_in_steps(
    path: Path, kind: type[files.DemonstrationFile | files.ManualEditsFile], old: str, new: str
) -> Iterator[tuple[Path, str]]:
    kept = files.read_json(path, kind)
    steps = kept.steps if kept else ()
    lines = tuple(line.model_copy(update={"action": _rename_in_action(line.action, path, old, new)}) for line in steps)
    if kept and lines != steps:
        yield path, files.json_text(kept.model_copy(update={"steps": lines}))


def _rename_in_action(text: str, where: Path, old: str, new: str) -> str:
    action, label = files.parse_action_text(text, where)
    return batch.action_text(action, new) if label == old else text


def _rename_in_event(event: files.Event, where: Path, old: str, new: str) -> files.Event:
    match event:
        case files.LabelFixEvent():
            return event.rename(old, new)
        case files.AnswerEvent() if event.action:
            return event.model_copy(update={"action": _rename_in_action(event.action, where, old, new)})
        case VerdictEvent():
            pairs = (
                tuple(replace(one, action=_rename_in_action(one.action, where, old, new)) for one in some)
                for some in (event.seen, event.meant)
            )
            goals = tuple(rename_in_goal(goal, old, new) for goal in event.goals)
            return event.model_copy(update={**dict(zip(("seen", "meant"), pairs, strict=True)), "goals": goals})
        case files.WithdrawalEvent():
            is_fix = "#" in event.id and event.id.endswith(f"={old}")
            return event.model_copy(update={"id": f"{event.id.removesuffix(old)}{new}"}) if is_fix else event
        case _:
            return event


def _rename_in_tables(store: Store, text: str, settings: files.Settings, old: str, new: str) -> str:
    """The settings with the label's other name in patterns of names, in goals, and where it is described."""
    descriptions, table = settings.vlm.descriptions, "vlm.descriptions"
    try:
        for pattern in (pattern for pattern, label in settings.names.items() if label == old):
            text = files.set_value(text, pattern, new, "names")
        for name, goal in settings.goals.items():
            if (renamed := rename_in_goal(goal, old, new)) != goal:
                text = files.set_value(text, name, renamed, "goals")
        if old in descriptions:
            text = files.set_value(files.set_value(text, new, descriptions[old], table), old, None, table)
    except ProjectError as error:
        raise error.at(str(store.layout.settings)) from None
    return text


def _rename_in_settings(store: Store, settings: files.Settings, old: str, new: str) -> files.Settings:
    vocabulary = tuple(dict.fromkeys([*(new if word == old else word for word in settings.vocabulary), new]))
    before = files.orientation(settings, store.folder)
    after = rename_in_orient(before, old, new) if before else None
    text = settings.orient if after == before else files.orientation_text(after)
    return settings.model_copy(update={"vocabulary": vocabulary, "orient": text})


def _find_results(store: Store, new: str) -> tuple[dict[str, AssetOutput], set[str]]:
    """The outputs and sign-offs that are up to date; none where hulls have the new name already, so that rules may
    select otherwise from now on."""
    program, every = store.program(), map(store.labels_and_classes, store.assets())
    words = {name for file in every for label in file.labels.values() for name in label.names}
    try:
        edits = {} if new in {*words, *(program.labels_in_use if program else ())} else find_inputs(store)
    except common.MeshForgeError:  # nothing can be applied, which a status says
        edits = {}
    outputs, signed = find_outputs(store.layout, edits), store.sign_offs()
    bases = find_bases(store, edits, outputs)
    made = {name: one for name, one in outputs.items() if one.is_whole and is_written(one.stamp, edits[name])}
    return made, {name for name, now in bases.items() if name in signed and not now.changes(signed[name].rests_on)}


def _rename_in_results(store: Store, made: Mapping[str, AssetOutput], signed: set[str], old: str, new: str) -> None:
    """Let labels beside outputs, verdicts on them and sign-offs follow the name, which all else has by now."""
    edits, digests = find_inputs(store) if made or signed else {}, dict[str | None, str | None]()
    for asset, stamp in ((asset, output.stamp) for asset, output in made.items() if output.stamp):
        digests[output_digest(stamp)] = output_digest(_rename_in_output(store, stamp, edits[asset], old, new))

    def follow(event: files.Event) -> files.Event:
        if not isinstance(event, VerdictEvent) or event.output not in digests:
            return event
        return event.model_copy(update={"output": digests[event.output]})

    store.change_events(lambda events: map(follow, events))
    bases, before = find_bases(store, edits, find_outputs(store.layout, edits)), store.sign_offs()
    now = {name: before[name].model_copy(update={"rests_on": bases[name]}) for name in signed}
    store.write_sign_offs({**before, **now})


def _rename_in_output(store: Store, stamp: batch.Stamp, edit: batch.OutputInputs, old: str, new: str) -> batch.Stamp:
    """The stamp of an output in which a label has another name, beside it too. edit: what decides it now."""

    def rename(words: Iterable[str | None]) -> tuple[str | None, ...]:
        return tuple(new if word == old else word for word in words)

    folder, outputs, was = store.layout.edited, dict(stamp.outputs), stamp.inputs or edit
    path = labels_beside(folder / stamp.out)
    if (name := path.relative_to(folder).as_posix()) in outputs:
        write_atomically(path, format_labels(read_labels(path).rename(old, new)))
        outputs[name] = common.file_digest(path)
    now = edit.model_copy(update={"settings": was.settings, "software": was.software})
    labels = {"labels": rename(stamp.labels), "labels_before": stamp.labels_before and rename(stamp.labels_before)}
    made = stamp.model_copy(update={"inputs": now, "outputs": outputs, **labels})
    made.write(batch.stamp_path(folder, stamp.asset))
    return made
