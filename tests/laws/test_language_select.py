"""Laws of the extractors: what they select is what the paper's set-builder definitions say."""

import itertools

import numpy as np
from hypothesis import given

from meshforge.geometry import Aabb
from meshforge.geometry.proximity import distance
from meshforge.language import (
    EXTREMITY,
    All,
    Attach,
    Diff,
    Direction,
    Each,
    Extractor,
    Geo,
    Intersect,
    Is,
    Merge,
    Union,
    select,
    size_of,
)
from meshforge.symbolic import SymbolicMesh, bits_of, mask_of, split_by_contact
from tests.examples import examples
from tests.strategies import extractors, meshes


def naive(extractor: Extractor, mesh: SymbolicMesh) -> set[int]:
    """The definitions of the paper, written down as they stand."""
    everything = set(range(len(mesh.hulls)))
    match extractor:
        case All():
            return everything
        case Is(label):
            return {g for g in everything if mesh.hulls[g].label == label}
        case Attach(selected, anchor):
            others = naive(anchor, mesh)
            return {g for g in naive(selected, mesh) if any(touching(mesh, g, other) for other in others)}
        case Geo(base, direction):
            q = naive(base, mesh)
            far = max((reach(mesh, g, direction) for g in q), default=0.0)
            allowed = EXTREMITY * diagonal(mesh, q) + 1e-9 * mesh.diagonal
            return {g for g in q if far - reach(mesh, g, direction) <= allowed}
        case Union(left, right):
            return naive(left, mesh) | naive(right, mesh)
        case Intersect(left, right):
            return naive(left, mesh) & naive(right, mesh)
        case Diff(left, right):
            return naive(left, mesh) - naive(right, mesh)
        case _:
            raise AssertionError(f"{extractor} is none of the paper's")


def touching(mesh: SymbolicMesh, u: int, v: int) -> bool:
    return u != v and distance(mesh.hulls[u].shape, mesh.hulls[v].shape) <= (0.002 + 1e-9) * mesh.diagonal


def reach(mesh: SymbolicMesh, g: int, direction: Direction) -> float:
    unit = np.zeros(3)
    unit["XYZ".index(direction[1])] = 1.0 if direction[0] == "+" else -1.0
    return float(mesh.hulls[g].shape.support(unit) @ unit)


def diagonal(mesh: SymbolicMesh, q: set[int]) -> float:
    return Aabb.union(mesh.hulls[g].aabb for g in q).diagonal if q else 0.0


@given(meshes(), extractors())
@examples(150)
def test_extractors_select_what_their_set_builder_definitions_say(mesh: SymbolicMesh, extractor: Extractor) -> None:
    assert select(extractor, mesh) == naive(extractor, mesh) == extractor.select(mesh)


@given(meshes(), extractors())
@examples(60)
def test_components_partition_a_selection_into_chains_of_contacts(mesh: SymbolicMesh, extractor: Extractor) -> None:
    chosen = select(extractor, mesh)
    parts = [bits_of(part) for part in split_by_contact(mesh, mask_of(chosen))]
    assert sorted(g for part in parts for g in part) == sorted(chosen)
    assert [min(part) for part in parts] == sorted(min(part) for part in parts)
    of = {g: k for k, part in enumerate(parts) for g in part}
    for u, v in itertools.combinations(sorted(chosen), 2):
        one_body = mesh.hulls[u].body == mesh.hulls[v].body
        assert not (one_body and touching(mesh, u, v)) or of[u] == of[v]
        assert one_body or of[u] != of[v]
    assert all(connected(mesh, part) for part in parts)
    assert Each(Merge()).groups(mesh, mask_of(chosen)) == split_by_contact(mesh, mask_of(chosen))


def connected(mesh: SymbolicMesh, part: frozenset[int]) -> bool:
    seen = {min(part)}
    while True:
        grown = seen | {v for v in part for u in seen if touching(mesh, u, v)}
        if grown == seen:
            return seen == part
        seen = grown


@given(extractors(max_leaves=6))
@examples(100)
def test_the_size_counts_the_words_of_the_printed_extractor(extractor: Extractor) -> None:
    text = repr(extractor)  # the dataclass form names every node once
    nodes = sum(text.count(f"{word}(") for word in ("All", "Is", "Attach", "Geo", "Union", "Intersect", "Diff"))
    assert size_of(extractor) == nodes
