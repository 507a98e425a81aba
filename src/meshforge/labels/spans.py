"""Which hulls of an asset span parts, by the surface that they stand for and the labels that are known."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

import numpy as np

from meshforge import batch
from meshforge.common import MeshForgeError, describe_error, format_share, join_and, join_names
from meshforge.formats import VisualSurfaces, read
from meshforge.geometry import FinePiece, Floats, PieceEngine, cache_folder, decompose_finely
from meshforge.label_model import RebuiltHull, SpanPosterior, SurfacePieces, piece_mesh
from meshforge.labels.labeler import Stage
from meshforge.store import Store
from meshforge.symbolic import GIVEN_SOURCES, Asset, Hull, SymbolicMesh

_ALIKE = 20.0  # a surface larger or smaller than its hulls by this factor is in another unit
_TINY = 1e-300
_SHOWN = 0.1  # of what a hull stands for: labels of smaller shares are not named


@dataclass(frozen=True, eq=False, slots=True)
class HullSpan:
    """A hull that may span parts. chance: of that; shares: of each label in what it stands for, the largest first."""

    hull: str
    body: str
    chance: float
    shares: Mapping[str, float]

    def __str__(self) -> str:
        """`base holds wall and handle, 94%`."""
        return f"{self.hull} holds {join_and(self.labels)}, {format_share(self.chance)}"

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels of at least a tenth of what it stands for, at least two, that of the largest share first."""
        count = sum(share >= _SHOWN for share in self.shares.values())
        return tuple(self.shares)[: max(count, 2)]


@dataclass(frozen=True, eq=False)
class SpanReport:
    """What is known of the hulls of an asset. mesh: as it is prepared, with its labels; posterior: of the family, of
    which it is the first asset, None where nobody has a surface; pieces: of its own surfaces."""

    mesh: SymbolicMesh
    posterior: SpanPosterior | None
    pieces: "FinePieces"

    @cached_property
    def spans(self) -> tuple[HullSpan, ...]:
        """Each hull that stands for some of the surface of its body, in order, but for those that a person or a file
        gave a label: they are of one part."""
        if self.posterior is None:
            return ()
        rows = zip(self.mesh.hulls, self.posterior.chances_of(0).tolist(), self.posterior.shares_of(0), strict=True)
        labels = self.posterior.labels
        return tuple(
            HullSpan(hull.name, hull.body, chance, _name_shares(labels, shares))
            for hull, chance, shares in rows
            if not is_given(hull) and hull.name not in self._bare
        )

    @property
    def notes(self) -> Iterator[str]:
        """On what could not be judged, as far as no person or file says what it is."""
        unknown = [hull for hull in self.mesh.hulls if not is_given(hull)]
        if not unknown:
            return
        yield from self.pieces.notes
        bodies = dict.fromkeys(hull.body for hull in unknown if hull.body in self.pieces.unseen)
        if bodies:
            names = join_names(list(bodies))
            yield f"no surface says which hulls of {names} span parts; cut them by hand: meshforge cut"
        for hull in unknown:
            if hull.name in self._bare and hull.body not in bodies:
                yield f"{hull.name} stands for no surface: left as it is"

    def rebuild(self, body: str) -> dict[str, list[RebuiltHull]]:
        """Return new hulls for all of a body that stand for its surface, each of one label, by the old hull that has
        most of it; nothing where there is none."""
        own = [k for k, hull in enumerate(self.mesh.hulls) if hull.body == body and hull.name not in self._bare]
        if self.posterior is None:
            return {}
        found: dict[str, list[RebuiltHull]] = {self.mesh.hulls[k].name: [] for k in own}
        for one in self.posterior.rebuild(0, np.array(own, dtype=np.int64)):
            found[self.mesh.hulls[one.old].name].append(one)
        return found if any(found.values()) else {}

    @cached_property
    def _bare(self) -> frozenset[str]:
        """The hulls that stand for nothing of the surface of their body, of which nothing can be known."""
        hulls = self.mesh.hulls
        covered = self.posterior.assets[0].common.sum(axis=1) if self.posterior else np.zeros(len(hulls))
        return frozenset(hull.name for hull, own in zip(hulls, covered.tolist(), strict=True) if not own > 0)


