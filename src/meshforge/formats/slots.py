"""The collision elements of an edited description before they are text, authored, copied or new: what an edit makes
of each (left alone, removed, split, joined by new ones), what they are called, and where they go."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from meshforge.common import AssetError, nearest_name, pluralize
from meshforge.formats import collision_pieces, mesh_output, xml
from meshforge.geometry import Piece, Polytope, Pose, Shape
from meshforge.symbolic import Asset, Geom, unique_names

_MADE_UP = re.compile(r"geom\d+(#\d+)?(@\d+)?(~\d+)*")  # what a collision without a name is called, and hulls after it
_TAG = re.compile(rb"<([^\s/>]+)")


@dataclass(slots=True, eq=False)
class Slot:
    """One element of the output that holds collision geometry.

    names: what its pieces must read back as; name: its name attribute; source: the authored element that it is, or is
    copied from with `edits`; a copy leaves the comments out. text: of an element without a source.
    """

    body: str
    names: tuple[str, ...]
    name: str | None = None
    source: xml.Element | None = None
    edits: tuple[xml.Splice, ...] = ()
    copy: bool = False
    text: bytes = b""

    @property
    def is_untouched(self) -> bool:
        """Whether it is an element of the file to which nothing is done."""
        same_name = self.source is not None and self.name == self.source.attributes.get("name")
        return same_name and not self.edits and not self.copy

    def to_bytes(self, data: bytes) -> bytes:
        """Its text; data: the authored document."""
        if self.source is None:
            tag = _TAG.match(self.text)
            assert tag is not None  # a text is an element
            element = xml.Element(tag[1].decode(), {}, line=0, start=0, inside=tag.end())
            return xml.apply_splices(self.text, [xml.set_attribute(self.text, element, "name", self.name)])
        edits = self.edits
        if self.name != self.source.attributes.get("name"):
            edits = (xml.set_attribute(data, self.source, "name", self.name), *edits)
        text = xml.apply_splices(data, edits, self.source.start, self.source.end)
        return xml.strip_comments(text) if self.copy else text


@dataclass(frozen=True, eq=False, slots=True)
class ElementMaker(ABC):
    """Makes elements for one file of a format; data: its text; folder: for hulls whose parent has no mesh.

    meshes: the files that the document refers to, where one may have to be split.
    """

    data: bytes
    line_end: bytes
    files: mesh_output.HullFiles
    folder: str = ""
    meshes: collision_pieces.SourceMeshes | None = None
    notes: list[str] = field(default_factory=list)

    @property
    @abstractmethod
    def title(self) -> str:
        """The format, as notes name it."""

    @abstractmethod
    def find_mesh(self, collision: xml.Element) -> str | None:
        """The reference of a collision's mesh, None where it has another geometry or none."""

    @abstractmethod
    def make_slot(self, geom: Geom, root_t_link: Pose, template: xml.Element | None, lead: bytes) -> Slot:
        """The element of a hull; template: that of its parent, all but pose and geometry of which is inherited.

        lead: the blanks before an element without a template.
        """

    @abstractmethod
    def extract_piece(self, element: xml.Element, name: str, k: int) -> tuple[xml.Splice, ...]:
        """The edits that leave of an element its k-th piece alone, triangles as authored; name: of that piece."""

    def explain_hull(self, shape: Shape) -> str:
        """Why a native shape is written as a hull."""
        return f"{self.title} has no {shape.kind}"

    def make_piece(self, reference: str, part: tuple[str, ...], name: str, k: int) -> tuple[Piece, str]:
        """The k-th piece of a mesh, or of a part of it, and the reference to a file of its own, which is made."""
        assert self.files.resolver is not None and self.meshes is not None  # only meshes have several pieces
        piece = self.meshes.pieces(reference, self.files.resolver, part)[k]
        return piece, self.files.add(name, self.files.folder_of(reference), piece.vertices, piece.faces)

    def make_mesh(self, geom: Geom, shape: Shape, template: xml.Element | None) -> str:
        """The reference to the mesh file of a hull, which is made."""
        if not isinstance(shape, Polytope):
            corners = pluralize(len(shape.vertices), "vertex", "vertices")
            self.notes.append(f"{self.explain_hull(shape)}: {geom.name!r} is written as a hull of {corners}")
        beside = self.find_mesh(template) if template else None
        folder = self.files.folder_of(beside) if beside else self.folder
        return self.files.add(geom.name, folder, shape.vertices, shape.faces)


