"""Labels that the built-in propagation carries over from meshes which a person labelled."""

from __future__ import annotations

from dataclasses import dataclass

from benchmark.study.desk import Bench, Desk
from meshforge.label_model import reference_label
from meshforge.symbolic import Label, SymbolicMesh


@dataclass(frozen=True, slots=True)
class HandLabels:
    """What a person did to label a mesh: labels looked at, hulls given another, and different labels among these."""

    inspected: int = 0
    typed: int = 0
    strokes: int = 0

    def __add__(self, other: HandLabels) -> HandLabels:
        return HandLabels(self.inspected + other.inspected, self.typed + other.typed, self.strokes + other.strokes)


def begin_by_hand(bench: Bench, count: int) -> tuple[Desk, frozenset[str], HandLabels]:
    """All meshes once as many are labelled by hand as `count`, each the one that is advised, or that the bench
    names; the others have no more than parts of split hulls have yet where it is 0.

    With the names of those, and what a person did for that.
    """
    start = bench.start
    desk = Desk(
        bench,
        {
            name: mesh.with_labels({**dict.fromkeys(mesh.index), **start.parts.get(name, {})})
            for name, mesh in bench.truth.meshes.items()
        },
    )
    names, done, painted = list(desk.meshes), list[str](), HandLabels()
    for place in range(count):
        if start.by_hand:
            name = start.by_hand[place]
        else:
            (advised,) = bench.relatives.infer(_labels_of(desk)).next_to_label()
            name = names[advised]
        done.append(name)
        desk, more = label_by_hand(desk, name)
        painted += more
    return desk, frozenset(done), painted


def label_by_hand(desk: Desk, name: str) -> tuple[Desk, HandLabels]:
    """The meshes when a person has looked through the labels of one, and they were carried over again.

    What a person said before stays.
    """
    true = desk.bench.truth.meshes[name]
    pairs = list(zip(true.hulls, desk.meshes[name].hulls, strict=True))
    wrong = [right.label for right, hull in pairs if hull.label != right.label]
    meshes = {**desk.meshes, name: true.with_labels({hull.name: Label(hull.label or "") for hull in true.hulls})}
    labelled = carry_over(Desk(desk.bench, meshes))
    return labelled, HandLabels(sum(hull.label is not None for _, hull in pairs), len(wrong), len(set(wrong)))


def carry_over(desk: Desk) -> Desk:
    """The meshes when what a person said of some hulls was carried over to the others."""
    found, rows = desk.bench.relatives.infer(_labels_of(desk)), enumerate(desk.meshes.items())
    return Desk(desk.bench, {name: _with(mesh, found.labels(place)) for place, (name, mesh) in rows})


def _labels_of(desk: Desk) -> list[Label | None]:
    """The labels that people and files gave, as a person gives them."""
    names = (reference_label(hull.annotation) for mesh in desk.meshes.values() for hull in mesh.hulls)
    return [None if name is None else Label(name) for name in names]


def _with(mesh: SymbolicMesh, found: list[Label | None]) -> SymbolicMesh:
    """The mesh with labels that were found, where nobody gave one, and no split did."""
    rows = zip(mesh.hulls, found, strict=True)
    return mesh.with_labels({hull.name: label for hull, label in rows if not _is_kept(hull.annotation)})


def _is_kept(label: Label | None) -> bool:
    return reference_label(label) is not None or (label is not None and label.source == "split")
