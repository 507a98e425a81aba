"""What an edit makes of each `<geom>`: left alone, removed, followed by new ones; and what MuJoCo shall make of it."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from meshforge.common import AssetError, nearest_name
from meshforge.formats import collision_pieces, element_edits, xml
from meshforge.formats.mjcf.document import MjcfNode, MjcfTree, geom_names
from meshforge.formats.mjcf.model import MjcfModel
from meshforge.formats.mjcf.new_geoms import NewGeoms
from meshforge.symbolic import Asset, Geom

_ROUNDS = 4  # a name that one geom gets may change those that others read back under
_PLAIN = ("geom", "geom1", "geom2")
_TYPED = (("objtype", "objname"), ("reftype", "refname"))


@dataclass(slots=True, eq=False)
class GeomElement:
    """A `<geom>` of the file, or a geom out of another model, which has no node here.

    geoms: the numbers of what MuJoCo makes of it; fixed: why an edit cannot change it, empty where it can; own: itself
    in the output, None where it goes; after: the new elements that follow it.
    """

    node: MjcfNode | None
    geoms: list[int]
    fixed: str
    own: element_edits.OutputElement | None
    after: list[element_edits.OutputElement] = field(default_factory=list)


@dataclass(slots=True, eq=False)
class GeomPlan:
    """A geom that MuJoCo shall make of the output.

    name: that of the asset; attribute: its name in the file, empty without one; element: what may get such a name, None
    where it has one, or can have none; hull: what a new one shall be.
    """

    name: str
    body: str
    attribute: str
    element: element_edits.OutputElement | None
    hull: Geom | None = None


class GeomEdits:
    """The `<geom>` elements of the output, and `geoms`, what MuJoCo shall make of them.

    before: the model of the unedited files; names: of geoms that read back under others, those. Raises AssetError: a
    geom that cannot be removed, a hull that cannot be placed.
    """

    def __init__(self, asset: Asset, before: MjcfModel, maker: NewGeoms) -> None:
        self.asset, self.before, self.maker, self.tree = asset, before, maker, before.tree
        self.ends: dict[str, list[element_edits.OutputElement]] = {}
        self._poses = dict(zip(before.body_names, before.body_poses, strict=True))
        self._hulls: dict[int, Geom] = {}
        self.elements = list(self._list_elements())
        self._owner = {before.names[k]: element for element in self.elements for k in element.geoms}
        made = collision_pieces.new_hulls(asset, before.collision_names)
        self._remove({geom.name for geom in made})
        for geom in made:
            self._add(geom)
        self.geoms = list(self._plan_geoms())
        self.names = self._assign_names()

    @property
    def changed_bodies(self) -> list[int]:
        """The bodies, by number, that weigh and whose geoms change."""
        gone = [self.before.body_of[element.geoms[0]] for element in self.elements if element.own is None]
        names = dict.fromkeys([*gone, *(geom.body for geom in self._hulls.values())])
        return [k for k in map(self.before.body_names.index, names) if self.before.model.body_mass[k] > 0]

    def body_node(self, body: str) -> MjcfNode | None:
        """Return the element of a body; of the world, the last one, in which its last geoms stand. None without one."""
        if body == self.before.body_names[0]:
            return next(iter([*self.tree.root.each("worldbody")][-1:]), None)
        if body not in self._poses:
            return None
        return self.before.flat.node_at(self.before.spec_bodies[self.before.body_names.index(body)].info)

    def build_splices(self, source: int) -> Iterator[xml.Splice]:
        """Yield the edits of one of the files."""
        data = self.tree.sources[source].text.data
        for element in self.elements:
            outputs = [*([element.own] if element.own else []), *element.after]
            untouched = len(outputs) == 1 and outputs[0].is_untouched
            if element.node is not None and element.node.source == source and not untouched:
                yield element_edits.replace_element(data, element.node.element, outputs)
        for body, outputs in self.ends.items():
            node = self.body_node(body)
            if node is not None and node.source == source:
                yield element_edits.append_elements(data, node.element, outputs)

    def _list_elements(self) -> Iterator[GeomElement]:
        copies: dict[int, list[int]] = {}
        for k, node in enumerate(self.before.elements):
            copies.setdefault(-k - 1 if node is None else id(node), []).append(k)
        for numbers in copies.values():
            node = self.before.elements[numbers[0]]
            names = tuple(self.before.names[k] for k in numbers)
            attribute = node.attributes.get("name") if node else None
            body, source = self.before.body_of[numbers[0]], node.element if node else None
            own = element_edits.OutputElement(body, names, attribute, source)
            yield GeomElement(node, numbers, self._find_obstacle(node), own)

    def _find_obstacle(self, node: MjcfNode | None) -> str:
        """Why an element cannot be edited, empty where it can."""
        if node is None:
            return "out of another model, which is attached"
        for around in (node, *self.maker.context.ancestors_of(node)):
            if around.tag == "replicate":
                return "inside a <replicate>, which makes several geoms of one element"
            if around.tag == "frame" and "scale" in around.attributes:
                return "inside a <frame> that scales what it holds"
        return ""

    def _remove(self, renewed: set[str]) -> None:
        """Take away the elements of hulls that are gone; renewed: the names of new hulls."""
        kept, names = collision_pieces.names_to_keep(self.asset), self.before.names
        removed: dict[str, str] = {}
        for element in self.elements:
            gone = [names[k] for k in element.geoms if self.before.collides[k] and names[k] not in kept]
            if not gone:
                continue
            if element.fixed or element.node is None:
                where = self.tree.where(element.node) if element.node else str(self.tree.main.path)
                raise AssetError(f"hull {gone[0]!r} cannot be changed: it is {element.fixed}", where=where)
            element.own = None
            if (name := element.node.attributes.get("name")) and gone[0] not in renewed:
                removed[name] = gone[0]
        _refuse_referenced(self.tree, removed)

    def _add(self, geom: Geom) -> None:
        body = self._find_body(geom)
        parent = self._owner.get(geom.parent or "")
        node = parent.node if parent else None
        if parent is not None and node is None:
            problem = f"hull {geom.name!r} takes after {geom.parent!r}, which is {parent.fixed}"
            raise AssetError(problem, where=str(self.asset.path))
        is_adjacent = (
            (parent is not None and node is not None and not parent.fixed)
            and self.before.body_of[parent.geoms[0]] == geom.body
            and next(self.maker.context.ancestors_of(node)).tag != "frame"
        )
        output = self.maker.make_geom(geom, self._poses[geom.body], body, node, self._parent_volume(geom), is_adjacent)
        (parent.after if parent and is_adjacent else self.ends.setdefault(geom.body, [])).append(output)
        self._hulls[id(output)] = geom

    def _find_body(self, geom: Geom) -> MjcfNode:
        body, known = self.body_node(geom.body), geom.body in self._poses
        place = self._find_obstacle(body) if known else "not there"
        if body is not None and not place:
            return body
        like = None if known else nearest_name(geom.body, self._poses)
        problem = f"hull {geom.name!r} is on body {geom.body!r}, which is {place}"
        remedy = f"The nearest name of a body is {like!r}." if like else None
        raise AssetError(problem, where=str(self.asset.path), remedy=remedy)

    def _parent_volume(self, geom: Geom) -> float:
        """The volume that has the mass of a hull's parent: its own, or that of all hulls in its place."""
        if geom.parent not in self._owner:
            return 0.0
        shape = self.before.read_piece(self.before.names.index(geom.parent)).shape
        if shape is not None:
            return shape.volume
        return sum(other.shape.volume for other in self.asset.geoms if other.parent == geom.parent)

    def _plan_geoms(self) -> Iterator[GeomPlan]:
        """The geoms in MuJoCo's order: body by body, and in each in the order of the file."""
        of_body: dict[str, list[int]] = {body: [] for body in self.before.body_names}
        for k, body in enumerate(self.before.body_of):
            of_body[body].append(k)
        for body, numbers in of_body.items():
            for k in numbers:
                element, attribute = self._owner[self.before.names[k]], self.before.spec_geoms[k].name
                if element.own is not None:
                    can_name = not element.fixed and not attribute
                    yield GeomPlan(self.before.names[k], body, attribute, element.own if can_name else None)
                yield from self._plan_hulls(element.after)
            yield from self._plan_hulls(self.ends.get(body, []))

    def _plan_hulls(self, outputs: list[element_edits.OutputElement]) -> Iterator[GeomPlan]:
        for output in outputs:
            hull = self._hulls[id(output)]
            yield GeomPlan(hull.name, hull.body, "", output, hull)

    def _assign_names(self) -> dict[str, str]:
        """Name the new geoms, and those that would else read back under other names; the names that cannot be had."""
        taken = {geom.attribute for geom in self.geoms if geom.hull is None}
        for geom in self.geoms:
            if geom.hull is not None:
                _assign_name(geom, taken)
        for _ in range(_ROUNDS):
            read = zip(self.geoms, self.read_names(), strict=True)
            misread = [(geom, name) for geom, name in read if geom.name != name]
            taken = {geom.attribute for geom in self.geoms}
            named = [_assign_name(geom, taken) for geom, _ in misread]
            if not any(named):
                break
        return {geom.name: name for geom, name in misread}

    def read_names(self) -> list[str]:
        """Return the names that the geoms of the output read back as."""
        return geom_names([(geom.body, geom.attribute) for geom in self.geoms])


def _assign_name(geom: GeomPlan, taken: set[str]) -> bool:
    """Give an element a name under which its geom reads as wanted, if there is one that is free; take that."""
    for name in (geom.name.removeprefix(f"{geom.body}/"), geom.name):
        if geom.element is not None and name not in taken and name != geom.element.name:
            geom.attribute = geom.element.name = name
            taken.add(name)
            return True
    return False


def _refuse_referenced(tree: MjcfTree, removed: dict[str, str]) -> None:
    """Raise AssetError where something refers to a geom that is removed; its name attribute, the name of its hull."""
    for node in tree.root.walk():
        attributes = node.attributes
        names = [attributes.get(key) for key in _PLAIN]
        names += [attributes.get(key) for kind, key in _TYPED if attributes.get(kind) == "geom"]
        if name := next((name for name in names if name in removed), None):
            own = attributes.get("name")
            element = f"<{node.tag} name={own!r}>" if own else f"<{node.tag}>"
            problem = f"hull {removed[name]!r} cannot be removed: {element} refers to its geom {name!r}"
            remedy = "Take this element out of the file first, or leave the hull out of the edit."
            raise AssetError(problem, where=tree.where(node), remedy=remedy)
