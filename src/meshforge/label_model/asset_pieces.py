"""The hulls of an asset beside the fine pieces of the surface that they stand for."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshforge.geometry import Bools, FinePiece, Floats, Ints, convex_hull, overlap_volume
from meshforge.symbolic import Hull, Label, SymbolicMesh

_MOST = 0.8  # how much a label is believed that a piece takes from the hull that it lies in
_ALL = 0.85  # of a solid, from which a hull has nearly all of it
_SLIVER = 0.02  # of what a hull stands for
WITHIN = 0.5
"""Of a piece's volume that a hull must have, for the piece to lie in it."""
_THICKNESS = 1e-4  # of the asset's size, that a flat region gets

SurfacePieces = Mapping[str, Sequence[FinePiece]]
"""The fine pieces of the surfaces of an asset by body, as `decompose_finely` gives these."""


def piece_mesh(pieces: SurfacePieces, mesh: SymbolicMesh) -> SymbolicMesh:
    """Return the fine pieces of an asset as a mesh; the parent of each is its region, after the solid of that."""
    hulls = (
        Hull(f"{body}/{k}", body, piece.shape, parent=f"{body}/{piece.solid}/{piece.region}")
        for body, own in pieces.items()
        for k, piece in enumerate(own)
    )
    return SymbolicMesh(tuple(hulls), mesh.asset, mesh.epsilon, mesh.scale)


@dataclass(frozen=True, eq=False)
class AssetPieces:
    """The hulls of an asset, and the fine pieces of the surface that they stand for.

    common: (hulls, pieces) [m^3] the volume that each hull has of each piece of its body.
    """

    mesh: SymbolicMesh
    pieces: SymbolicMesh

    @cached_property
    def common(self) -> Floats:
        found = np.zeros((len(self.mesh.hulls), len(self.pieces.hulls)))
        if not found.size:
            return found
        (low, high), (below, above) = self.mesh.corners, self.pieces.corners
        meet = ((low[:, None] <= above[None]) & (high[:, None] >= below[None])).all(axis=2)
        for hull, piece in np.argwhere(meet).tolist():
            one, other = self.mesh.hulls[hull], self.pieces.hulls[piece]
            if one.body == other.body:
                found[hull, piece] = overlap_volume(one.shape, other.shape)
        return found

    @cached_property
    def volumes(self) -> Floats:
        """Of the pieces (pieces,) [m^3]."""
        return np.array([piece.shape.volume for piece in self.pieces.hulls])

    @cached_property
    def region_of(self) -> Ints:
        """The number of the region of each piece (pieces,), in the order in which they come."""
        return _number([str(piece.parent) for piece in self.pieces.hulls])

    @cached_property
    def solid_of(self) -> Ints:
        """The same of the solid that the region is of."""
        return _number([str(piece.parent).rpartition("/")[0] for piece in self.pieces.hulls])

    @cached_property
    def solids_of_regions(self) -> Ints:
        """The solid of each region (regions,)."""
        _, first = np.unique(self.region_of, return_index=True)
        return self.solid_of[first]

    @cached_property
    def regions(self) -> SymbolicMesh:
        """The regions as a mesh: the convex hull of the pieces of each."""
        points = [piece.vertices for piece in self.pieces.hulls]
        thickness = _THICKNESS * self.pieces.diagonal if points else 0.0
        found = list[Hull]()
        for number in range(self.region_of.max(initial=-1) + 1):
            own = np.flatnonzero(self.region_of == number).tolist()
            first = self.pieces.hulls[own[0]]
            shape = convex_hull(np.concatenate([points[place] for place in own]), name=first.name, thicken=thickness)
            found.append(Hull(str(first.parent), first.body, shape))
        return self.pieces.with_hulls(found)

    @cached_property
    def solids_alone(self) -> Bools:
        """Which solids (hulls, solids) each hull alone has nearly all of, where they are no sliver of it."""
        contained = sum_groups(self.solid_of, self.common.T).T
        shares = contained / np.maximum(sum_groups(self.solid_of, self.volumes), 1e-300)
        is_alone = (shares >= _ALL) & (shares.sum(axis=0) - shares < WITHIN)
        found: Bools = is_alone & (contained >= _SLIVER * contained.sum(axis=1, keepdims=True))
        return found

    def collect_labels(self, labels: Sequence[Label | None]) -> list[Label | None]:
        """Return what labels of pieces say about each region: the label of more than half of it, with that share."""
        found = list[Label | None]()
        for number in range(len(self.regions.hulls)):
            own = self.region_of == number
            votes: dict[str, float] = {}
            for place in np.flatnonzero(own).tolist():
                if label := labels[place]:
                    votes[label.name] = votes.get(label.name, 0.0) + label.confidence * float(self.volumes[place])
            best = max(votes, key=lambda name: votes[name], default=None)
            share = votes[best] / float(self.volumes[own].sum()) if best else 0.0
            found.append(Label(best, min(share, 1.0), "file") if best and share > 0.5 else None)
        return found

    def take_labels(self, labels: Sequence[Label | None]) -> list[Label | None]:
        """Return what labels of hulls say about each piece, not quite believed: that of the hull with most of it."""
        best = self.common.argmax(axis=0) if len(labels) else np.zeros(len(self.pieces.hulls), np.int64)
        found = list[Label | None]()
        for piece, hull in zip(self.pieces.hulls, best.tolist(), strict=True):
            label = labels[hull] if labels else None
            contained = label and self.common[hull, len(found)] >= WITHIN * piece.shape.volume
            found.append(Label(label.name, min(label.confidence, _MOST), "file") if label and contained else None)
        return found


def _number(names: Sequence[str]) -> Ints:
    numbers = {name: number for number, name in enumerate(dict.fromkeys(names))}
    return np.array([numbers[name] for name in names], dtype=np.int64)


def sum_groups(groups: Ints, rows: Floats) -> Floats:
    """Return the sum (groups, ...) of rows (n, ...) by the group (n,) of each."""
    found = np.zeros((int(groups.max(initial=-1)) + 1, *rows.shape[1:]))
    np.add.at(found, groups, rows)
    return found
