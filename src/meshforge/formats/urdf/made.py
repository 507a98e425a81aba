"""The collision elements of made hulls: native where URDF has the shape, else a mesh file of their own."""

from __future__ import annotations

from dataclasses import dataclass, field

from meshforge.asset import Geom
from meshforge.formats.collision_meshes import KeptMeshes
from meshforge.formats.hull_files import HullFiles
from meshforge.formats.mesh_parts import is_flat
from meshforge.formats.slots import Slot
from meshforge.formats.triangles import pieces_of
from meshforge.formats.urdf.elements import fresh, mesh_tag, native_tag, refiled, remeshed, reshaped
from meshforge.formats.urdf.shapes import geometry_of
from meshforge.formats.xml import Element, Splice
from meshforge.geometry import Box, Cylinder, Piece, Polytope, Pose, Shape, Sphere


@dataclass(frozen=True, eq=False, slots=True)
class Maker:
    """Makes elements for one document; folder: a reference's folder for hulls whose parent has no mesh.

    meshes: the files that the document refers to, where one may have to be parted.
    """

    data: bytes
    line_end: bytes
    files: HullFiles
    folder: str = ""
    meshes: KeptMeshes | None = None
    notes: list[str] = field(default_factory=list)
    _pieces: dict[str, list[Piece]] = field(default_factory=dict)

    def make_slot(self, geom: Geom, root_t_link: Pose, template: Element | None, lead: bytes) -> Slot:
        """The element of a hull; template: that of its parent, all but pose and geometry of which is inherited.

        lead: the blanks before an element without a template.
        """
        shape = geom.shape.move(root_t_link.inverse())
        if isinstance(shape, Box | Cylinder | Sphere):
            pose, tag = shape.pose, native_tag(shape)
            edits = reshaped(self.data, template, pose, tag) if template else ()
        else:
            pose, reference = Pose.identity(), self._add_mesh(geom, shape, template)
            tag = mesh_tag(reference)
            edits = remeshed(self.data, template, pose, reference) if template else ()
        if template:
            return Slot(geom.body, (geom.name,), None, template, edits, copy=True)
        return Slot(geom.body, (geom.name,), text=fresh(pose, tag, lead, self.line_end))

    def extract_piece(self, element: Element, name: str, k: int) -> tuple[Splice, ...]:
        mesh, resolver = geometry_of(element), self.files.resolver
        assert mesh is not None and resolver is not None and self.meshes is not None  # only meshes have several pieces
        reference = mesh.attributes["filename"]
        if reference not in self._pieces:
            self._pieces[reference] = pieces_of(self.meshes.surfaces(reference, resolver), name=reference)
        piece = self._pieces[reference][k]
        made = self.files.add(name, self.files.folder_of(reference), piece.vertices, piece.faces)
        if piece.shape is None and is_flat(piece.vertices):
            self.notes.append(f"flat piece {name!r} stays, now in a file of its own, which MuJoCo refuses")
        return refiled(self.data, element, made)

    def _add_mesh(self, geom: Geom, shape: Shape, template: Element | None) -> str:
        """The reference to the mesh file of a hull, which is made."""
        if not isinstance(shape, Polytope):
            self.notes.append(
                f"URDF has no {shape.kind}: {geom.name!r} is written as a hull of {len(shape.vertices)} vertices"
            )
        mesh = geometry_of(template) if template else None
        beside = mesh.attributes.get("filename") if mesh is not None and mesh.tag == "mesh" else None
        folder = self.files.folder_of(beside) if beside else self.folder
        return self.files.add(geom.name, folder, shape.vertices, shape.faces)
