"""What an edit makes of each collision element: left alone, removed, split into the pieces that stay, joined by new
ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from meshforge.common import AssetError, nearest_name
from meshforge.formats.collision_pieces import CollisionElement, names_to_keep, new_hulls
from meshforge.formats.slots import Slot, append_elements, child_indent_of, replace_element
from meshforge.formats.xml import Element, Splice
from meshforge.geometry import Pose
from meshforge.symbolic import Asset, Geom


class ElementMaker(Protocol):
    """Makes elements for one document of a format; data: its text."""

    @property
    def data(self) -> bytes: ...

    def make_slot(self, geom: Geom, root_t_link: Pose, template: Element | None, lead: bytes) -> Slot:
        """The element of a hull; template: that of its parent, all but pose and geometry of which is inherited.

        lead: the blanks before an element without a template.
        """

    def extract_piece(self, element: Element, name: str, k: int) -> tuple[Splice, ...]:
        """The edits that leave of an element its k-th piece alone, triangles as authored; name: of that piece."""


class ElementPlan:
    """The collision elements of the output.

    places: each authored element, with what stands in its place; ends: what is added at the end of a link that has
    no collision element.
    """

    def __init__(
        self,
        asset: Asset,
        authored: Sequence[CollisionElement],
        elements: Sequence[Element],
        links: Mapping[str, Element],
        maker: ElementMaker,
    ) -> None:
        self.asset, self.authored, self.links, self.maker = asset, authored, links, maker
        self.places: list[tuple[Element, list[Slot]]] = []
        self.ends: dict[str, list[Slot]] = {}
        self._owner = {name: k for k, one in enumerate(authored) for name in one.names}
        self._elements = elements
        self._poses = asset.body_poses
        self._place_authored()
        for geom in new_hulls(asset, self._owner):
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
    def splices(self) -> list[Splice]:
        """The edits of the document's text."""
        data = self.maker.data
        edited = (place for place in self.places if not (len(place[1]) == 1 and place[1][0].is_untouched))
        edits = [replace_element(data, element, slots) for element, slots in edited]
        return edits + [append_elements(data, self.links[link], slots) for link, slots in self.ends.items()]

    def _place_authored(self) -> None:
        kept = names_to_keep(self.asset)
        for element, authored in zip(self._elements, self.authored, strict=True):
            staying = {k: name for k, name in enumerate(authored.names) if name in kept}
            if len(staying) == len(authored.names):
                slots = [Slot(authored.link, authored.names, element.attributes.get("name"), element)]
            else:
                slots = [self._split_element(element, authored.link, name, k) for k, name in staying.items()]
                for slot in slots[1:]:
                    slot.copy = True
            self.places.append((element, slots))

    def _split_element(self, element: Element, link: str, name: str, k: int) -> Slot:
        """An element for one piece of a mesh, its triangles as authored in a file of their own."""
        edits = self.maker.extract_piece(element, name, k)
        return Slot(link, (name,), element.attributes.get("name"), element, edits)

    def _place_made(self, geom: Geom) -> None:
        """A new element after that of its parent, or else after the last one of its link."""
        link = self._link_of(geom)
        own = [k for k, authored in enumerate(self.authored) if authored.link == geom.body]
        parent = self._owner.get(geom.parent or "")
        template = self._elements[parent] if parent is not None else None
        lead = child_indent_of(self.maker.data, link)
        slot = self.maker.make_slot(geom, self._poses[geom.body], template, lead)
        if not own:
            self.ends.setdefault(geom.body, []).append(slot)
        else:
            self.places[parent if parent in own else own[-1]][1].append(slot)

    def _link_of(self, geom: Geom) -> Element:
        if geom.body in self.links:
            return self.links[geom.body]
        like = nearest_name(geom.body, self.links)
        raise AssetError(
            f"hull {geom.name!r} is on link {geom.body!r}, which is not there",
            where=str(self.asset.path),
            remedy=f"The nearest name of a link is {like!r}." if like else None,
        )
