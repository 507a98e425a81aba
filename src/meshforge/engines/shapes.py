"""The shapes that an engine made of a file, as it says itself, compared with the hulls that were read of that file:
which it joined to one, which are not as they were read, and which gaps its margins close."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np

from meshforge.common import join_names, pluralize
from meshforge.engines.limits import Finding
from meshforge.geometry import Aabb, Floats, Polytope, Shape
from meshforge.symbolic import EPSILON, Asset, contact_graph

_WAYS = np.array([way for way in product((-1, 0, 1), repeat=3) if any(way)], dtype=np.float64)
_WAYS /= np.linalg.norm(_WAYS, axis=1)[:, None]
_AXES = [int(np.argmax(_WAYS @ way)) for way in np.concatenate([np.eye(3), -np.eye(3)])]
_OF_PLACE = 2e-5
"""Of the largest coordinate: engines and mesh files keep 24 bits of a number, and a pose multiplies a few."""
_OF_WIDTH = 1e-3
"""Of the width of a shape: Bullet makes hulls in integers, which moves corners by up to 2e-4 of it; less than a
thousandth collides alike."""
_OF_ROUND = 0.01
"""Of the width of a round shape, by which Bullet's may be smaller: its cylinders have 32 sides."""
_CLOSED = 0.999
"""Of the two margins: a gap as wide as they are, but for rounding, is none that they close."""
_NARROW = "Make the margin less than half the gap, or move the hulls apart."
_FLAT = 1e-7
"""Of the cube of its width, the volume of a piece that engines leave out for it spans none."""
_OF_VOLUME = 0.02
"""Of the volume, by which a shape that reaches as far may differ, as a cylinder of 32 sides from a round one does."""


@dataclass(frozen=True, eq=False, slots=True)
class EngineShape:
    """A shape as an engine has it. reach: (26,) its supports along the axes, and the diagonals between them [m];
    volume [m^3]; margin: how far from it contacts begin [m]."""

    reach: Floats
    volume: float
    margin: float = 0.0

    @classmethod
    def of(cls, what: Shape | Floats, margin: float = 0.0) -> "EngineShape":
        """Return that of a shape, or of the convex hull of points (n, 3); all in the root frame."""
        if not isinstance(what, Shape) or isinstance(what, Polytope):
            points = what.vertices if isinstance(what, Polytope) else what
            volume = what.volume if isinstance(what, Polytope) else _measure_volume(points)
            return cls((points @ _WAYS.T).max(axis=0), volume, margin)
        return cls(np.array([way @ what.support(way) for way in _WAYS]), what.volume, margin)

    @property
    def width(self) -> float:
        return float((self.reach + self.reach[::-1]).max())


def _measure_volume(points: Floats) -> float:
    from scipy.spatial import ConvexHull, QhullError  # lazy: 0.2 s, only engines that are asked need it

    try:
        return float(ConvexHull(points).volume)
    except QhullError:
        return 0.0


