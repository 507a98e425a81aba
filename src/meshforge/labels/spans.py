"""Which hulls of a project span parts, by the surface that they stand for, or by look-alikes where there is none, and
the labels that are known."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from meshforge import batch
from meshforge.common import MeshForgeError, ProjectError, describe_error
from meshforge.formats import read
from meshforge.geometry import FINE, Floats, HullPart, Polytope, cache_folder, decompose_finely
from meshforge.label_model import CellModel, SpanModel, SpanPosterior, evidence_of, piece_mesh
from meshforge.labels.descriptor_cache import read_arrays, write_arrays
from meshforge.labels.family_comparison import Stage
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

    by_surface, by_cells: what is known of hulls that stand for a surface, and of others; None where no hull is such;
    unseen: the bodies, by asset, that have no surface.
    """

    meshes: Mapping[str, SymbolicMesh]
    by_surface: SpanPosterior | None
    by_cells: SpanPosterior | None
    unseen: Mapping[str, frozenset[str]]
    lost: Mapping[str, str]

    @cached_property
    def bare(self) -> Mapping[str, tuple[str, ...]]:
        """Hulls, by asset, that stand for nothing of their body's surface, and of which nothing can be said."""
        found = dict[str, tuple[str, ...]]()
        for place, (asset, mesh) in enumerate(self.meshes.items()):
            held = self.by_surface.assets[place].common.sum(axis=1) if self.by_surface else np.zeros(len(mesh.hulls))
            rows = zip(mesh.hulls, held.tolist(), strict=True)
            names = tuple(hull.name for hull, own in rows if not own > 0 and hull.body not in self.unseen[asset])
            if names:
                found[asset] = names
        return found

    @cached_property
    def _places(self) -> dict[str, int]:
        return {asset: place for place, asset in enumerate(self.meshes)}

    def spans_of(self, asset: str) -> list[HullSpan]:
        """Each hull of an asset that stands for something, in order."""
        found = dict[str, HullSpan]()
        for posterior, unseen in ((self.by_surface, False), (self.by_cells, True)):
            if posterior:
                found.update((span.hull, span) for span in self._list_spans(asset, posterior, unseen))
        return [found[hull.name] for hull in self.meshes[asset].hulls if hull.name in found]

    def divide(self, asset: str, hull: str) -> list[tuple[HullPart, str, float]]:
        """The parts of a hull, each with its likeliest label and the share of that in what it stands for."""
        place = self.meshes[asset].index[hull]
        posterior = self.by_cells if self.meshes[asset].hulls[place].body in self.unseen[asset] else self.by_surface
        assert posterior, f"{hull} of {asset} stands for nothing"
        parts = posterior.divide(self._places[asset], place)
        return [(part, posterior.labels[part.kind], float(part.shares[part.kind])) for part in parts]

    def _list_spans(self, asset: str, posterior: SpanPosterior, unseen: bool) -> Iterator[HullSpan]:
        """Those of hulls whose body has a surface, or has none."""
        place, mesh = self._places[asset], self.meshes[asset]
        bare = set(self.bare.get(asset, ()))
        rows = zip(mesh.hulls, posterior.chances_of(place).tolist(), posterior.shares_of(place), strict=True)
        for hull, chance, shares in rows:
            if hull.name not in bare and (hull.body in self.unseen[asset]) == unseen:
                yield HullSpan(asset, hull.name, chance, _name_shares(posterior.labels, shares))


def _name_shares(labels: Sequence[str], shares: Floats) -> dict[str, float]:
    rows = sorted(zip(labels, shares.tolist(), strict=True), key=lambda row: (-row[1], row[0]))
    return {label: share for label, share in rows if share > 0}


@dataclass(frozen=True, slots=True)
class _Work:
    """One asset whose surface is decomposed finely; kept: the file where the pieces are kept."""

    path: Path
    kept: Path


def find_spans(store: Store, execution: batch.ExecutionOptions, stage: Stage) -> SpanReport:
    """Which hulls span parts, of all assets that can be read.

    Raises ProjectError where no hull has a label: nothing says what parts there are; and where no asset can be read.
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
    unseen = dict[str, frozenset[str]]()
    with stage(len(work), "decomposing finely") as advance:
        options = batch.ExecutionOptions(execution.workers, execution.timeout, progress=advance, stop=execution.stop)
        for asset, found in zip(meshes, batch.run_isolated(_find_pieces, work, options), strict=True):
            if isinstance(found, batch.WorkerFailure | str):
                lost[asset] = found if isinstance(found, str) else found.why
            else:
                pieces[asset] = piece_mesh(found, meshes[asset])
                unseen[asset] = frozenset(hull.body for hull in meshes[asset].hulls) - found.keys()
    known = {asset: meshes[asset] for asset in pieces}
    said = [label for asset in known for label in labels[asset]]
    if not known:
        remedy = next(iter(lost.values()), "Give the project assets that can be read: meshforge add.")
        raise ProjectError("no asset can be read", where=str(store.folder), remedy=remedy)
    some = list(known.values())
    by_surface = by_cells = None
    if any(own.hulls for own in pieces.values()):
        by_surface = SpanModel(some, list(pieces.values())).infer(said)
    if any(hull.body in unseen[asset] for asset, mesh in known.items() for hull in mesh.hulls):
        with stage(1, "comparing hulls that stand for no surface") as advance:
            by_cells = CellModel(some).infer(said)
            advance()
    return SpanReport(known, by_surface, by_cells, unseen, lost)


def _find_pieces(work: _Work) -> dict[str, list[Polytope]] | str:
    """The fine pieces of an asset by body, kept where they were found already; or why there are none."""
    try:
        surfaces = batch.find_surfaces(read(work.path))
        key = _digest(surfaces)
        known = read_arrays(work.kept, key, "bodies", "sizes", "vertices", "faces")
        if known is not None:
            return {body: [] for body in surfaces} | _unpack(*known)
        found = dict[str, list[Polytope]]()
        for body, surface in surfaces.items():
            try:
                found[body] = list(decompose_finely(surface.vertices, surface.faces, cache=cache_folder()))
            except MeshForgeError:  # flat, or without an area: its hulls stand for nothing
                found[body] = []
        write_arrays(work.kept, key, _pack(found))
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


def _pack(pieces: Mapping[str, Sequence[Polytope]]) -> dict[str, np.ndarray[tuple[int, ...], np.dtype[np.generic]]]:
    rows = [(body, piece) for body, own in pieces.items() for piece in own]
    return {
        "bodies": np.array([body for body, _ in rows], dtype=np.str_),
        "sizes": np.array([(len(p.vertices), len(p.faces)) for _, p in rows], dtype=np.int64).reshape(-1, 2),
        "vertices": np.concatenate([np.zeros((0, 3)), *(piece.vertices for _, piece in rows)]),
        "faces": np.concatenate([np.zeros((0, 3), np.int64), *(piece.faces for _, piece in rows)]),
    }


def _unpack(
    bodies: Iterable[str], sizes: Floats, vertices: Floats, faces: np.ndarray[tuple[int, ...], np.dtype[np.int64]]
) -> dict[str, list[Polytope]]:
    found = dict[str, list[Polytope]]()
    points = triangles = 0
    for body, (count, sides) in zip(bodies, np.asarray(sizes, dtype=np.int64).tolist(), strict=True):
        piece = Polytope(vertices[points : points + count], faces[triangles : triangles + sides])
        found.setdefault(str(body), []).append(piece)
        points, triangles = points + count, triangles + sides
    return found
