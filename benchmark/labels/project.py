"""A family as a project on disk whose labels are propagated from meshes that a person labels."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from time import perf_counter

from benchmark.study.client import TaskClient
from benchmark.study.project import SUFFIX, create_project, open_folder
from benchmark.tasks import task
from meshforge.project import Project
from meshforge.symbolic import Label, SymbolicMesh


class LabelProject:
    """meshes: with their true labels; in the project they have none at first."""

    def __init__(self, project: Project, meshes: Mapping[str, SymbolicMesh]) -> None:
        self._client, self._meshes = TaskClient(project), meshes
        self._names = list(meshes)
        self._by_hand = frozenset[str]()

    def clear(self) -> None:
        """Take all labels away."""
        self._client.project.set_labels_of({name: dict.fromkeys(mesh.index) for name, mesh in self._meshes.items()})
        self._by_hand = frozenset()

    def label(self, places: Collection[int]) -> None:
        """Label some meshes by hand; those that were labelled before have no label by hand any more."""
        chosen = frozenset(self._names[place] for place in places)
        for name in sorted(self._by_hand - chosen):
            self._client.project.set_labels(name, dict.fromkeys(self._meshes[name].index))
        for name in sorted(chosen - self._by_hand):
            self._client.set_labels(name, {hull: label.name for hull, label in self._meshes[name].labels.items()})
        self._by_hand = chosen

    def propagate(self) -> tuple[int | None, float]:
        """Propagate the labels by hand to all other meshes: the place of the one to label next, and the seconds."""
        started = perf_counter()
        advised = self._client.propagate_labels()
        return None if advised is None else self._names.index(advised), perf_counter() - started

    def label_by_names(self) -> None:
        """Take labels from the names of hulls."""
        self._client.project.label("names")

    def read_labels(self) -> list[list[Label | None]]:
        """The label of each hull, mesh by mesh."""
        found = (self._client.project.labels(name).labels for name in self._names)
        return [
            [own.get(hull) for hull in self._meshes[name].index] for name, own in zip(self._names, found, strict=True)
        ]


@contextmanager
def open_label_project(category: str, names: Sequence[str], meshes: Sequence[SymbolicMesh]) -> Iterator[LabelProject]:
    """A new project of meshes of a category, in a folder that goes away afterwards."""
    found = {f"{name}{SUFFIX}": mesh for name, mesh in zip(names, meshes, strict=True)}
    with open_folder() as folder:
        words = task(f"{category}-easy").program.labels
        yield LabelProject(create_project(folder, category, found, words), found)
