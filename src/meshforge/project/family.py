"""The assets that a program is learned from: which of very many, in memory, and which to demonstrate first."""

from __future__ import annotations

from collections.abc import Sequence

from meshforge.common import MeshForgeError
from meshforge.project.review import find_accepted_results, pick_evenly
from meshforge.store import Store
from meshforge.symbolic import SymbolicMesh, transfer_labels
from meshforge.synthesis import choose_first_demonstration

MOST_ASSETS = 400
"""Of more assets so many are looked at while a program is learned, besides those of which something was said: they are
all read and edited again after each answer. A variant that one asset in a hundred has is then missed once in fifty
times."""

MOST_COMPARED = 100
"""Of more assets so many are looked at, evenly over all: each has to be read."""


class FamilyMeshes:
    """Reads every asset once; labels are looked at anew each time, as answers change them."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._kept: dict[str, tuple[bytes, SymbolicMesh]] = {}

    def meshes(self) -> dict[str, SymbolicMesh]:
        """The assets to learn from that can be read, by id, with the labels they have now."""
        if not self._kept:
            rows = self._store.meshes_by_id(select_assets(self._store))
            self._kept = {asset: (self._labels(asset), mesh) for asset, mesh in rows}
        for asset, (before, mesh) in self._kept.items():
            now = self._labels(asset)
            if now != before:
                bare = mesh.with_labels(dict.fromkeys(mesh.index))
                self._kept[asset] = now, transfer_labels(self._store.labels(asset), bare).mesh
        return {asset: mesh for asset, (_, mesh) in self._kept.items()}

    def _labels(self, asset: str) -> bytes:
        path = self._store.layout.labels(asset)
        return path.read_bytes() if path.exists() else b""


def select_assets(store: Store) -> tuple[str, ...]:
    """The assets to learn from: all, or of very many those that a person said something about, and some evenly."""
    every = store.assets()
    if len(every) <= MOST_ASSETS:
        return every
    known = {line.asset for line in store.answers().answers}
    known.update(find_accepted_results(store))
    known.update(store.demonstration_ids())
    known.update(pick_evenly(every, MOST_ASSETS))
    return tuple(asset for asset in every if asset in known)


def suggest_first_demonstration(store: Store, assets: Sequence[str]) -> str | None:
    """The id of the asset that tells most when it is demonstrated, None where there is nothing to choose by.

    assets: ids of those that come into question.
    """
    if len(assets) < 2:
        return next(iter(assets), None)
    meshes: dict[str, SymbolicMesh] = {}
    for asset in pick_evenly(assets, MOST_COMPARED):
        try:
            meshes[asset] = store.mesh(asset)
        except MeshForgeError:  # the status names it, with the reason
            continue
    settings = store.settings
    limits = settings.thresholds
    return choose_first_demonstration(meshes, settings.vocabulary, store.orientation, limits.contact, limits.extremity)
