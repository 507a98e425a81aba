"""Descriptions of the assets of a project: made in worker processes, and kept on disk until an asset changes.

Measured on 42 tables of 42 hulls: 6.4 s of processor time with, 0.4 s without having to describe them.
"""

import zipfile
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshforge import batch
from meshforge.common import AssetError, describe_error, replace_atomically
from meshforge.geometry import Floats, Ints
from meshforge.label_model import MeshDescriber, ShapeDescriptor, remember_descriptor
from meshforge.store import AssetFacts, Store, iterate_asset_index
from meshforge.symbolic import EPSILON, SymbolicMesh

_KEY = "made_from"

_FEW = 10  # meshes that are described sooner than worker processes have started

_REMEDY = "Propagate the labels again."


@dataclass(frozen=True, slots=True)
class _Work:
    """An asset to be described. files, prepared: digests of its files, by path from `base`, and of its preparation, of
    which `key` was made; folder, id: where its sketches are kept, and its path there; sides: to be looked at closely.
    """

    path: Path
    base: Path
    files: Mapping[str, str]
    preparation: Path
    prepared: str | None
    contact: float
    key: str
    folder: Path
    id: str
    sides: tuple[int, ...] = ()

    def keep(self, what: str, **arrays: NDArray[Any]) -> None:
        """Keep what was made; not synced to disk, for it can be made again."""
        kept: dict[str, Any] = {_KEY: np.array(self.key), **arrays}
        with replace_atomically(self._place(what)) as draft, draft.open("wb") as file:
            np.savez(file, **kept)

    def recall(self, what: str, *names: str) -> list[NDArray[Any]] | None:
        """Return the arrays of some names; None where there are none, of something else, or damaged."""
        try:
            with np.load(BytesIO(self._place(what).read_bytes()), allow_pickle=False) as kept:
                return [kept[name] for name in names] if str(kept[_KEY]) == self.key else None
        except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, zlib.error):
            return None

    def _place(self, what: str) -> Path:
        return self.folder / what / f"{self.id}.npz"


class DescriptorCache:
    """The descriptions of some assets of a project, as far as they are known."""

    def __init__(self, store: Store, facts: Mapping[str, AssetFacts], execution: batch.ExecutionOptions) -> None:
        contact = store.settings.thresholds.contact or EPSILON
        layout, software = store.layout, batch.software_version()
        self._execution = execution
        self._work = {
            asset: _Work(
                store.path(asset),
                store.found.base_of(store.path(asset)),
                own.digests,
                layout.preparation(asset),
                own.preparation,
                contact,
                batch.value_digest([software, contact, own.preparation, own.digests]),
                layout.sketches,
                asset,
            )
            for asset, own in facts.items()
        }

    def describe(self, assets: Sequence[str], done: Callable[[], None]) -> Iterator[tuple[str, str]]:
        """Describe some assets; yield those that cannot be described, with why. done: called for each."""
        work = [self._work[asset] for asset in assets]
        for asset, result in zip(
            assets, batch.execute(_describe, work, replace(self._execution, progress=done)), strict=True
        ):
            if isinstance(result, batch.WorkerFailure):
                yield asset, f"{self._work[asset].path}: {result.why}"
            elif result:
                yield asset, result

    def read_rows(self, asset: str) -> tuple[Floats, Ints] | None:
        """Return the `rows` and `touching` of the asset's `ShapeDescriptor`; None where it is not described yet."""
        found = self._work[asset].recall("seen", "rows", "touching")
        return (found[0], found[1]) if found else None

    def read_sides(self, asset: str) -> Floats:
        """Return the `sides` of the `ShapeDescriptor` of an asset that was described."""
        if found := self._work[asset].recall("seen", "sides"):
            return found[0]
        raise AssetError("how it is described is gone", where=str(self._work[asset].path), remedy=_REMEDY)

    def describe_sides(
        self, wanted: Sequence[tuple[str, tuple[int, ...]]], done: Callable[[], None]
    ) -> Iterator[tuple[str, list[Floats] | str]]:
        """Yield the rows of assets on some of their other sides, or why there are none; done: called for each asset."""
        work = [replace(self._work[asset], sides=sides) for asset, sides in wanted]
        for (asset, _), result in zip(
            wanted, batch.execute(_describe_sides, work, replace(self._execution, progress=done)), strict=True
        ):
            if isinstance(result, batch.WorkerFailure):
                result = f"{self._work[asset].path}: {result.why}"
            yield asset, result


def recall_descriptors(store: Store, meshes: Mapping[str, SymbolicMesh], execution: batch.ExecutionOptions) -> None:
    """Have `describe_mesh` know the meshes of some assets, by id, so that only those that changed are described."""
    facts = dict(iterate_asset_index(store.found, store.layout, meshes, execution=execution))
    few = len(meshes) <= _FEW
    known = {asset: own for asset, own in facts.items() if not own.error}
    cache = DescriptorCache(store, known, batch.IN_PROCESS if few else execution)
    missing = [asset for asset in known if cache.read_rows(asset) is None]
    lost = dict(cache.describe(missing, lambda: None))
    for asset in known:
        if asset not in lost and (kept := cache.read_rows(asset)):
            remember_descriptor(meshes[asset], ShapeDescriptor(*kept, cache.read_sides(asset)))


def _describe(work: _Work) -> str | None:
    """Describe an asset and keep that; why that cannot be done."""
    try:
        descriptor = MeshDescriber(_read_mesh(work)).describe()
        work.keep("seen", rows=descriptor.rows, touching=descriptor.touching, sides=descriptor.sides)
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(work.path))
    return None


def _describe_sides(work: _Work) -> list[Floats] | str:
    """The rows of an asset on some of its sides, which are kept, too; or why there are none."""
    try:
        known = {side: work.recall(f"side{side}", "rows") for side in work.sides}
        describer = None if all(known.values()) else MeshDescriber(_read_mesh(work))
        found = list[Floats]()
        for side, kept in known.items():
            if kept is None:
                assert describer
                kept = [describer.describe_side(side)]
                work.keep(f"side{side}", rows=kept[0])
            found += kept
        return found
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(work.path))


def _read_mesh(work: _Work) -> SymbolicMesh:
    """The mesh of an asset. Raises AssetError where its files changed since the survey."""
    mesh = SymbolicMesh.of(batch.read_prepared(work.path, work.preparation))
    if batch.record_digest(work.preparation) != work.prepared or not batch.has_same_files(
        work.files, work.path, work.base
    ):
        raise AssetError("it was changed meanwhile", where=str(work.path), remedy=_REMEDY)
    return replace(mesh, epsilon=work.contact)