class ElementPlan:
    """The collision elements of the output.

    places: each authored element, with what stands in its place; ends: what is added at the end of a link that has
    no collision element.
    """

    def __init__(
        self,
        asset: Asset,
        authored: Sequence[collision_pieces.CollisionElement],
        elements: Sequence[xml.Element],
        links: Mapping[str, xml.Element],
        maker: ElementMaker,
    ) -> None:
        self.asset, self.authored, self.links, self.maker = asset, authored, links, maker
        self.places: list[tuple[xml.Element, list[Slot]]] = []
        self.ends: dict[str, list[Slot]] = {}
        self._owner = {name: k for k, one in enumerate(authored) for name in one.names}
        self._elements = elements
        self._poses = asset.body_poses
        self._place_authored()
        for geom in collision_pieces.new_hulls(asset, self._owner):
            refuse_unknown_link(geom, links, str(asset.path))
            self._place_made(geom)

    @property
    def slots(self) -> list[Slot]:
        """All collision elements in the order of the output."""
        by_link: dict[str, list[Slot]] = {name: [] for name in self.links}
        for (_, slots), authored in zip(self.places, self.authored, strict=True):
            by_link[authored.link] += slots
        for link, slots in self.ends.items():
            by_link[link] += slots
        return [slot for slots in by_link.values() for slot in slots]

    @property
    def splices(self) -> list[xml.Splice]:
        """The edits of the document's text."""
        data = self.maker.data
        edited = (place for place in self.places if not (len(place[1]) == 1 and place[1][0].is_untouched))
        edits = [replace_element(data, element, slots) for element, slots in edited]
        return edits + [append_elements(data, self.links[link], slots) for link, slots in self.ends.items()]

    def _place_authored(self) -> None:
        kept = collision_pieces.names_to_keep(self.asset)
        for element, authored in zip(self._elements, self.authored, strict=True):
            staying = {k: name for k, name in enumerate(authored.names) if name in kept}
            if len(staying) == len(authored.names):
                slots = [Slot(authored.link, authored.names, element.attributes.get("name"), element)]
            else:
                slots = []  # an element for each piece, its triangles as authored in a file of their own
                for k, name in staying.items():
                    edits, old = self.maker.extract_piece(element, name, k), element.attributes.get("name")
                    slots.append(Slot(authored.link, (name,), old, element, edits, copy=bool(slots)))
            self.places.append((element, slots))

    def _place_made(self, geom: Geom) -> None:
        """A new element after that of its parent, or else after the last one of its link."""
        own = [k for k, authored in enumerate(self.authored) if authored.link == geom.body]
        parent = self._owner.get(geom.parent or "")
        template = self._elements[parent] if parent is not None else None
        lead = child_indent_of(self.maker.data, self.links[geom.body])
        slot = self.maker.make_slot(geom, self._poses[geom.body], template, lead)
        if not own:
            self.ends.setdefault(geom.body, []).append(slot)
        else:
            self.places[parent if parent in own else own[-1]][1].append(slot)


def refuse_unknown_link(geom: Geom, links: Collection[str], where: str) -> None:
    """Raise AssetError for a hull on a link that is not there."""
    if geom.body not in links:
        like = nearest_name(geom.body, links)
        raise AssetError(
            f"hull {geom.name!r} is on link {geom.body!r}, which is not there",
            where=where,
            remedy=f"The nearest name of a link is {like!r}." if like else None,
        )


def replace_element(data: bytes, element: xml.Element, slots: Sequence[Slot]) -> xml.Splice:
    """What stands in the place of an authored element; nothing takes its line away."""
    if not slots:
        return xml.remove_element(data, element)
    return xml.Splice(element.start, element.end, _join_slots(data, slots, xml.indent_of(data, element.start)))


