"""What would help where no extractor matches what was shown; and hulls that a person probably left out of a
demonstration, or selected, by mistake, and answers and verdicts that probably are one: a much simpler extractor would
select all the others (minimum description length, Rissanen 1978: the size of a rule against the number of its errors).
"""

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

from meshforge import language
from meshforge.common import join_names
from meshforge.language import Extractor, leaves_of, show_label, size_of
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.search.bank import Bank
from meshforge.synthesis.search.smallest import ErrorCounter, NearestExtractor, Search, compare_selection
from meshforge.synthesis.search.terms import Term

_MAX_SENTENCES = 4


def give_advice(miss: NearestExtractor, examples: Sequence[Example], answered: Sequence[str] = ()) -> tuple[str, ...]:
    """Return what a person can look at, the likeliest first; answered: the meshes that an answer is about."""
    example = next(example for example in examples if example.name == miss.asset)
    bare = [name for name in [*miss.missing, *miss.extra] if example.mesh.hull_of(name).label is None]
    lines = [f"{_describe_hulls(bare, example)} {'has' if len(bare) == 1 else 'have'} no label"] if bare else []
    lines += _advise_on_near_contacts(miss, example)
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


MOST_MISTAKES = 2
"""Slips in what is known of one rule."""
MISTAKE, NODE = 3.5, 1.0
"""What a mistake costs, and a node of an extractor [nats]: a person misses about one hull in thirty, and answers as
seldom wrongly; rules that people mean are short."""
_LEAST_NODES, _MOST_NODES = 2, 3  # of an extractor that may come from a slip, and of one that would be simpler


@dataclass(frozen=True, slots=True)
class LikelyMistake:
    """What a person may have meant on one asset, and did not select.

    asset: how messages call it; missing, extra: names of the hulls left out, and selected, by mistake; extractor: the
    simpler one; share: how probable it is.
    """

    asset: str
    missing: tuple[str, ...]
    extra: tuple[str, ...]
    extractor: Extractor
    share: float


def find_mistake(
    extractor: Extractor,
    examples: Sequence[Example],
    vocabulary: Sequence[str],
    options: Options,
    answered: Collection[str] = (),
) -> LikelyMistake | None:
    """Return the likeliest mistake in what was selected on some meshes, None where the extractor is simple enough.
    Where several are needed for a simpler one, the first of them.

    extractor: what was learned; options: with the extremity under which it was; answered: the examples that are answers
    or verdicts, by name, of which each is one mistake, whatever it selects.
    """
    if size_of(extractor) < _LEAST_NODES:
        return None
    used = tuple(leaf for leaf in leaves_of(extractor) if any(one.plugin for one in (leaf, *leaf.bases)))
    bases = tuple(base for leaf in used for base in leaf.bases if base.plugin)
    search = Search(
        examples, vocabulary, TimeBudget(math.inf), replace(options, leaves=tuple(dict.fromkeys((*bases, *used))))
    )
    field, shown = search.field, (1 << search.width) - 1
    bank = Bank([Term(one.bits & shown, one.key, one.form) for one in field.terms], search.width, search.budget)
    rows = zip(search.selections, field.groups, examples, strict=True)
    counters = [(ErrorCounter([mask], [groups], search.width), one.name in answered) for mask, groups, one in rows]

    def count_mistakes(bits: int) -> int:
        count = 0
        for errors, is_answered in counters:
            wrong = errors.count(bits)
            count += min(wrong, 1) if is_answered else wrong
            if count > MOST_MISTAKES:
                break
        return count

    levels = range(1, _MOST_NODES + 1)
    found = [
        (NODE * size + MISTAKE * mistakes, term)
        for size in levels
        for term in bank.level(size).terms
        if 0 < (mistakes := count_mistakes(term.bits)) <= MOST_MISTAKES
    ]
    if not found:
        return None
    nats, best = min(found, key=lambda row: (row[0], row[1].key))
    own = NODE * size_of(extractor) + MISTAKE * count_mistakes(field.term(extractor).bits & shown)
    share = 1 / (1 + math.exp(nats - own))
    place = next(place for place, (errors, _) in enumerate(counters) if errors.count(best.bits))
    differs = compare_selection(best.extractor, field, examples, place)
    return LikelyMistake(differs.asset, differs.extra, differs.missing, best.extractor, share)
