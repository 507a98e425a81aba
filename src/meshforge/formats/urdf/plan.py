"""What an edit makes of each collision element: left alone, removed, parted into its kept pieces, joined by new."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from meshforge.asset import Asset, Geom
from meshforge.errors import AssetError, nearest
from meshforge.formats.hull_files import folder_of
from meshforge.formats.mesh_parts import is_flat
from meshforge.formats.slots import Slot, lead_inside
from meshforge.formats.triangles import pieces_of, read_triangles
from meshforge.formats.urdf.document import UrdfDocument, digest_of
from meshforge.formats.urdf.elements import refiled
from meshforge.formats.urdf.made import Maker
from meshforge.formats.urdf.robot import collisions
from meshforge.formats.urdf.shapes import geometry_of
from meshforge.formats.xml import Element
from meshforge.geometry import Piece


class Plan:
    """The collision elements of the output.

    places: each authored element, with what stands in its place; ends: what is added at the end of a link that has
    no collision element.
    """

    def __init__(self, asset: Asset, document: UrdfDocument, robot: Element, maker: Maker) -> None:
        self.asset, self.document, self.maker = asset, document, maker
        self.links: Mapping[str, Element] = {link.attributes["name"]: link for link in robot.each("link")}
        self.places: list[tuple[Element, list[Slot]]] = []
        self.ends: dict[str, list[Slot]] = {}
        self._pieces: dict[Path, list[Piece]] = {}
        self._owner = {name: k for k, authored in enumerate(document.authored) for name in authored.names}
        self._elements = [element for _, element in collisions(robot)]
        self._place_authored()
        for geom in asset.geoms:
            if geom.parent is not None or geom.name not in self._owner:
                self._place_made(geom)

    @property
    def slots(self) -> list[Slot]:
        """All collision elements in the order of the output."""
        by_link: dict[str, list[Slot]] = {name: [] for name in self.links}
        for (_, slots), authored in zip(self.places, self.document.authored, strict=True):
            by_link[authored.link] += slots
        for link, slots in self.ends.items():
            by_link[link] += slots
        return [slot for slots in by_link.values() for slot in slots]

    def _place_authored(self) -> None:
        kept = {g.name for g in self.asset.geoms if g.parent is None} | {o.name for o in self.asset.opaque}
        for element, authored in zip(self._elements, self.document.authored, strict=True):
            staying = {k: name for k, name in enumerate(authored.names) if name in kept}
            if len(staying) == len(authored.names):
                slots = [Slot(authored.link, authored.names, element.attributes.get("name"), element)]
            else:
                slots = [self._parted(element, authored.link, name, k) for k, name in staying.items()]
                for slot in slots[1:]:
                    slot.copy = True
            self.places.append((element, slots))

    def _parted(self, element: Element, link: str, name: str, k: int) -> Slot:
        """An element for one piece of a mesh, its triangles as authored in a file of their own."""
        mesh = geometry_of(element)
        assert mesh is not None  # only meshes have several pieces
        reference = mesh.attributes["filename"]
        piece = self._pieces_in(reference)[k]
        made = self.maker.files.add(name, folder_of(reference), piece.vertices, piece.faces)
        if piece.shape is None and is_flat(piece.vertices):
            self.maker.notes.append(f"flat piece {name!r} stays, now in a file of its own, which MuJoCo refuses")
        edits = refiled(self.maker.data, element, made)
        return Slot(link, (name,), element.attributes.get("name"), element, edits)

    def _pieces_in(self, reference: str) -> list[Piece]:
        """The pieces of a mesh file as they were when the asset was read. Raises AssetError where it has changed."""
        path = self.document.resolver.find(reference)
        if path is None or digest_of(path) != dict(self.document.digests).get(path):
            raise AssetError(
                f"the mesh {reference!r} has changed since the asset was read",
                where=str(self.asset.path),
                remedy="Read the asset again.",
            )
        if path not in self._pieces:
            self._pieces[path] = pieces_of(read_triangles(path), name=str(path))
        return self._pieces[path]

    def _place_made(self, geom: Geom) -> None:
        """A new element after that of its parent, or else after the last one of its link."""
        link = self._link_of(geom)
        own = [k for k, authored in enumerate(self.document.authored) if authored.link == geom.body]
        parent = self._owner.get(geom.parent or "")
        template = self._elements[parent] if parent is not None else None
        lead = lead_inside(self.maker.data, link)
        slot = self.maker.slot(geom, self.asset.body_poses[geom.body], template, lead)
        if not own:
            self.ends.setdefault(geom.body, []).append(slot)
        else:
            self.places[parent if parent in own else own[-1]][1].append(slot)

    def _link_of(self, geom: Geom) -> Element:
        if geom.body in self.links:
            return self.links[geom.body]
        like = nearest(geom.body, self.links)
        raise AssetError(
            f"hull {geom.name!r} is on link {geom.body!r}, which is not there",
            where=str(self.asset.path),
            remedy=f"The nearest name of a link is {like!r}." if like else None,
        )
