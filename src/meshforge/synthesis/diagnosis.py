"""What would help where no extractor matches what was shown."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from meshforge import language
from meshforge.common import join_names
from meshforge.language import leaves_of, show_label
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.search.smallest import NearestExtractor

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
