"""Labels that the product propagates from meshes which a person labelled."""

from __future__ import annotations

from dataclasses import dataclass

from benchmark.study.client import TaskClient
from benchmark.study.desk import Bench


@dataclass(frozen=True, slots=True)
class HandLabels:
    """What a person did to label a mesh: labels looked at, hulls given another, and different labels among these."""

    inspected: int = 0
    typed: int = 0
    strokes: int = 0

    def __add__(self, other: HandLabels) -> HandLabels:
        return HandLabels(self.inspected + other.inspected, self.typed + other.typed, self.strokes + other.strokes)


def begin_by_hand(client: TaskClient, bench: Bench, count: int) -> tuple[frozenset[str], HandLabels]:
    """Label as many meshes by hand as `count`, each the one that is advised, or that the bench names.

    Their names, and what a person did for that.
    """
    done, painted, known = list[str](), HandLabels(), bench.start.by_hand
    advised = client.propagate_labels() if count and not known else None
    for place in range(count):
        name = known[place] if known else advised
        assert name, "all meshes are labelled"
        more, advised = label_by_hand(client, bench, name)
        done.append(name)
        painted += more
    return frozenset(done), painted


def label_by_hand(client: TaskClient, bench: Bench, name: str) -> tuple[HandLabels, str | None]:
    """Look through the labels of a mesh, and let the product propagate what is said; what a person said before stays.

    What the person did, and the mesh to label next.
    """
    pairs = list(zip(bench.truth.meshes[name].hulls, client.project.mesh(name).hulls, strict=True))
    wrong = [true.label for true, hull in pairs if hull.label != true.label]
    client.set_labels(name, {true.name: str(true.label) for true, _ in pairs})
    done = HandLabels(sum(hull.label is not None for _, hull in pairs), len(wrong), len(set(wrong)))
    return done, client.propagate_labels()
