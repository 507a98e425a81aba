"""What an edit makes of each geom element: left alone, removed, followed by new ones."""

from __future__ import annotations

from collections.abc import Collection, Container, Iterator, Mapping
from dataclasses import dataclass, field

from meshforge.common import AssetError, nearest_name
from meshforge.formats.collision_pieces import names_to_keep, new_hulls
from meshforge.formats.mjcf.document import GeomRecord, MjcfDocument, MjcfNode, MjcfTree
from meshforge.formats.mjcf.edit_geoms import HullGeomMaker
from meshforge.formats.mjcf.model import MjcfModel
from meshforge.formats.mjcf.shapes import MjcfShapes
from meshforge.formats.slots import Slot, append_elements, replace_element
from meshforge.formats.xml import Splice
from meshforge.symbolic import Asset, Geom

_PLAIN = ("geom", "geom1", "geom2")
_TYPED = (("objtype", "objname"), ("reftype", "refname"))


@dataclass(slots=True, eq=False)
class GeomPlace:
    """A `<geom>` of the file: its element, None for one out of another model, and what is made of it.

    own: itself, None where it goes; after: the new elements that follow it.
    """

    authored: GeomRecord
    node: MjcfNode | None
    own: Slot | None
    after: list[Slot] = field(default_factory=list)


@dataclass(frozen=True, slots=True, eq=False)
class OldGeom:
    """A geom of the model as read: its number there, and the element that may get a name attribute, None if fixed."""

    number: int
    slot: Slot | None


@dataclass(frozen=True, slots=True, eq=False)
class NewGeom:
    """A new geom: its element, and its hull."""

    slot: Slot
    geom: Geom


def is_edited(asset: Asset, document: MjcfDocument) -> bool:
    """Whether any hull is made, or gone."""
    kept, known = names_to_keep(asset), {name for authored in document.authored for name in authored.names}
    gone = any(names_to_remove(authored, kept) for authored in document.authored)
    return gone or bool(new_hulls(asset, known))


def names_to_remove(authored: GeomRecord, kept: Container[str]) -> list[str]:
    """The hulls of an element that an edit takes away."""
    return [name for name in authored.names if name not in kept] if authored.collides else []


