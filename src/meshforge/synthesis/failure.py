"""What would help where no extractor matches: sentences on the hulls that the nearest one gets wrong."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from meshforge.language import All, Attach, Base, Diff, Extractor, Intersect, Is, Union, show_label
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.example import Example
from meshforge.synthesis.search.miss import NearMiss
from meshforge.words import listed

_MOST = 4  # sentences


def advice(miss: NearMiss, examples: Sequence[Example], answered: Iterable[str] = ()) -> tuple[str, ...]:
    """What a person can look at, the likeliest first; answered: names of meshes that an answer was given for."""
    example = next(example for example in examples if example.name == miss.asset)
    lines = [*_unlabelled(miss, example), *_nearly_touching(miss, example)]
    if miss.asset in answered:
        lines.append(f"an answer was given for {miss.asset}: it can be taken back")
    lines += _odd_labels(miss, example)
    if len([*miss.extra, *miss.missing]) == 1 and len(example.mesh.hulls) > 1:
        (name,) = [*miss.extra, *miss.missing]
        lines.append(f"if only a part of {name!r} is meant, split the hull (meshforge split)")
    if sum(bool(other.selection) for other in examples) > 1:
        lines.append("if the two selections follow different rules, make two steps of them")
    return tuple(dict.fromkeys(lines))[:_MOST]


def _unlabelled(miss: NearMiss, example: Example) -> Iterator[str]:
    bare = [name for name in [*miss.missing, *miss.extra] if example.mesh.named(name).label is None]
    if bare:
        yield f"no label in {example.name}: {listed(bare)}; give {'it' if len(bare) == 1 else 'them'} one"


def _odd_labels(miss: NearMiss, example: Example) -> Iterator[str]:
    """Hulls that are left out, or are too much, though what is right has another label."""
    right = {hull.label for k, hull in enumerate(example.mesh.hulls) if example.selection >> k & 1}
    for name in [*miss.missing, *miss.extra]:
        label = example.mesh.named(name).label
        others = right - {label, None}
        if label and name in miss.missing and others:
            usual = ", ".join(sorted(show_label(other) for other in others if other))
            said = f"{name!r} of {example.name} is labelled {show_label(label)}"
            yield f"{said}, while others that were shown are labelled {usual}: is that right?"
        elif label:
            yield f"is {name!r} of {example.name} rightly labelled {show_label(label)}?"


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
