"""Labels that the built-in propagation carries over from meshes which a person labelled."""

from __future__ import annotations

from benchmark.study.desk import Bench, Desk
from meshforge.label_model import reference_label
from meshforge.symbolic import Label, SymbolicMesh


def begin_by_hand(bench: Bench, count: int) -> tuple[Desk, frozenset[str], int]:
    """All meshes once as many are labelled by hand as `count`, each the one that is advised.

    With the names of those, and how many labels a person gave for that.
    """
    desk = Desk(bench, {name: mesh.with_labels(dict.fromkeys(mesh.index)) for name, mesh in bench.truth.meshes.items()})
    names, done, given = list(desk.meshes), list[str](), 0
    for _ in range(count):
        (advised,) = bench.relatives.propagate(_labels_of(desk)).next_to_label()
        done.append(names[advised])
        desk, more = label_by_hand(desk, names[advised])
        given += more
    return desk, frozenset(done), given


def label_by_hand(desk: Desk, name: str) -> tuple[Desk, int]:
    """The meshes when a person has looked through the labels of one, and they were carried over again.

    With the number of labels that were not right there. What a person said before stays.
    """
    true = desk.bench.truth.meshes[name]
    wrong = sum(a.label != b.label for a, b in zip(true.hulls, desk.meshes[name].hulls, strict=True))
    meshes = {**desk.meshes, name: true.with_labels({hull.name: Label(hull.label or "") for hull in true.hulls})}
    looked_through = Desk(desk.bench, meshes)
    found = desk.bench.relatives.propagate(_labels_of(looked_through))
    rows = enumerate(looked_through.meshes.items())
    return Desk(desk.bench, {name: _with(mesh, found.labels(place)) for place, (name, mesh) in rows}), wrong


def _labels_of(desk: Desk) -> list[str | None]:
    return [reference_label(hull.annotation) for mesh in desk.meshes.values() for hull in mesh.hulls]


def _with(mesh: SymbolicMesh, found: list[Label | None]) -> SymbolicMesh:
    """The mesh with labels that were found, where nobody gave one."""
    rows = zip(mesh.hulls, found, strict=True)
    return mesh.with_labels({hull.name: label for hull, label in rows if reference_label(hull.annotation) is None})
