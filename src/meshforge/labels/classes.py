"""Classes of hulls, where nobody named parts: a hull's class is the set of the steps that took it, and its likes are of
the same class. A class is a label with a made name (`part_a`: the hulls of step 1), kept beside the labels."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from types import MappingProxyType

from meshforge import language, symbolic, synthesis
from meshforge.batch import EXECUTION_DEFAULTS, ExecutionOptions
from meshforge.geometry import digest
from meshforge.label_model import evidence_of, model_family
from meshforge.labels.family_comparison import compare_assets
from meshforge.labels.labeler import LabelFamily, ignore_stage
from meshforge.store import Store, iterate_asset_index
from meshforge.symbolic import NO_PART, Label, LabelFile, SymbolicMesh, is_class_name, name_class

Rules = frozenset[int]
"""The numbers of the rules that take a hull; none: it is none of the parts."""


def infer_classes(
    meshes: Mapping[str, SymbolicMesh],
    demos: Mapping[str, synthesis.Demonstration],
    answers: Iterable[synthesis.Answer],
    templates: Mapping[str, language.Template],
    hidden: Mapping[str, Mapping[str, Label]] = MappingProxyType({}),
) -> dict[str, SymbolicMesh]:
    """Return the meshes with the classes of hulls that have no label, without any where the steps need none; one whose
    classes stay is the same object.

    demos: by asset; answers: what a person said since of the hulls that rules select; hidden: inferred labels in place
    of which the meshes have classes, as `find_hidden_labels` returns them.
    """
    bare = {name: _remove(mesh, symbolic.CLASS_SOURCES, hidden.get(name, {})) for name, mesh in meshes.items()}
    observed = find_step_labels(bare, demos, answers, templates)
    if not observed:
        return bare
    classes = {label.name for one in observed.values() for label in one.values()} - {NO_PART}
    taken = {
        (asset, hull): Label(word, 1.0, "step")  # so that a name takes no other hulls from the step
        for asset, own in _collect_rules(bare, demos, answers, templates).items()
        for hull, rules in own.items()
        if bare[asset].hull_of(hull).source in symbolic.HUMAN_SOURCES and (word := name_class(rules)) in classes
    }
    annotations = [
        taken.get((asset, hull.name)) or observed.get(asset, {}).get(hull.name) or evidence_of(hull.annotation)
        for asset, mesh in bare.items()
        for hull in mesh.hulls
    ]
    found = model_family(list(bare.values())).infer(annotations)
    classed = dict[str, SymbolicMesh]()
    for place, (asset, mesh) in enumerate(bare.items()):
        labels = _choose_labels(mesh, observed.get(asset, {}), found.labels(place, "class"))
        same = labels == _classes_of(meshes[asset])
        classed[asset] = meshes[asset] if same else mesh.with_labels(labels)
    return classed


def find_step_labels(
    meshes: Mapping[str, SymbolicMesh],
    demos: Mapping[str, synthesis.Demonstration],
    answers: Iterable[synthesis.Answer],
    templates: Mapping[str, language.Template],
) -> dict[str, dict[str, Label]]:
    """Return the classes that follow from steps of hulls without a name, by asset and hull; nothing where each step
    takes hulls with names, and some asset tells what all its hulls are.

    Where a person named hulls of an asset, the others are none of these parts. Where nobody did, a hull that the same
    steps take as some with a name may be that part, and nothing is said of it.
    meshes: those of demonstrated assets at least. While no asset tells what all its hulls are, labels that were
    inferred are no names, but where the same steps take a hull to which that name was given.
    """
    is_complete = any(map(_is_named, meshes.values()))
    bare = meshes if is_complete else {n: _remove(mesh, symbolic.INFERRED_SOURCES) for n, mesh in meshes.items()}
    known = _collect_rules(bare, demos, answers, templates)
    rows = [(asset, bare[asset].hull_of(hull), rules) for asset, one in known.items() for hull, rules in one.items()]
    covered = {rules for _, hull, rules in rows if not _has_no_name(hull)}
    given = {(hull.label, rules) for _, hull, rules in rows if not _has_no_name(hull)}
    by_people = {asset for asset, hull, _ in rows if hull.source in symbolic.HUMAN_SOURCES and not _has_no_name(hull)}
    found = dict[str, dict[str, Label]]()
    for asset, hull, rules in rows:
        if (meshes[asset].hull_of(hull.name).label, rules) in given:
            continue
        if _has_no_name(hull) and (asset in by_people or rules not in covered):
            found.setdefault(asset, {})[hull.name] = Label(name_class(rules), 1.0, "step")
    takes = any(label.name != NO_PART for one in found.values() for label in one.values())
    return found if takes or not is_complete else {}


def find_hidden_labels(store: Store, meshes: Mapping[str, SymbolicMesh]) -> dict[str, Mapping[str, Label]]:
    """Return the inferred labels that steps contradict (`LabelFile.fill`), by asset and hull."""
    found = dict[str, Mapping[str, Label]]()
    for asset, mesh in meshes.items():
        hulls = {hull.name: digest(hull.shape) for hull in mesh.hulls if hull.source == "step"}
        if hulls and (labels := store.labels(asset)).labels:
            found[asset] = symbolic.match_labels(labels, hulls).labels
    return found


def keep_classes(store: Store, before: Mapping[str, SymbolicMesh], after: Mapping[str, SymbolicMesh]) -> None:
    """Write the classes of meshes, by asset, where they are others than before."""
    kept = set(store.layout.classes.ids)
    changed = {asset: format_classes(mesh) for asset, mesh in after.items() if mesh is not before[asset]}
    texts = changed | dict.fromkeys(asset for asset in kept & after.keys() if not _classes_of(after[asset]))
    if texts:
        with store.lock():
            store.write_classes(texts)


def complete_classes(store: Store, execution: ExecutionOptions = EXECUTION_DEFAULTS) -> None:
    """Write the classes of assets that have none and no labels, by those that steps gave: of new assets, of those at
    which learning does not look in a very large family, and where hulls were cut or decomposed since."""
    layout = store.layout
    kept = {one for one in layout.classes.ids if one in store.found.ids}
    shown = {one for one in kept if store.classes(one).labels}
    bare = {one for one in store.assets() if not layout.labels(one).exists()} - shown | (kept - shown)
    facts = iterate_asset_index(store.found, layout, shown, execution=execution)
    bare |= {one for one, own in facts if not own.error and symbolic.match_labels(store.classes(one), own.hulls).gone}
    steps = {
        one: {n: label for n, label in store.labels_and_classes(one).labels.items() if evidence_of(label)}
        for one in shown
    }
    words = sorted({label.name for some in steps.values() for label in some.values()} - {NO_PART})
    if not bare or not words:
        return
    family = LabelFamily(store, tuple(words), execution, ignore_stage)
    compared = compare_assets(family, lambda asset, current: steps.get(asset, current))
    labels = [label for place in range(len(compared.assets)) for label in compared.found.labels(place, "class")]
    texts = dict[str, str | None]()
    for asset, own in compared.share_out(labels):
        classes = {hull: label for hull, label in own.items() if is_class_name(label.name)}
        if asset in bare:
            file = LabelFile((), classes, compared.hulls[asset])
            texts[asset] = symbolic.format_labels(file) if classes else None
    with store.lock():
        store.write_classes(texts)


def class_names(meshes: Iterable[SymbolicMesh]) -> tuple[str, ...]:
    """Return the names of the classes that are on some meshes, sorted."""
    return tuple(sorted({h.label for mesh in meshes for h in mesh.hulls if h.label and is_class_name(h.label)}))


def _remove(
    mesh: SymbolicMesh, sources: Collection[str], hidden: Mapping[str, Label] = MappingProxyType({})
) -> SymbolicMesh:
    """Return a mesh without the labels of some sources, with those that they hid."""
    gone = [hull.name for hull in mesh.hulls if hull.source in sources]
    return mesh.with_labels({name: hidden.get(name) for name in gone}) if gone else mesh


def _is_named(mesh: SymbolicMesh) -> bool:
    """Whether people, files or names said of all hulls what they are."""
    return bool(mesh.hulls) and all(evidence_of(hull.annotation) and not _has_no_name(hull) for hull in mesh.hulls)


def _collect_rules(
    meshes: Mapping[str, SymbolicMesh],
    demos: Mapping[str, synthesis.Demonstration],
    answers: Iterable[synthesis.Answer],
    templates: Mapping[str, language.Template],
) -> dict[str, dict[str, Rules]]:
    """The rules that take each hull, of assets of which that is known."""
    count = max((len(demo.steps) for demo in demos.values()), default=0)
    found = {
        asset: _rules_of_demonstration(demo, meshes[asset], count, templates)
        for asset, demo in demos.items()
        if asset in meshes
    }
    answered = dict[str, dict[int, frozenset[str]]]()
    for answer in answers:
        if answer.select is not None and answer.price is None and answer.asset in meshes and answer.asset not in found:
            answered.setdefault(answer.asset, {})[answer.rule] = answer.select
    for asset, selections in answered.items():
        mesh = meshes[asset]
        if len(selections) == count and all(names <= mesh.index.keys() for names in selections.values()):
            taken = _invert(selections)
            found[asset] = {hull.name: taken.get(hull.name, Rules()) for hull in mesh.hulls}
    return found


def _rules_of_demonstration(
    demo: synthesis.Demonstration, mesh: SymbolicMesh, count: int, templates: Mapping[str, language.Template]
) -> dict[str, Rules]:
    """The rules that take each hull, or what is made of it as long as no step gives that a label.

    Where the demonstration leaves a rule open, only those of hulls that a step takes.
    """
    selections = dict[int, frozenset[str]]()
    replay = language.Replay.begin(mesh, name=demo.name or "", memo=synthesis.memoize)
    origins = {hull.name: frozenset([hull.name]) for hull in mesh.hulls}
    for step in demo.steps:
        if step.select is None:
            replay = replay.skip()
            continue
        selections[step.rule] = frozenset(old for name in step.select for old in origins.get(name, ()))
        replay = replay.apply(replay.mask_of(step.select), step.action, step.label, templates)
        trace = replay.trace[-1]
        for made, sources in zip(trace.made, trace.sources, strict=True):
            origins[made] = frozenset(old for one in sources for old in origins.get(one, ()) if not step.label)
    taken = _invert(selections)
    is_whole = len(demo.steps) == count and not any(step.open for step in demo.steps)
    return {hull.name: taken.get(hull.name, Rules()) for hull in mesh.hulls if is_whole or hull.name in taken}


def _has_no_name(hull: symbolic.Hull) -> bool:
    """Whether nobody named the part that a hull is of."""
    return hull.annotation is None or is_class_name(hull.annotation.name)


def _invert(selections: Mapping[int, frozenset[str]]) -> dict[str, Rules]:
    names = {name for some in selections.values() for name in some}
    return {name: Rules(rule for rule, some in selections.items() if name in some) for name in names}


def _choose_labels(
    mesh: SymbolicMesh, observed: Mapping[str, Label], inferred: Sequence[Label | None]
) -> dict[str, Label]:
    """The classes of the hulls without a label: what was shown, else the likeliest where that is a class."""
    rows = zip(mesh.hulls, inferred, strict=True)
    guesses = {hull.name: one for hull, one in rows if not hull.annotation and one and is_class_name(one.name)}
    return {**guesses, **observed}


def _classes_of(mesh: SymbolicMesh) -> dict[str, Label]:
    return {name: label for name, label in mesh.labels.items() if label.source in symbolic.CLASS_SOURCES}


def format_classes(mesh: SymbolicMesh) -> str | None:
    """Return the text of the file of classes of a mesh, None where it has none."""
    classes = _classes_of(mesh)
    digests = {name: digest(mesh.hull_of(name).shape) for name in classes}
    return symbolic.format_labels(LabelFile((), classes, digests)) if classes else None