@dataclass(frozen=True, eq=False)
class ShapeComparison:
    """The hulls of an asset beside the shapes of an engine, both at rest pose in the root frame.

    engine, asked: its name, and what was run; remedy: for hulls of a mesh that it joins.
    """

    engine: str
    asked: str
    asset: Asset
    found: Sequence[EngineShape]
    remedy: str

    @cached_property
    def names(self) -> list[str]:
        """Those of our shapes, the hulls first; each non-convex piece is one for engines, too: its hull."""
        pieces = [piece.name for piece in self.asset.non_convex if piece.surface is not None]
        return [*(geom.name for geom in self.asset.geoms), *pieces]

    @cached_property
    def own(self) -> list[EngineShape]:
        surfaces = [piece.surface for piece in self.asset.non_convex if piece.surface is not None]
        hulls = [EngineShape.of(geom.shape) for geom in self.asset.geoms]
        return [*hulls, *(EngineShape.of(surface.vertices[np.unique(surface.faces)]) for surface in surfaces)]

    @cached_property
    def matches(self) -> dict[int, int]:
        """Of our shapes those that the engine has, each with its number there."""
        from scipy.optimize import linear_sum_assignment  # lazy: as above

        if not self.own or not self.found:
            return {}
        off = np.array([[self._measure_difference(k, there) for there in self.found] for k in range(len(self.own))])
        rows, columns = linear_sum_assignment(np.where(off <= 1, 1e-6 * off, 1.0))
        return {int(k): int(there) for k, there in zip(rows, columns, strict=True) if off[k, there] <= 1}

    def _slack(self, shape: EngineShape) -> float:
        return _OF_PLACE * float(np.abs(shape.reach).max()) + _OF_WIDTH * shape.width

    def _measure_difference(self, k: int, there: EngineShape) -> float:
        """How far two shapes differ, as a multiple of what rounding may do."""
        mine = self.own[k]
        more, slack = there.reach - mine.reach, self._slack(mine)
        is_round = k < len(self.asset.geoms) and self.asset.geoms[k].shape.kind not in ("box", "polytope")
        less = slack + _OF_ROUND * mine.width * is_round
        sides = mine.reach[_AXES[:3]] + mine.reach[_AXES[3:]]
        grown = 2 * slack * float(sides @ np.roll(sides, 1)) + _OF_VOLUME * max(mine.volume, there.volume)
        return max(float(more.max()) / slack, -float(more.min()) / less, abs(there.volume - mine.volume) / grown)

    @property
    def findings(self) -> Iterator[Finding]:
        """What the engine does not make as it was read."""
        rest = [k for k in range(len(self.own)) if k not in self.matches]
        others = [shape for k, shape in enumerate(self.found) if k not in self.matches.values()]
        joined, left = [list[int]() for _ in others], list[EngineShape]()
        for into, shape in zip(joined, others, strict=True):
            within = [k for k in rest if (self.own[k].reach <= shape.reach + self._slack(shape)).all()]
            reach = np.max([self.own[k].reach for k in within], axis=0) if within else 0.0
            if len(within) > 1 and (reach >= shape.reach - self._slack(shape)).all():
                into += within
                rest = [k for k in rest if k not in within]
            else:
                left.append(shape)
        if groups := [[self.names[k] for k in one] for one in joined if one]:
            texts = join_names([f"{_name_group(one)} ({pluralize(len(one), 'piece')} here)" for one in groups])
            message = f"{self.asked} makes one hull of all of a collision mesh, which closes what is between: {texts}"
            names = tuple(self.names[k] for one in joined for k in one if k < len(self.asset.geoms))
            yield Finding(f"{self.engine}-joins", "error", names, message, self.remedy)
        yield from self._report_margins()
        yield from self._report_others([k for k in rest if self.own[k].volume > _FLAT * self.own[k].width ** 3], left)

    def _report_margins(self) -> Iterator[Finding]:
        """Hulls that are apart here, and between which nothing passes there, since contacts begin at a distance.

        The file sets that for MuJoCo. Bullet has one of its own: between pieces of a body it closes what is no gap to
        anybody, between bodies what matters if they collide with each other.
        """
        own = self.engine == "bullet"
        geoms = self.asset.geoms
        margins = {k: self.found[there].margin for k, there in self.matches.items() if k < len(geoms)}
        if not any(margins.values()):
            return
        size = Aabb.union(geom.shape.aabb for geom in geoms).diagonal
        gaps = contact_graph([geom.shape for geom in geoms], 2 * max(margins.values()))
        closed = {
            pair: gap
            for pair, gap in gaps.items()
            if EPSILON * size < gap < _CLOSED * sum(margins.get(k, 0.0) for k in pair)
            and not (own and geoms[pair[0]].body == geoms[pair[1]].body)
        }
        if closed:
            texts = [f"{geoms[i].name} and {geoms[j].name} ({1000 * gap:.3g} mm)" for (i, j), gap in closed.items()]
            message = f"{self.asked} closes gaps by the margins of hulls: {join_names(texts, 5)}"
            names = tuple(dict.fromkeys(geoms[k].name for pair in closed for k in pair))
            yield Finding(f"{self.engine}-margin", "warning" if own else "error", names, message, _NARROW)

    def _report_others(self, rest: Sequence[int], left: Sequence[EngineShape]) -> Iterator[Finding]:
        """What differs for no known reason: hulls that are other ones there, or none, and shapes that are no hulls."""
        texts, remedy = list[str](), "Look at scale, pose and file of each in the file; `meshforge render` draws it."
        for k in rest:
            off = [float(np.abs(shape.reach - self.own[k].reach).max()) for shape in left]
            near = f"the nearest shape there differs by {min(off):.3g} m" if off else "it has none for it"
            texts.append(f"{self.names[k]} ({near})")
        if texts:
            message = f"{self.asked} does not make the same shape as is read here: {join_names(texts, 5)}"
            yield Finding(f"{self.engine}-differs", "error", tuple(self.names[k] for k in rest), message, remedy)
        elif left:
            message = f"{self.asked} makes {pluralize(len(left), 'shape')} more than are read here"
            yield Finding(f"{self.engine}-differs", "error", (), message, remedy)


def _name_group(names: Sequence[str]) -> str:
    """The element of pieces `element#0`, `element#1`, where they are of one."""
    elements = {name.rpartition("#")[0] or name for name in names}
    return elements.pop() if len(elements) == 1 else join_names(names, 3)
