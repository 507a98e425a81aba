"""Which hulls of a project span parts, by the surface that they stand for and the labels that are known."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from meshforge import batch
from meshforge.common import MeshForgeError, ProjectError, describe_error
from meshforge.formats import read
from meshforge.geometry import FINE, Floats, HullPart, Polytope, cache_folder, decompose_finely
from meshforge.label_model import SpanModel, SpanPosterior, evidence_of, piece_mesh
from meshforge.labels.descriptor_cache import read_arrays, write_arrays
from meshforge.labels.family_comparison import Stage
from meshforge.labels.hull_arrays import HULL_ARRAYS, pack_hulls, unpack_hulls
from meshforge.store import Store
from meshforge.symbolic import Surface, SymbolicMesh

_SHOWN = 0.1  # of what a hull stands for: labels of smaller shares are not named


@dataclass(frozen=True, eq=False)
class HullSpan:
    """A hull that may span parts. chance: of that; shares: of each label in what it stands for, the largest first."""

    asset: str
    hull: str
    chance: float
    shares: Mapping[str, float]

    def __str__(self) -> str:
        """`base holds wall and handle, 94%`."""
        names = [label for label, share in self.shares.items() if share >= _SHOWN]
        return f"{self.hull} holds {' and '.join(names)}, {self.chance:.0%}"


@dataclass(frozen=True, eq=False)
class SpanReport:
    """What was found. meshes: the assets that were looked at, as they are prepared; lost: why others were not;
    bare: hulls, by asset, that stand for no surface, and of which nothing can be said.
    """

    meshes: Mapping[str, SymbolicMesh]
    posterior: SpanPosterior
    lost: Mapping[str, str]
    bare: Mapping[str, tuple[str, ...]]

    @cached_property
    def _places(self) -> dict[str, int]:
        return {asset: place for place, asset in enumerate(self.meshes)}

    def spans_of(self, asset: str) -> list[HullSpan]:
        """Each hull of an asset that stands for something, in order."""
        place, mesh = self._places[asset], self.meshes[asset]
        rows = zip(mesh.hulls, self.posterior.chances_of(place), self.posterior.shares_of(place), strict=True)
        bare = set(self.bare.get(asset, ()))
        return [
            HullSpan(asset, hull.name, float(chance), self._name_shares(shares))
            for hull, chance, shares in rows
            if hull.name not in bare
        ]

    def divide(self, asset: str, hull: str) -> list[tuple[HullPart, str, float]]:
        """The parts of a hull, each with its likeliest label and the share of that in what it stands for."""
        parts = self.posterior.divide(self._places[asset], self.meshes[asset].index[hull])
        labels = self.posterior.labels
        return [(part, labels[part.kind], float(part.shares[part.kind])) for part in parts]

    def _name_shares(self, shares: Floats) -> dict[str, float]:
        rows = sorted(zip(self.posterior.labels, shares.tolist(), strict=True), key=lambda row: (-row[1], row[0]))
        return {label: share for label, share in rows if share > 0}


@dataclass(frozen=True, slots=True)
class _Work:
    """One asset whose surface is decomposed finely; kept: the file where the pieces are kept."""

    path: Path
    kept: Path


def find_spans(store: Store, execution: batch.ExecutionOptions, stage: Stage) -> SpanReport:
    """Which hulls span parts, of all assets that can be read.

    Raises ProjectError where no hull has a label: nothing says what parts there are.
    """
    meshes = dict(store.meshes_by_id())
    labels = {asset: [evidence_of(hull.annotation) for hull in mesh.hulls] for asset, mesh in meshes.items()}
    if not any(label for own in labels.values() for label in own):
        remedy = "Label the hulls of one or two assets first: meshforge label, or the studio."
        raise ProjectError(
            "no hull has a label, so nothing says what parts there are", where=str(store.folder), remedy=remedy
        )
    work = [_Work(store.path(asset), store.layout.sketches / "fine" / f"{asset}.npz") for asset in meshes]
    pieces, lost = dict[str, SymbolicMesh](), dict[str, str]()
    with stage(len(work), "decomposing finely") as advance:
        options = batch.ExecutionOptions(execution.workers, execution.timeout, progress=advance, stop=execution.stop)
        for asset, found in zip(meshes, batch.run_isolated(_find_pieces, work, options), strict=True):
            if isinstance(found, batch.WorkerFailure | str):
                lost[asset] = found if isinstance(found, str) else found.why
            else:
                pieces[asset] = piece_mesh(found, meshes[asset])
    known = {asset: meshes[asset] for asset in pieces}
    if not any(own.hulls for own in pieces.values()):
        remedy = next(iter(lost.values()), "Give the assets visual meshes, or split hulls with: meshforge split")
        raise ProjectError("no asset has a surface that its hulls stand for", where=str(store.folder), remedy=remedy)
    posterior = SpanModel(list(known.values()), list(pieces.values())).infer(
        [label for asset in known for label in labels[asset]]
    )
    bare = dict[str, tuple[str, ...]]()
    for own, (asset, mesh) in zip(posterior.assets, known.items(), strict=True):
        if names := _list_bare(mesh, own.common):
            bare[asset] = names
    return SpanReport(known, posterior, lost, bare)


def _list_bare(mesh: SymbolicMesh, common: Floats) -> tuple[str, ...]:
    """The hulls of which no piece is a part."""
    return tuple(hull.name for hull, held in zip(mesh.hulls, common.sum(axis=1), strict=True) if not held > 0)


def _find_pieces(work: _Work) -> dict[str, list[Polytope]] | str:
    """The fine pieces of an asset by body, kept where they were found already; or why there are none."""
    try:
        surfaces = batch.find_surfaces(read(work.path))
        key = _digest(surfaces)
        known = read_arrays(work.kept, key, *HULL_ARRAYS)
        if known is not None:
            return unpack_hulls(*known)
        found = dict[str, list[Polytope]]()
        for body, surface in surfaces.items():
            try:
                found[body] = list(decompose_finely(surface.vertices, surface.faces, cache=cache_folder()))
            except MeshForgeError:  # flat, or without an area: nothing stands for it
                continue
        write_arrays(work.kept, key, pack_hulls(found))
        return found
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(work.path))


def _digest(surfaces: Mapping[str, Surface]) -> str:
    """A digest of all that fine pieces are made from."""
    state = hashlib.blake2b(json.dumps([FINE.as_dict(), batch.software_version()]).encode(), digest_size=16)
    for body, surface in surfaces.items():
        state.update(body.encode())
        state.update(np.ascontiguousarray(surface.vertices).tobytes())
        state.update(np.ascontiguousarray(surface.faces).tobytes())
    return state.hexdigest()
