"""What would help where no extractor matches: sentences on the hulls that the nearest one gets wrong."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from meshforge.language import All, Attach, Base, Diff, Extractor, Intersect, Is, Union, show_label
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.example import Example
from meshforge.synthesis.search.miss import NearMiss
from meshforge.words import listed

_MOST = 4  # sentences


def advice(miss: NearMiss, examples: Sequence[Example], answered: Sequence[str] = ()) -> tuple[str, ...]:
    """What a person can look at, the likeliest first; answered: the meshes of which an answer told."""
    example = next(example for example in examples if example.name == miss.asset)
    lines = [*_unlabelled(miss, example), *_nearly_touching(miss, example)]
    if answered:
        one = len(answered) == 1
        lines.append(
            f"{'an answer was' if one else 'answers were'} given for {listed(answered)}: "
            f"{'it' if one else 'they'} can be taken back"
        )
    lines += [*_odd_labels(example, miss.missing, left_out=True), *_odd_labels(example, miss.extra, left_out=False)]
    if len([*miss.extra, *miss.missing]) == 1 and len(example.mesh.hulls) > 1:
        (name,) = [*miss.extra, *miss.missing]
        lines.append(f"if only a part of {name!r} is meant, split the hull (meshforge split)")
    if sum(bool(other.selection) for other in examples) > 1:
        lines.append("if what was shown follows different rules, make two steps of it")
    return tuple(dict.fromkeys(lines))[:_MOST]


def _unlabelled(miss: NearMiss, example: Example) -> Iterator[str]:
    bare = [name for name in [*miss.missing, *miss.extra] if example.mesh.hull_of(name).label is None]
    if bare:
        yield f"{_said(bare, example)} {'has' if len(bare) == 1 else 'have'} no label"


def _odd_labels(example: Example, names: Sequence[str], left_out: bool) -> Iterator[str]:
    """Hulls that are left out, or are too much, by their labels; left out though what is right has another one."""
    right = {hull.label for k, hull in enumerate(example.mesh.hulls) if example.selection >> k & 1}
    by_label: dict[str | None, list[str]] = {}
    for name in names:
        by_label.setdefault(example.mesh.hull_of(name).label, []).append(name)
    for label, alike in by_label.items():
        if label is None:
            continue
        said, verb = _said(alike, example), "is" if len(alike) == 1 else "are"
        others = sorted(show_label(other) for other in right - {label, None} if other)
        if left_out and others:
            usual = f"while others that were shown are labelled {', '.join(others)}"
            yield f"{said} {verb} labelled {show_label(label)}, {usual}: is that right?"
        elif left_out:
            yield f"{verb} {said} rightly labelled {show_label(label)}?"
        else:
            one = len(alike) == 1
            meant = f"if {said} {'is' if one else 'are'} meant, too, show {'it' if one else 'them'}"
            yield f"{meant}; if not, is the label {show_label(label)} right?"


def _said(names: Sequence[str], example: Example) -> str:
    return f"{repr(names[0]) if len(names) == 1 else listed(names)} of {example.name}"


def _nearly_touching(miss: NearMiss, example: Example) -> Iterator[str]:
    """Hulls that miss a contact, which the nearest extractor asks for, by little."""
    mesh = example.mesh
    for anchor in _anchors(miss.extractor):
        for i, j, gap in mesh.near_misses:
            for here, there in ((i, j), (j, i)):
                if mesh.hulls[here].name in miss.missing and _is(mesh, there, anchor):
                    yield (
                        f"{mesh.hulls[here].name!r} and {mesh.hulls[there].name!r} of {example.name} are {gap:.2g} m "
                        f"apart, just too far to count as touching: a larger threshold `contact` would join them"
                    )


def _anchors(extractor: Extractor) -> Iterator[Base]:
    if isinstance(extractor, Attach):
        yield extractor.anchor
    elif isinstance(extractor, Union | Intersect | Diff):
        yield from _anchors(extractor.left)
        yield from _anchors(extractor.right)


def _is(mesh: SymbolicMesh, index: int, base: Base) -> bool:
    match base:
        case All():
            return True
        case Is(label):
            return mesh.hulls[index].label == label
