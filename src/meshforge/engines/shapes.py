"""The shapes that an engine made of a file, as it says itself, compared with the hulls that were read of that file:
which it joined to one, which are not as they were read, and which gaps its margins close."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Self

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
    def of(cls, what: Shape | Floats, margin: float = 0.0) -> Self:
        """Return that of a shape, or of the convex hull of points (n, 3); all in the root frame."""
        if not isinstance(what, Shape) or isinstance(what, Polytope):
            points = what.vertices if isinstance(what, Polytope) else what
            volume = what.volume if isinstance(what, Polytope) else _measure_volume(points)
            return cls((points @ _WAYS.T).max(axis=0), volume, margin)
        return cls(np.array([way @ what.support(way) for way in _WAYS]), what.volume, margin)

    @property
    def width(self) -> float:
        return float((self.reach + self.reach[::-1]).max())

    @property
    def slack(self) -> float:
        """How much farther another shape may reach that is the same but for rounding [m]."""
        return _OF_PLACE * float(np.abs(self.reach).max()) + _OF_WIDTH * self.width

    def measure_differences(self, reaches: Floats, volumes: Floats, is_round: bool) -> Floats:
        """Return how far other shapes (n, 26), (n,) differ, as multiples of what rounding may do."""
        more, sides = reaches - self.reach, self.reach[_AXES[:3]] + self.reach[_AXES[3:]]
        less = self.slack + _OF_ROUND * self.width * is_round
        grown = 2 * self.slack * float(sides @ np.roll(sides, 1)) + _OF_VOLUME * np.maximum(self.volume, volumes)
        far = np.maximum(more.max(axis=1) / self.slack, -more.min(axis=1) / less)
        return np.asarray(np.maximum(far, np.abs(volumes - self.volume) / grown))


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
    def own(self) -> dict[str, EngineShape]:
        """Our shapes by name, the hulls first; each non-convex piece is one for engines, too: its hull."""
        pieces = [(piece.name, piece.surface) for piece in self.asset.non_convex if piece.surface is not None]
        hulls = {geom.name: EngineShape.of(geom.shape) for geom in self.asset.geoms}
        return hulls | {name: EngineShape.of(one.vertices[np.unique(one.faces)]) for name, one in pieces}

    @cached_property
    def matches(self) -> dict[str, int]:
        """Of our shapes those that the engine has, each with its number there."""
        from scipy.optimize import linear_sum_assignment  # lazy: as above

        if not self.own or not self.found:
            return {}
        curved = {geom.name for geom in self.asset.geoms if geom.shape.kind not in ("box", "polytope")}
        reaches, volumes = np.array([one.reach for one in self.found]), np.array([one.volume for one in self.found])
        off = np.array([one.measure_differences(reaches, volumes, name in curved) for name, one in self.own.items()])
        names, pairs = [*self.own], zip(*linear_sum_assignment(np.where(off <= 1, 1e-6 * off, 1.0)), strict=True)
        return {names[k]: int(there) for k, there in pairs if off[k, there] <= 1}

    @property
    def findings(self) -> Iterator[Finding]:
        """What the engine does not make as it was read."""
        solid = {name: one for name, one in self.own.items() if one.volume > _FLAT * one.width**3}
        rest = {name: one for name, one in solid.items() if name not in self.matches}
        groups, left = list[list[str]](), list[EngineShape]()
        known = {there: name for name, there in self.matches.items()}
        for k in sorted(range(len(self.found)), key=known.__contains__):
            shape, own = self.found[k], [known[k]] if k in known else []
            within = [name for name, one in rest.items() if (one.reach <= shape.reach + shape.slack).all()]
            reach = np.max([self.own[name].reach for name in (*own, *within)], axis=0) if within else -np.inf
            if len(own) + len(within) > 1 and (own or (reach >= shape.reach - shape.slack).all()):
                groups.append([*own, *within])
                rest = {name: one for name, one in rest.items() if name not in within}
            elif not own:
                left.append(shape)
        if groups:
            texts = join_names([f"{_name_group(one)} ({pluralize(len(one), 'piece')} here)" for one in groups])
            message = f"{self.asked} makes one hull of all of a collision mesh, which closes what is between: {texts}"
            hulls = {geom.name for geom in self.asset.geoms}
            names = tuple(name for one in groups for name in one if name in hulls)
            yield Finding(f"{self.engine}-joins", "error", names, message, self.remedy)
        yield from self._report_margins()
        yield from self._report_others(rest, left)

    def _report_margins(self) -> Iterator[Finding]:
        """Hulls that are apart here, and between which nothing passes there, since contacts begin at a distance.

        The file sets that for MuJoCo. Bullet has one of its own: between pieces of a body it closes what is no gap to
        anybody, between bodies what matters if they collide with each other.
        """
        own, geoms = self.engine == "bullet", self.asset.geoms
        matches = {k: self.matches[geom.name] for k, geom in enumerate(geoms) if geom.name in self.matches}
        margins = {k: self.found[there].margin for k, there in matches.items()}
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

    def _report_others(self, rest: Mapping[str, EngineShape], left: Sequence[EngineShape]) -> Iterator[Finding]:
        """What differs for no known reason: hulls that are other ones there, or none, and shapes that are no hulls."""
        texts, remedy = list[str](), "Look at scale, pose and file of each in the file; `meshforge render` draws it."
        for name, one in rest.items():
            off = [float(np.abs(shape.reach - one.reach).max()) for shape in left]
            near = f"the nearest shape there differs by {min(off):.3g} m" if off else "it has none for it"
            texts.append(f"{name} ({near})")
        if texts:
            message = f"{self.asked} does not make the same shape as is read here: {join_names(texts, 5)}"
            yield Finding(f"{self.engine}-differs", "error", tuple(rest), message, remedy)
        elif left:
            message = f"{self.asked} makes {pluralize(len(left), 'shape')} more than are read here"
            yield Finding(f"{self.engine}-differs", "error", (), message, remedy)


def _name_group(names: Sequence[str]) -> str:
    """The element of pieces `element#0`, `element#1`, where they are of one."""
    elements = {name.rpartition("#")[0] or name for name in names}
    return elements.pop() if len(elements) == 1 else join_names(names, 3)