def append_elements(data: bytes, parent: xml.Element, slots: Sequence[Slot]) -> xml.Splice:
    """What is added at the end of an element."""
    line_end, before = xml.newline_of(data), xml.indent_of(data, parent.start) or b""
    if parent.children:
        last = parent.children[-1]
        lead = xml.indent_of(data, last.start)
        return xml.Splice(
            last.end, last.end, (b"" if lead is None else line_end + lead) + _join_slots(data, slots, lead)
        )
    lead = before + b"  "
    added = lead + _join_slots(data, slots, lead) + line_end
    if data[parent.inside - 2 : parent.inside] == b"/>":
        closing_tag = b"</%s>" % parent.tag.encode()
        return xml.Splice(parent.inside - 2, parent.inside, b">" + line_end + added + before + closing_tag)
    closing = data.rfind(b"</", parent.inside, parent.end)
    blanks = xml.indent_of(data, closing)
    if blanks is None:
        return xml.Splice(closing, closing, line_end + added + before)
    return xml.Splice(closing - len(blanks), closing - len(blanks), added)


def child_indent_of(data: bytes, parent: xml.Element) -> bytes:
    """The blanks before the children of an element."""
    if parent.children:
        return xml.indent_of(data, parent.children[-1].start) or b""
    return (xml.indent_of(data, parent.start) or b"") + b"  "


def _join_slots(data: bytes, slots: Iterable[Slot], lead: bytes | None) -> bytes:
    gap = b"" if lead is None else xml.newline_of(data) + lead
    return gap.join(slot.to_bytes(data) for slot in slots)


def name_element_pieces(elements: Sequence[tuple[str | None, str | None, int]]) -> list[tuple[str, ...]]:
    """The names that the pieces of collision elements read as; for each element its link, own name and pieces.

    `link/name`, without a link for None; `geomK` for the K-th element of a link where it has no name; `#k` for one of
    several pieces.
    """
    count: dict[str | None, int] = {}
    bases = []
    for link, name, _ in elements:
        own = name or f"geom{count.get(link, 0)}"
        bases.append(own if link is None else f"{link}/{own}")
        count[link] = count.get(link, 0) + 1
    return collision_pieces.name_pieces(zip(unique_names(bases), (pieces for _, _, pieces in elements), strict=True))


def name_elements(
    found: Iterable[tuple[str, xml.Element]], pieces: Iterable[int]
) -> tuple[collision_pieces.CollisionElement, ...]:
    """Collisions with the names of their pieces; found: of each its link and its element; pieces: how many it has."""
    own = [(link, e.attributes.get("name"), count) for (link, e), count in zip(found, pieces, strict=True)]
    named = zip(own, name_element_pieces(own), strict=True)
    return tuple(collision_pieces.CollisionElement(link, names) for (link, _, _), names in named)


def assign_names(slots: Sequence[Slot], *, unique: bool = False) -> dict[str, str]:
    """Name the elements, given in the order of the output, that would else read back under other names.

    unique: whether a name that MeshForge made up is left out where another element of the file has it, as some engines
    want names unique in the file. Returns the names that cannot be had all the same, with what they read back as: a
    hull of a format whose names do not begin with the body, or an element that its author called like a piece of
    another.
    """
    for _ in range(4):
        for slot, _names in _find_misread(slots):
            slot.name = name_attribute_of(slot)
    authored = {slot.source.attributes.get("name") for slot in slots if slot.source is not None and not slot.copy}
    taken = set[str | None]()
    for slot in slots if unique else ():
        is_own = slot.source is not None and not slot.copy and slot.name == slot.source.attributes.get("name")
        if slot.name and not is_own and _MADE_UP.fullmatch(slot.name) and slot.name in taken | authored:
            slot.name = None
        taken.add(slot.name)
    return {
        wanted: name for slot, names in _find_misread(slots) for wanted, name in zip(slot.names, names, strict=True)
    }


def _find_misread(slots: Sequence[Slot]) -> list[tuple[Slot, tuple[str, ...]]]:
    read = name_element_pieces([(slot.body, slot.name, len(slot.names)) for slot in slots])
    return [(slot, names) for slot, names in zip(slots, read, strict=True) if names != slot.names]


def name_attribute_of(slot: Slot) -> str:
    """The name attribute under which a slot's pieces have their names."""
    return own_name_of(slot.names, slot.body)


def own_name_of(names: tuple[str, ...], body: str | None) -> str:
    """The name of an element whose pieces are to have names: that of the first, without body and `#0`."""
    name = names[0].removeprefix(f"{body}/")
    return name if len(names) == 1 else name.removesuffix("#0")
