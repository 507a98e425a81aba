"""Labels that the product propagates from meshes which a person labelled."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from benchmark.study.client import TaskClient
from benchmark.study.desk import Bench
from benchmark.study.keystrokes import CLICK, GROUP_HULL, STROKE, THINK, price_selection


@dataclass(frozen=True, slots=True)
class HandLabels:
    """What a person did to label a mesh: labels looked at, hulls given another, and different labels among these;
    by_keys: seconds of that with look-alikes."""

    inspected: int = 0
    typed: int = 0
    strokes: int = 0
    by_keys: float = 0.0

    @staticmethod
    def of(bench: Bench, name: str, looked_at: Sequence[str | None], given: Iterable[tuple[str, str]]) -> HandLabels:
        """What is done on a mesh. looked_at: labels of hulls that were looked at; given: hulls, and new labels."""
        hulls = defaultdict[str, list[str]](list)
        for hull, label in given:
            hulls[label].append(hull)
        seconds = GROUP_HULL * len(looked_at) + (THINK + CLICK) * len(set(looked_at))
        seconds += sum(STROKE + price_selection(some, bench.find_alike(name)) for some in hulls.values())
        return HandLabels(len(looked_at), sum(map(len, hulls.values())), len(hulls), seconds)

    def __add__(self, other: HandLabels) -> HandLabels:
        return HandLabels(
            self.inspected + other.inspected,
            self.typed + other.typed,
            self.strokes + other.strokes,
            self.by_keys + other.by_keys,
        )


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
    seen = [hull.label for _, hull in pairs if hull.label is not None]
    wrong = [(true.name, str(true.label)) for true, hull in pairs if hull.label != true.label]
    client.set_labels(name, {true.name: str(true.label) for true, _ in pairs})
    return HandLabels.of(bench, name, seen, wrong), client.propagate_labels()
