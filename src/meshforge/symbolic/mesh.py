"""The symbolic collision mesh: hulls, their contact graph, and selections of hulls as bit sets."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from importlib import import_module
from math import dist
from typing import Any, Literal, Self

import numpy as np

from meshforge import geometry
from meshforge.common import HullNotFoundError, MeshForgeError, import_extra, pluralize, suggest_name
from meshforge.geometry import Aabb, Floats, Shape, bounds, is_same_shape
from meshforge.symbolic.asset import Asset, Geom
from meshforge.symbolic.hull import Hull, Label

EPSILON = 0.002
"""Contact threshold as a share of the diagonal (paper, implementation)."""

ContactGraph = Mapping[tuple[int, int], float]
"""Distance [m] of each pair (i, j), i < j, that is within reach."""

NEAR_MISS = 3.0
"""Pairs within this many times the contact distance are kept, to be shown."""


@dataclass(frozen=True, eq=False)
class SymbolicMesh:
    """A set of symbolic hulls and their contact graph (paper, section on the symbolic collision mesh).

    asset: the file it came from, None for a mesh made in memory; epsilon: the contact threshold, relative;
    scale: the length L [m] that epsilon refers to; None takes the diagonal of the AABB of all hulls.
    """

    hulls: tuple[Hull, ...]
    asset: Asset | None = None
    epsilon: float = EPSILON
    scale: float | None = None

    @classmethod
    def of(cls, asset: Asset, labels: Mapping[str, Label | str] | None = None) -> Self:
        """Return the mesh of an asset, with labels by the names of hulls; other names in `labels` are ignored."""
        mesh = cls(tuple(Hull(g.name, g.body, g.shape, parent=g.parent) for g in asset.geoms), asset)
        return mesh.with_labels(labels) if labels else mesh

    def __repr__(self) -> str:
        """One line: the file, how many hulls and bodies there are, and the labels."""
        name = self.asset.path.name if self.asset else "in memory"
        bodies = pluralize(len({hull.body for hull in self.hulls}), "body", "bodies")
        counts = Counter(hull.label for hull in self.hulls if hull.label)
        labels = ", ".join(f"{count} {label}" for label, count in sorted(counts.items()))
        bare = len(self.hulls) - counts.total()
        labels += f"{', ' if counts else ''}{bare} without label" if bare else ""
        others = self.asset.non_convex if self.asset else ()
        non_convex = f"; {pluralize(len(others), 'non-convex piece')}" if others else ""
        return f"<SymbolicMesh {name}: {pluralize(len(self.hulls), 'hull')}, {bodies}: {labels or 'empty'}{non_convex}>"

    def _repr_html_(self) -> str:
        """A picture and a table of the hulls, which notebooks show."""
        html: str = _find_above("inspection.display", "to_html")(self)
        return html

    def show(self, *, port: int | None = None, browser: bool = True, wait: bool | None = None) -> Any:
        """Open the mesh in a viewer in the browser; the viewer's server, a `viser.ViserServer`.

        port: on this machine, None takes a free one; browser: open the page; wait: until Ctrl-C, by default in a script
        but not in a notebook or an interactive session.
        Raises MeshForgeError where viser is not installed: `pip install 'meshforge[viewer]'`.
        """
        return _find_above("inspection.display", "show")(self, port=port, browser=browser, wait=wait)

    def to_trimesh(self) -> Any:
        """Return a `trimesh.Scene` with a mesh for each hull, under its name. Raises MeshForgeError without trimesh."""
        scene = import_extra("trimesh", "trimesh", "to_trimesh()").Scene()
        for hull in self.hulls:
            scene.add_geometry(hull.to_trimesh(), node_name=hull.name, geom_name=hull.name)
        return scene

    def to_mjspec(self) -> Any:
        """Return a `mujoco.MjSpec` of the asset with these hulls; of an MJCF, all the rest as the file has it.

        It holds the files it refers to in memory. Raises AssetError where an MJCF cannot hold the hulls.
        """
        return _find_above("formats", "to_mjspec")(self)

    def __getitem__(self, name: str) -> Hull:
        """The hull of that name. Raises HullNotFoundError, a KeyError, that names the nearest one."""
        return self.hull_of(name)

    def __contains__(self, name: object) -> bool:
        """Whether there is a hull of that name."""
        return name in self.index

    def __iter__(self) -> Iterator[Hull]:
        return iter(self.hulls)

    @cached_property
    def aabb(self) -> Aabb | None:
        """The box around all hulls, None where there is none."""
        return Aabb.union(h.aabb for h in self.hulls) if self.hulls else None

    @cached_property
    def corners(self) -> tuple[Floats, Floats]:
        """The lowest and the highest corners of the AABBs of all hulls, each (hulls, 3) [m]."""
        if not self.hulls:
            return np.zeros((0, 3)), np.zeros((0, 3))
        return bounds([hull.shape.aabb for hull in self.hulls])

    @cached_property
    def diagonal(self) -> float:
        """The diagonal of the AABB of all hulls [m], 0 where there is none."""
        if not self.hulls:
            return 0.0
        low, high = self.corners
        return dist(low.min(axis=0).tolist(), high.max(axis=0).tolist())

    @property
    def contact_distance(self) -> float:
        """Hulls no farther apart than this are in contact [m]; the slack against rounding is included."""
        length = self.diagonal if self.scale is None else self.scale
        return self.epsilon * length + 1e-9 * length

    @cached_property
    def graph(self) -> ContactGraph:
        """Distances of all pairs within three times the contact distance."""
        return contact_graph([h.shape for h in self.hulls], self.contact_distance * NEAR_MISS)

    @property
    def known_graph(self) -> ContactGraph | None:
        """The contact graph, None where it is not measured yet."""
        return self.__dict__.get("graph")

    def set_known_graph(self, graph: ContactGraph) -> None:
        """Spare the measuring of distances that are known from another mesh with the same shapes."""
        self.__dict__["graph"] = graph

    @cached_property
    def contacts(self) -> frozenset[tuple[int, int]]:
        """The pairs (i, j), i < j, of hulls in contact."""
        reach = self.contact_distance
        return frozenset(pair for pair, gap in self.graph.items() if gap <= reach)

    @cached_property
    def adjacency(self) -> tuple[int, ...]:
        """The neighbours of each hull as a bit set: bit j of entry i is set where i and j are in contact."""
        rows = [0] * len(self.hulls)
        for i, j in self.contacts:
            rows[i] |= 1 << j
            rows[j] |= 1 << i
        return tuple(rows)

    def neighbours(self, index: int) -> frozenset[int]:
        """Return indices of the hulls in contact with hull `index`; never itself."""
        return bits_of(self.adjacency[index])

    @property
    def near_misses(self) -> tuple[tuple[int, int, float], ...]:
        """Pairs apart, yet within three times the contact distance, with their distance [m], nearest first."""
        reach = self.contact_distance
        apart = [(i, j, gap) for (i, j), gap in self.graph.items() if gap > reach]
        return tuple(sorted(apart, key=lambda row: (row[2], row[0], row[1])))

    @cached_property
    def index(self) -> Mapping[str, int]:
        """Position of each hull by name."""
        return {hull.name: k for k, hull in enumerate(self.hulls)}

    def hull_of(self, name: str) -> Hull:
        """Return the hull of that name. Raises HullNotFoundError where there is none."""
        if name not in self.index:
            where = str(self.asset.path) if self.asset else None
            remedy = suggest_name(str(name), self.index, f"It has {pluralize(len(self.hulls), 'hull')}; see `.index`.")
            raise HullNotFoundError(f"there is no hull {name!r}", where=where, remedy=remedy)
        return self.hulls[self.index[name]]

    @property
    def labels(self) -> dict[str, Label]:
        return {h.name: h.annotation for h in self.hulls if h.annotation}

    def names_of(self, mask: int) -> tuple[str, ...]:
        """Return the names of the hulls in a bit set, in their order."""
        return tuple(self.hulls[index].name for index in sorted(bits_of(mask)))

    def with_labels(self, labels: Mapping[str, Label | str | None]) -> Self:
        """Return the mesh with some labels set, or taken away by None; names that no hull has are ignored."""
        given = {name: None if label is None else Label.of(label) for name, label in labels.items()}
        return self.with_hulls(h.with_label(given[h.name]) if h.name in given else h for h in self.hulls)

    def with_hulls(self, hulls: Iterable[Hull]) -> Self:
        """Return the mesh with other hulls; distances between hulls whose shapes stay are not measured again."""
        edited = replace(self, hulls=tuple(hulls))
        if self.known_graph is not None and edited.contact_distance == self.contact_distance:
            known, now = _positions_by_shape(self.hulls), _positions_by_shape(edited.hulls)
            kept = {now[shape]: known[shape] for shape in now if shape in known}
            reach = self.contact_distance * NEAR_MISS
            edited.set_known_graph(contact_graph([h.shape for h in edited.hulls], reach, self.known_graph, kept))
        return edited

    def with_view_up(self, up: Literal["y", "z"] | None) -> Self:
        """Return the mesh with another `view_up` of its asset."""
        return replace(self, asset=replace(self.asset, view_up=up)) if self.asset else self

    def to_asset(self) -> Asset:
        """Return the asset with the hulls of this mesh as its geoms. Raises MeshForgeError for one made in memory."""
        if self.asset is None:
            raise MeshForgeError("this mesh was made in memory and has no file to be written back to")
        named = self.names_in_file
        return self.asset.with_geoms(
            Geom(named.get(h.name, h.name), h.body, h.shape, h.parent, label=h.label or "") for h in self.hulls
        )

    def as_written(self, names: Mapping[str, str], back: Asset) -> Self:
        """Return the mesh with the names and shapes of its hulls in the file that was written of it, for the labels
        beside it.

        names: those in the file, of hulls that have another one there; back: the file as it reads back.
        """
        there = {geom.name: geom.shape for geom in back.geoms}
        renamed = (replace(hull, name=names.get(hull.name, hull.name)) for hull in self.hulls)
        return type(self)(tuple(replace(hull, shape=there.get(hull.name, hull.shape)) for hull in renamed))

    @property
    def names_in_file(self) -> dict[str, str]:
        """The names of hulls that alone took the place of one, with the name of that, which they get in a file."""
        alone = {h.name: h.parent for h in self.hulls if h.keeps_name and h.parent}
        return {name: parent for name, parent in alone.items() if parent not in self.index}


def _find_above(module: str, name: str) -> Any:
    """A function of a package above this one, behind a method that people call on a mesh they hold (decision 0035)."""
    return getattr(import_module(f"meshforge.{module}"), name)


def _positions_by_shape(hulls: tuple[Hull, ...]) -> dict[int, int]:
    """Position of each shape object by its identity, without those that several hulls share."""
    ids = [id(hull.shape) for hull in hulls]
    seen = Counter(ids)
    return {shape: k for k, shape in enumerate(ids) if seen[shape] == 1}


def bits_of(mask: int) -> frozenset[int]:
    """Return the positions of the set bits."""
    found = []
    while mask:
        low = mask & -mask
        found.append(low.bit_length() - 1)
        mask ^= low
    return frozenset(found)


def mask_of(indices: Iterable[int]) -> int:
    """Return the bit set of some positions."""
    mask = 0
    for index in indices:
        mask |= 1 << index
    return mask


def contact_graph(
    shapes: Sequence[Shape], reach: float, known: ContactGraph | None = None, kept: Mapping[int, int] | None = None
) -> ContactGraph:
    """Return distances of all pairs of shapes that are at most `reach` [m] apart, in the order of their indices.

    known, kept: distances of an earlier list of shapes, and for each shape that was in it, its index there;
    pairs of two kept shapes are taken over, all others are measured.
    """
    if known is None or not kept:
        return geometry.close_pairs(shapes, reach)  # by its package: coal is imported where contacts are asked for
    back = {old: new for new, old in kept.items()}
    found = {
        (min(back[i], back[j]), max(back[i], back[j])): gap for (i, j), gap in known.items() if i in back and j in back
    }
    if len(kept) < len(shapes):
        found.update(geometry.close_pairs(shapes, reach, unchanged=frozenset(kept)))
    return dict(sorted(found.items()))


def find_unchanged(before: SymbolicMesh, after: SymbolicMesh) -> frozenset[str]:
    """Return the names of hulls that two meshes have alike, coordinates within a millionth of the larger diagonal."""
    near = 1e-6 * max(before.diagonal, after.diagonal)
    both = (name for name in before.index if name in after.index)
    return frozenset(n for n in both if is_same_shape(before.hull_of(n).shape, after.hull_of(n).shape, near))


def split_by_body(mesh: SymbolicMesh, mask: int) -> list[int]:
    """Return the parts of a selection in one body each, as bit sets, in order of their lowest index."""
    parts: dict[str, int] = {}
    for index, hull in enumerate(mesh.hulls):
        if mask >> index & 1:
            parts[hull.body] = parts.get(hull.body, 0) | 1 << index
    return list(parts.values())


def split_by_contact(mesh: SymbolicMesh, mask: int) -> list[int]:
    """Return the connected components of a selection within one body each, as bit sets, in order of their lowest index.

    mask: the selection as a bit set. Hulls outside the selection, or of another body, connect nothing.
    """
    found = []
    for part in split_by_body(mesh, mask):
        while part:
            found.append(_reach(mesh.adjacency, part & -part, part))
            part &= ~found[-1]
    return sorted(found, key=lambda component: component & -component)


def _reach(adjacency: tuple[int, ...], seed: int, allowed: int) -> int:
    reached = frontier = seed
    while frontier:
        lowest = frontier & -frontier
        fresh = adjacency[lowest.bit_length() - 1] & allowed & ~reached
        reached |= fresh
        frontier = (frontier ^ lowest) | fresh
    return reached
