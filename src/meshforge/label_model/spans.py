"""The probability that a hull holds more than one part: from fine pieces of the surface that hulls stand for, and the
regions and solids that these are of."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice

import numpy as np

from meshforge.geometry import Bools, Floats, Ints, Polytope, merge_pieces
from meshforge.label_model.asset_pieces import WITHIN, AssetPieces, sum_groups
from meshforge.label_model.posterior import FamilyPosterior, model_family
from meshforge.label_model.table import read_weights
from meshforge.label_model.ties import EQUAL
from meshforge.symbolic import Label

WEIGHTS_FILE = "spans.json"
WHOLE = 0.9
"""A hull of which one label has this share, by volume of what it stands for, is of one part."""
_LEAST_DRAWN = 0.002  # how often a hull spans parts is at least this, for its logarithm
_WHOLE_SOLIDS = 0.5, 1.5  # solids of one part, and all, that are taken to be seen before any is
_DRAWS = 512  # of the labels of all pieces
_SLIVER = 3e-3  # of the volume of all pieces of a rebuild: smaller ones go with a neighbour where that adds little
_LEAST_CHANCE = 1e-3  # of a label, where chances of pieces and regions are multiplied
_SHARPNESS = 0.6  # exponent of both, since they have much of their evidence in common
_IN_COMMON = 0.5  # exponent of what regions of a solid say against one label of all, for the same reason


@dataclass(frozen=True, eq=False, slots=True)
class RebuiltHull:
    """A new hull of one part. label: its likeliest; share: of that label in what it stands for; old: the place of the
    hull that has most of it."""

    shape: Polytope
    label: str
    share: float
    old: int


class SpanModel:
    """Assets of one kind, each with its hulls and the fine pieces of its surface."""

    def __init__(self, assets: Sequence[AssetPieces]) -> None:
        self.assets = assets
        self._pieces = model_family([asset.pieces for asset in assets])
        self._regions = model_family([asset.regions for asset in assets])

    def infer(
        self, labels: Sequence[Label | None], piece_labels: Sequence[Label | None] | None = None
    ) -> "SpanPosterior":
        """Return what labels say: of the hulls of all meshes in order, None for an unlabelled one; piece_labels: of all
        pieces in order, where they are known."""
        rows = _deal(labels, [len(asset.mesh.hulls) for asset in self.assets])
        observed = [asset.take_labels(own) for asset, own in zip(self.assets, rows, strict=True)]
        if piece_labels is not None:
            known = _deal(piece_labels, list(map(len, observed)))
            observed = [
                [one or other for one, other in zip(*both, strict=True)] for both in zip(known, observed, strict=True)
            ]
        of_pieces = self._pieces.infer([label for own in observed for label in own])
        of_regions = self._regions.infer(
            [label for asset, own in zip(self.assets, observed, strict=True) for label in asset.collect_labels(own)]
        )
        chances = [self._weigh(mesh, of_pieces, of_regions) for mesh in range(len(self.assets))]
        whole = _estimate_whole(self.assets, observed)
        solids = [weigh_solids(*both, whole) for both in zip(self.assets, chances, strict=True)]
        return SpanPosterior(self.assets, of_pieces.seen.labels, chances, read_weights(WEIGHTS_FILE), solids)

    def _weigh(self, mesh: int, of_pieces: FamilyPosterior, of_regions: FamilyPosterior) -> Floats:
        """The probability of each label for the pieces of a mesh (pieces, labels), by what is inferred of them, and of
        the region of each: the less of the asset a region has, the likelier it is of one part."""
        asset, chances = self.assets[mesh], of_pieces.chances_of(mesh)
        if not chances.size or not of_regions.seen.labels:
            return chances
        known = np.zeros((len(asset.regions.hulls), chances.shape[1]))
        known[:, [of_pieces.seen.labels.index(label) for label in of_regions.seen.labels]] = of_regions.chances_of(mesh)
        both = (np.maximum(chances, _LEAST_CHANCE) * np.maximum(known[asset.region_of], _LEAST_CHANCE)) ** _SHARPNESS
        share = np.bincount(asset.region_of, weights=asset.volumes)[asset.region_of] / asset.volumes.sum()
        found: Floats = share[:, None] * chances + (1 - share)[:, None] * scale_rows(both, both.sum(axis=1))
        return found


@dataclass(frozen=True, eq=False)
class SpanPosterior:
    """What is known of the parts that hulls hold.

    labels: that anything says, in the order of the columns of shares; by_region: of each asset the probability of each
    label for its pieces (pieces, labels), had regions nothing to do with each other; weights: of the evidence; solids:
    of each asset the probability that each of its solids (solids,) is one part.
    """

    assets: Sequence[AssetPieces]
    labels: tuple[str, ...]
    by_region: Sequence[Floats]
    weights: Floats
    solids: Sequence[Floats]

    @cached_property
    def chances(self) -> Sequence[Floats]:
        """Of each asset the probability of each label for its pieces (pieces, labels)."""
        found = list[Floats]()
        rows = zip(self.assets, self.by_region, self.by_solid, self.solids, strict=True)
        for asset, by_region, by_solid, solids in rows:
            whole = solids[asset.solid_of][:, None]
            found.append((1 - whole) * by_region + whole * by_solid)
        return found

    @cached_property
    def by_solid(self) -> Sequence[Floats]:
        """Of each asset the mean of by_region over the solid of each piece (pieces, labels)."""
        found = list[Floats]()
        for asset, chances in zip(self.assets, self.by_region, strict=True):
            of_solid = sum_groups(asset.solid_of, asset.volumes[:, None] * chances)
            found.append(scale_rows(of_solid, sum_groups(asset.solid_of, asset.volumes))[asset.solid_of])
        return found

    def shares_of(self, mesh: int) -> Floats:
        """Return the expected share of each label in each hull (hulls, labels); zeros where it stands for nothing."""
        common = self.assets[mesh].common
        return scale_rows(common @ self.chances[mesh], common.sum(axis=1))

    def chances_of(self, mesh: int) -> Floats:
        """Return the probability that each hull (hulls,) holds more than one label; 0 where it stands for nothing, and
        where nothing is said of any piece."""
        evidence = self.collect_evidence(mesh)
        found: Floats = 1 / (1 + np.exp(-(evidence @ self.weights)))
        return np.where((self.assets[mesh].common.sum(axis=1) > 0) & bool(self.labels), found, 0.0)

    def collect_evidence(self, mesh: int) -> Floats:
        """Return what the probability is made from (hulls, 2): one, and the logit of how often a hull spans parts where
        labels are drawn."""
        asset, by_region = self.assets[mesh], self.by_region[mesh]
        shares = scale_rows(asset.common, asset.common.sum(axis=1))
        drawn = np.zeros(len(shares))
        if by_region.size:
            drawn = _draw_spans(shares, _Draw(by_region, self.by_solid[mesh], self.solids[mesh]), asset)
        drawn = np.clip(drawn, _LEAST_DRAWN, 1 - _LEAST_DRAWN)
        return np.column_stack([np.ones(len(drawn)), np.log(drawn / (1 - drawn))])

    def rebuild(self, mesh: int, hulls: Ints) -> tuple[RebuiltHull, ...]:
        """Return new hulls for what some hulls (n,) stand for together: fine pieces of one label and region, joined
        where a convex hull around them adds little. Pieces of which no half is in hulls are left out.
        """
        asset, chances = self.assets[mesh], self.chances[mesh]
        pieces = [piece.shape.tessellate() for piece in asset.pieces.hulls]
        volumes, common = asset.volumes, asset.common[hulls]
        own = np.flatnonzero(common.sum(axis=0) >= WITHIN * volumes)
        if not own.size:
            return ()
        labels = chances[own].argmax(axis=1)
        kinds = asset.region_of[own] * chances.shape[1] + labels
        least = _SLIVER * float(volumes[own].sum())
        found = list[RebuiltHull]()
        for group in merge_pieces([pieces[place] for place in own.tolist()], kinds, least, labels):
            members = own[list(group.members)]
            shares = volumes[members] @ chances[members] / volumes[members].sum()
            label, old = int(shares.argmax()), int(hulls[common[:, members].sum(axis=1).argmax()])
            found.append(RebuiltHull(group.shape, self.labels[label], float(shares[label]), old))
        return tuple(found)


def _deal(items: Sequence[Label | None], counts: Sequence[int]) -> list[list[Label | None]]:
    rest = iter(items)
    return [list(islice(rest, count)) for count in counts]


def _estimate_whole(assets: Sequence[AssetPieces], observed: Sequence[Sequence[Label | None]]) -> float:
    """The probability that a small solid is one part, by those of which most is labelled."""
    one, all_ = _WHOLE_SOLIDS
    for asset, labels in zip(assets, observed, strict=True):
        names = [label.name if label else "" for label in labels]
        _, codes = np.unique(["", *names], return_inverse=True)
        volumes = np.zeros((asset.solid_of.max(initial=-1) + 1, codes.max() + 1))
        np.add.at(volumes, (asset.solid_of, codes[1:]), asset.volumes)
        total = volumes.sum(axis=1)
        has_parts = volumes[:, 0] <= (1 - WHOLE + EQUAL) * total
        counted = has_parts & (np.bincount(asset.solids_of_regions, minlength=len(total)) > 1)
        all_ += float(counted.sum())
        one += float((volumes[counted, 1:].max(axis=1, initial=0.0) >= (WHOLE - EQUAL) * total[counted]).sum())
    return one / all_


def weigh_solids(asset: AssetPieces, chances: Floats, whole: float) -> Floats:
    """Return the probability that each solid (solids,) is one part, if that of a small one is whole: the less of the
    asset it has the likelier, and the less the labels (pieces, labels) of its regions differ."""
    volumes, solids = sum_groups(asset.region_of, asset.volumes), asset.solids_of_regions
    of_solids = sum_groups(solids, volumes)
    prior: Floats = whole * (1 - of_solids / max(float(volumes.sum()), np.finfo(float).tiny))
    if not chances.size:
        return prior
    of_regions = sum_groups(asset.region_of, asset.volumes[:, None] * chances)
    known = np.maximum(scale_rows(of_regions, volumes), _LEAST_CHANCE)
    against = sum_groups(solids, np.log(known / known.max(axis=1, keepdims=True)) * volumes[:, None])
    counts = np.bincount(solids) / np.where(of_solids > 0, of_solids, 1.0)
    agreed = prior * np.exp(_IN_COMMON * counts * against.max(axis=1))
    found: Floats = agreed / (agreed + 1 - prior)
    return found


@dataclass(frozen=True, eq=False, slots=True)
class _Draw:
    """Labels of pieces by_region, by_solid (pieces, labels), and how likely each solid (solids,) is one part."""

    by_region: Floats
    by_solid: Floats
    solids: Floats


def _draw_spans(shares: Floats, draw: _Draw, asset: AssetPieces) -> Floats:
    """How often no label has `WHOLE` of a hull (hulls,), or it alone has a solid of another one, where labels of pieces
    are drawn by their probabilities: together for those of a solid that is one part, else for those of one region;
    shares: (hulls, pieces) of what a hull stands for."""
    random = np.random.default_rng(0)
    of_regions = random.random((_DRAWS, asset.region_of.max(initial=-1) + 1))[:, asset.region_of]
    of_solids = random.random((_DRAWS, len(draw.solids)))[:, asset.solid_of]
    whole = (random.random((_DRAWS, len(draw.solids))) < draw.solids)[:, asset.solid_of]
    codes = np.where(whole, _pick(of_solids, draw.by_solid), _pick(of_regions, draw.by_region))
    by_label = np.stack([shares @ (codes == label).T for label in range(draw.by_region.shape[1])], axis=2)
    is_mixed = by_label.max(axis=2) < WHOLE - EQUAL
    found: Floats = (is_mixed | _has_other_solid(by_label.argmax(axis=2), codes, asset)).mean(axis=1)
    return found


def _has_other_solid(main: Ints, codes: Ints, asset: AssetPieces) -> Bools:
    """Whether hulls (hulls, draws) alone stand for a solid of another label than the main one (hulls, draws) of each,
    as that of seat and one leg does, be the leg ever so thin; codes: the label of each piece (draws, pieces)."""
    order = np.argsort(asset.volumes, kind="stable")
    largest = dict(zip(asset.solid_of[order].tolist(), order.tolist(), strict=True))
    found = np.zeros(main.shape, dtype=np.bool_)
    for hull, solid in np.argwhere(asset.solids_alone).tolist():
        found[hull] |= codes[:, largest[solid]] != main[hull]
    return found


def _pick(drawn: Floats, chances: Floats) -> Ints:
    """The label of each piece (draws, pieces) by numbers from 0 to 1 (draws, pieces)."""
    ends = np.cumsum(chances, axis=1)
    found: Ints = (drawn[:, :, None] * ends[None, :, -1:] > ends[None]).sum(axis=2)
    return found


def scale_rows(rows: Floats, totals: Floats) -> Floats:
    """Return rows (n, k) by their totals (n,), zeros where these are zero."""
    return rows / np.where(totals > 0, totals, 1.0)[:, None]