class MjcfPlan:
    """The geom elements of the output, and the geoms that MuJoCo shall make of them.

    reading: of the unedited document; body_poses: root_T_body of the bodies as authored.
    Raises AssetError: a geom that cannot be removed, a hull that cannot be placed.
    """

    def __init__(
        self, asset: Asset, document: MjcfDocument, compiled: MjcfModel, authored: MjcfModel, maker: HullGeomMaker
    ) -> None:
        self.asset, self.document, self.compiled, self.maker = asset, document, compiled, maker
        self.tree = compiled.tree
        self.nodes = {(n.source, n.element.start): n for n in self.tree.root.walk()}
        self.body_poses = dict(zip(authored.body_names, authored.body_poses, strict=True))
        kept = names_to_keep(asset)
        self.places = [self._place_geom(entry, kept) for entry in document.authored]
        self.owner = {name: place for place in self.places for name in place.authored.names}
        self.ends: dict[str, list[Slot]] = {}
        self.made: dict[int, Geom] = {}
        self._shapes = MjcfShapes(compiled.model)
        self._refuse_fixed(kept)
        for geom in new_hulls(asset, self.owner):
            self._place_new(geom)

    @property
    def bodies_to_change(self) -> list[str]:
        """The bodies whose geoms change."""
        gone = [place.authored.body for place in self.places if place.own is None]
        return list(dict.fromkeys([*gone, *(geom.body for geom in self.made.values())]))

    def predict_geoms(self) -> list[OldGeom | NewGeom]:
        """The geoms that MuJoCo shall make of the output, in its order."""
        copies: dict[tuple[str, int], list[int]] = {}
        for k, name in enumerate(self.compiled.names):
            copies.setdefault((self.compiled.body_of[k], id(self.owner[name])), []).append(k)
        found: list[OldGeom | NewGeom] = []
        of_body: dict[str, list[int]] = {name: [] for name in self.compiled.body_names}
        for k, body in enumerate(self.compiled.body_of):
            of_body[body].append(k)
        for body, numbers in of_body.items():
            for k in numbers:
                place = self.owner[self.compiled.names[k]]
                if place.own is not None:
                    found.append(OldGeom(k, None if place.authored.fixed else place.own))
                if k == copies[body, id(place)][-1]:
                    found += [NewGeom(slot, self.made[id(slot)]) for slot in place.after]
            found += [NewGeom(slot, self.made[id(slot)]) for slot in self.ends.get(body, [])]
        return found

    def build_splices(self, source: int, masses: Mapping[str, bytes]) -> list[Splice]:
        """The edits of one of the files; masses: the `<inertial>` of bodies whose elements hold nothing yet."""
        data = self.tree.sources[source].text.data
        found = []
        for place in self.places:
            slots = [*([place.own] if place.own else []), *place.after]
            untouched = len(slots) == 1 and slots[0].is_untouched
            if place.node is not None and place.node.source == source and not untouched:
                found.append(replace_element(data, place.node.element, slots))
        for body, slots in self.ends.items():
            node = self.body_node(body)
            if node is not None and node.source == source:
                first = [Slot(body, (), text=masses[body])] if body in masses else []
                found.append(append_elements(data, node.element, [*first, *slots]))
        return found

    def body_node(self, body: str) -> MjcfNode | None:
        """The element of a body; of the world, the last one, in which its last geoms stand. None without one."""
        if body == self.compiled.body_names[0]:
            worlds = list(self.tree.root.each("worldbody"))
            return worlds[-1] if worlds else None
        entry = next((entry for entry in self.document.bodies if entry.name == body), None)
        return self.nodes.get((entry.source, entry.start)) if entry else None

    def _place_geom(self, entry: GeomRecord, kept: Container[str]) -> GeomPlace:
        node = self.nodes.get((entry.source, entry.start))
        if names_to_remove(entry, kept):
            return GeomPlace(entry, node, None)
        element = node.element if node else None
        name = element.attributes.get("name") if element else None
        return GeomPlace(entry, node, Slot(entry.body, entry.names, name, element))

    def _refuse_fixed(self, kept: Container[str]) -> None:
        """Raise AssetError where what is removed is not one element of the files, or is referred to."""
        removed, renewed = [], {geom.name for geom in new_hulls(self.asset, self.owner)}
        for place in self.places:
            if place.own is not None:
                continue
            hull = names_to_remove(place.authored, kept)[0]
            if place.authored.fixed or place.node is None:
                where = self.tree.where(place.node) if place.node else str(self.tree.main.path)
                raise AssetError(f"hull {hull!r} cannot be changed: {place.authored.fixed}", where=where)
            if (name := place.node.attributes.get("name")) and hull not in renewed:
                removed.append((name, hull))
        refuse_referenced(self.tree, removed)

    def _place_new(self, geom: Geom) -> None:
        body = self._body_of(geom)
        parent = self.owner.get(geom.parent or "")
        pose, volume = self.body_poses[geom.body], self._parent_volume(geom)
        node = parent.node if parent else None
        if parent is not None and node is None:
            raise AssetError(
                f"hull {geom.name!r} takes after {geom.parent!r}, of which {parent.authored.fixed}",
                where=str(self.asset.path),
            )
        if parent is not None and node is not None and parent.authored.body == geom.body and not parent.authored.fixed:
            slot = self.maker.make_beside(geom, pose, node, volume)
            parent.after.append(slot)
        else:
            slot = self.maker.make_apart(geom, pose, body, node, volume)
            self.ends.setdefault(geom.body, []).append(slot)
        self.made[id(slot)] = geom

    def _body_of(self, geom: Geom) -> MjcfNode:
        body = self.body_node(geom.body)
        outer = (body, *self.maker.context.ancestors_of(body)) if body is not None else ()
        why = next((why for node in outer if (why := _obstacle_in(node))), "")
        if body is not None and not why:
            return body
        known = geom.body in self.body_poses
        place = "out of another model" if known else "not there"
        like = None if known else nearest_name(geom.body, self.body_poses)
        raise AssetError(
            f"hull {geom.name!r} is on body {geom.body!r}, which is {why or place}",
            where=str(self.asset.path),
            remedy=f"The nearest name of a body is {like!r}." if like else None,
        )

    def _parent_volume(self, geom: Geom) -> float:
        """The volume that has the mass of a hull's parent: its own, or that of all hulls in its place."""
        if geom.parent not in self.owner:
            return 0.0
        number = self.compiled.names.index(geom.parent)
        shape = self._shapes.part_of(number, self.compiled.geom_poses[number]).shape
        if shape is not None:
            return shape.volume
        return sum(other.shape.volume for other in self.asset.geoms if other.parent == geom.parent)


def _obstacle_in(node: MjcfNode) -> str:
    """What an element makes of a body within it, that a hull cannot be written to; empty where it leaves it alone."""
    if node.tag == "replicate":
        return "made by <replicate>"
    return "in a <frame> that scales it" if node.tag == "frame" and "scale" in node.attributes else ""


def geom_references(tree: MjcfTree) -> Iterator[tuple[str, MjcfNode]]:
    """The names of geoms that other elements refer to, each with such an element, in document order."""
    for node in tree.root.walk():
        attributes = node.attributes
        for key in _PLAIN:
            if attributes.get(key):
                yield attributes[key], node
        for kind, key in _TYPED:
            if attributes.get(kind) == "geom" and attributes.get(key):
                yield attributes[key], node


def refuse_referenced(tree: MjcfTree, removed: Collection[tuple[str, str]]) -> None:
    """Raise AssetError where something refers to a geom that is removed; its name attribute, the name of its hull."""
    hulls = dict(removed)
    for name, node in geom_references(tree):
        if name in hulls:
            own = node.attributes.get("name")
            element = f"<{node.tag} name={own!r}>" if own else f"<{node.tag}>"
            raise AssetError(
                f"hull {hulls[name]!r} cannot be removed: {element} refers to its geom {name!r}",
                where=tree.where(node),
                remedy="Take this element out of the file first, or leave the hull out of the edit.",
            )