def is_given(hull: Hull) -> bool:
    """Return whether a person or a file says what a hull is, so that it is of one part."""
    return hull.source in GIVEN_SOURCES


def _name_shares(labels: Sequence[str], shares: Floats) -> dict[str, float]:
    rows = sorted(zip(labels, shares.tolist(), strict=True), key=lambda row: (-row[1], row[0]))
    return {label: share for label, share in rows if share > 0}


@dataclass(frozen=True, eq=False, slots=True)
class FinePieces:
    """The fine pieces of the surfaces of an asset, as a mesh that lies as its own does; unseen: the bodies with hulls
    that have no surface; notes: on surfaces that could not be used."""

    mesh: SymbolicMesh
    unseen: frozenset[str] = frozenset()
    notes: tuple[str, ...] = ()

    @staticmethod
    def of(found: SurfacePieces, mesh: SymbolicMesh, notes: Iterable[str] = ()) -> "FinePieces":
        """Return those found by body, of all bodies that have a surface; one of quite another size than its hulls says
        nothing of them, and does not count."""
        remarks, kept = list(notes), dict(found)
        for body, pieces in found.items():
            hulls = [hull.vertices for hull in mesh.hulls if hull.body == body]
            if not hulls or not pieces:
                continue
            ratio = _diagonal([piece.shape.vertices for piece in pieces]) / max(_diagonal(hulls), _TINY)
            if not 1 / _ALIKE < ratio < _ALIKE:
                remarks.append(
                    f"{body}: its surface is {ratio:.3g} times the size of its hulls (another unit?): it does not count"
                )
                del kept[body]
        return FinePieces(
            piece_mesh(kept, mesh), frozenset(hull.body for hull in mesh.hulls) - kept.keys(), (*remarks,)
        )


def _diagonal(points: Sequence[Floats]) -> float:
    return float(np.linalg.norm(np.ptp(np.concatenate(points), axis=0)))


def find_pieces(
    store: Store,
    meshes: Mapping[str, SymbolicMesh],
    execution: batch.ExecutionOptions,
    stage: Stage,
    engine: PieceEngine = "coacd",
) -> tuple[dict[str, FinePieces], dict[str, str]]:
    """Return the fine pieces of the surfaces of assets, by id, and why those of others are not known."""
    work = [store.path(asset) for asset in meshes]
    pieces, lost = dict[str, FinePieces](), dict[str, str]()
    with stage(len(work), "decomposing finely") as advance:
        options = batch.ExecutionOptions(execution.workers, execution.timeout, progress=advance, stop=execution.stop)
        for asset, found in zip(meshes, batch.run_isolated(partial(_find_pieces, engine), work, options), strict=True):
            if isinstance(found, batch.WorkerFailure | str):
                lost[asset] = found if isinstance(found, str) else found.why
            else:
                pieces[asset] = FinePieces.of(found[0], meshes[asset], found[1])
    return pieces, lost


def _find_pieces(engine: PieceEngine, path: Path) -> tuple[SurfacePieces, list[str]] | str:
    """The fine pieces of an asset by body, with notes, or why there are none."""
    try:
        return decompose_surfaces(read(path), engine)
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(path))


def decompose_surfaces(source: Asset, engine: PieceEngine = "coacd") -> tuple[SurfacePieces, list[str]]:
    """Return the fine pieces of the surfaces of an asset by body; and notes on what it shows that cannot be read."""
    found = dict[str, Sequence[FinePiece]]()
    for body, surface in batch.find_surfaces(source).items():
        try:
            found[body] = decompose_finely(surface.vertices, surface.faces, engine, cache=cache_folder())
        except MeshForgeError:  # flat, or without an area: its hulls stand for nothing
            found[body] = []
    absent = source.visuals.explain_absent() if isinstance(source.visuals, VisualSurfaces) else []
    notes = [f"what {body} shows there does not count: {why}" for body, why in absent]
    notes += [f"what {name} shows does not count: there is no such file" for name in source.missing]
    return found, notes
