"""Why learning did not end as hoped: what would help where no extractor matches, and why a program that somebody had
in mind was not learned."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from meshforge import language
from meshforge.common import join_names, pluralize
from meshforge.language import Extractor, leaves_of, show, show_label, size_of
from meshforge.synthesis.candidates.rank import RankedCandidates
from meshforge.synthesis.demonstration import Example, RuleSpec
from meshforge.synthesis.options import Options
from meshforge.synthesis.outcome import candidate_id
from meshforge.synthesis.search.smallest import NearestExtractor
from meshforge.synthesis.search.terms import enumerate_leaves
from meshforge.synthesis.task import LearningTask

_MAX_SENTENCES = 4


def give_advice(miss: NearestExtractor, examples: Sequence[Example], answered: Sequence[str] = ()) -> tuple[str, ...]:
    """Return what a person can look at, the likeliest first; answered: the meshes that an answer is about."""
    example = next(example for example in examples if example.name == miss.asset)
    lines = [*_advise_on_missing_labels(miss, example), *_advise_on_near_contacts(miss, example)]
    if answered:
        one = len(answered) == 1
        lines.append(
            f"{'an answer was' if one else 'answers were'} given for {join_names(answered)}: "
            f"{'it' if one else 'they'} can be taken back"
        )
    lines += [
        *_advise_on_unknown_labels(example, miss.missing, left_out=True),
        *_advise_on_unknown_labels(example, miss.extra, left_out=False),
    ]
    if len([*miss.extra, *miss.missing]) == 1 and len(example.mesh.hulls) > 1:
        (name,) = [*miss.extra, *miss.missing]
        lines.append(f"if only a part of {name!r} is meant, cut the hull (meshforge cut)")
    if sum(bool(other.selection) for other in examples) > 1:
        lines.append("if what was shown follows different rules, make two steps of it")
    return tuple(dict.fromkeys(lines))[:_MAX_SENTENCES]


def _advise_on_missing_labels(miss: NearestExtractor, example: Example) -> Iterator[str]:
    bare = [name for name in [*miss.missing, *miss.extra] if example.mesh.hull_of(name).label is None]
    if bare:
        yield f"{_describe_hulls(bare, example)} {'has' if len(bare) == 1 else 'have'} no label"


def _advise_on_unknown_labels(example: Example, names: Sequence[str], left_out: bool) -> Iterator[str]:
    """Hulls that are left out, or are too much, by their labels; left out though what is right has another one."""
    right = {hull.label for k, hull in enumerate(example.mesh.hulls) if example.selection >> k & 1}
    by_label: dict[str | None, list[str]] = {}
    for name in names:
        by_label.setdefault(example.mesh.hull_of(name).label, []).append(name)
    for label, alike in by_label.items():
        if label is None:
            continue
        hulls, verb = _describe_hulls(alike, example), "is" if len(alike) == 1 else "are"
        others = sorted(show_label(other) for other in right - {label, None} if other)
        if left_out and others:
            usual = f"while others that were shown are labelled {', '.join(others)}"
            yield f"{hulls} {verb} labelled {show_label(label)}, {usual}: is that right?"
        elif left_out:
            yield f"{verb} {hulls} rightly labelled {show_label(label)}?"
        else:
            one = len(alike) == 1
            meant = f"if {hulls} {'is' if one else 'are'} meant, too, show {'it' if one else 'them'}"
            yield f"{meant}; if not, is the label {show_label(label)} right?"


def _describe_hulls(names: Sequence[str], example: Example) -> str:
    return f"{repr(names[0]) if len(names) == 1 else join_names(names)} of {example.name}"


def _advise_on_near_contacts(miss: NearestExtractor, example: Example) -> Iterator[str]:
    """Hulls that miss a contact, which the nearest extractor asks for, by little."""
    mesh = example.mesh
    anchors = [leaf.anchor for leaf in leaves_of(miss.extractor) if isinstance(leaf, language.Attach)]
    for anchor in anchors:
        touched = language.select(anchor, mesh)
        for i, j, gap in mesh.near_misses:
            for here, there in ((i, j), (j, i)):
                if mesh.hulls[here].name in miss.missing and there in touched:
                    yield (
                        f"{mesh.hulls[here].name!r} and {mesh.hulls[there].name!r} of {example.name} are {gap:.2g} m "
                        f"apart, just too far to count as touching: a larger threshold `contact` would join them"
                    )


def find_obstacles(task: LearningTask, wanted: language.Program) -> tuple[str, ...]:
    """Return what keeps a wanted program from being learned before any rule is searched for."""
    lines = []
    if len(wanted.rules) != len(task.rules):
        lines.append(f"{pluralize(len(task.rules), 'rule is', 'rules are')} demonstrated, not {len(wanted.rules)}")
    if wanted.orient != task.frame.orient:
        theirs, ours = (show(orient) if orient else "no orientation" for orient in (wanted.orient, task.frame.orient))
        lines.append(f"it has {theirs}, the demonstrations were looked at with {ours}")
    return tuple(lines)


def follow_rule(
    rule: RuleSpec,
    wanted: Extractor,
    ranked: RankedCandidates | None,
    names: Sequence[str],
    examples: Sequence[Example],
    task: LearningTask,
) -> str:
    """Return one sentence on a rule; ranked: what was learned for it, with the names of the meshes, None where
    nothing."""
    text = f"rule {rule.number}, {show(wanted)}: "
    barred = next(_find_exclusion(wanted, task), None)
    if barred:
        return text + barred
    wrong = next(_find_difference(wanted, examples, task.options.geo_extremity), None)
    if wrong:
        return text + wrong
    if ranked is None:
        return text + "it selects what was shown, but the search did not get that far"
    return text + _find_place(rule.number, wanted, ranked, names, task.options)


def _find_exclusion(wanted: Extractor, task: LearningTask) -> Iterator[str]:
    unknown = [label for label in language.labels_of(wanted) if label not in task.frame.labels]
    if unknown:
        yield f"the label {show_label(unknown[0])} is not in the vocabulary"
    if size_of(wanted) > task.options.max_size:
        yield f"it has {size_of(wanted)} nodes, and the search ends at {task.options.max_size}"
    for leaf in leaves_of(wanted):
        if leaf.layer not in task.options.layers:
            yield f"{type(leaf).__name__} is switched off (layers {task.options.layers})"
    known = {*enumerate_leaves(task.frame.labels, task.options.layers), *task.options.leaves}
    strange = [leaf for leaf in leaves_of(wanted) if leaf not in known]
    if strange:
        yield f"{show(strange[0])} is none of the extractors that were tried"


def _find_difference(wanted: Extractor, examples: Sequence[Example], extremity: float) -> Iterator[str]:
    for example in examples:
        found = language.select_mask(wanted, example.mesh, extremity)
        extra = example.mesh.names_of(found & ~example.selection)
        missing = example.mesh.names_of(example.selection & ~found)
        parts = [f"leaves out {join_names(missing)}"] if missing else []
        parts += [f"selects {join_names(extra)} too"] if extra else []
        if parts:
            yield f"on {example.name} it {' and '.join(parts)}"


def _find_place(rule: int, wanted: Extractor, ranked: RankedCandidates, names: Sequence[str], options: Options) -> str:
    does = ranked.field.bits(wanted)
    place = next((k for k, term in enumerate(ranked.terms) if term.bits == does), None)
    if place is None and options.strategy == "paper":
        return f"it selects what was shown, but {show(ranked.extractor)} comes before it"
    if place is None:
        smallest = min(term.size for term in ranked.terms)
        if size_of(wanted) > smallest + options.above:
            enough = f"{smallest} suffice{'s' if smallest == 1 else ''}"
            return f"it selects what was shown, but has {size_of(wanted)} nodes where {enough}"
        return "it selects what was shown, but there were too many readings to get that far"
    candidate = ranked.terms[place].extractor
    same = "" if candidate == wanted else f" as {show(candidate)}, which selects the same on every asset"
    if place == 0:
        return f"learned{same}"
    return f"reading {candidate_id(rule, place)}{same}; {_explain_preference(ranked, place, names)}"


def _explain_preference(ranked: RankedCandidates, place: int, names: Sequence[str]) -> str:
    differs = [names[k] for k in ranked.differences(place)]
    first, second = ranked.beliefs[0], ranked.beliefs[place]
    better = "more believable" if first >= second else "smaller, though less believable"
    one = "it" if len(differs) == 1 else "one of these"
    return (
        f"{show(ranked.extractor)} is {better} ({first:.0%} against {second:.0%}). "
        f"They differ on {pluralize(len(differs), 'asset')}: {join_names(differs)}; demonstrate {one}"
    )
