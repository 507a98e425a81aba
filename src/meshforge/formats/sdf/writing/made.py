"""The collisions of made hulls: native where the file's version has the shape, else a mesh file of their own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from meshforge.asset import Geom
from meshforge.formats.collision_meshes import KeptMeshes
from meshforge.formats.element_names import attribute_for
from meshforge.formats.hull_files import HullFiles
from meshforge.formats.sdf.elements import Native, fresh, mesh_lines, native_lines, refiled, reshaped
from meshforge.formats.sdf.files.elements import geometry_of, mesh_uri
from meshforge.formats.sdf.files.version import ROUND, Version
from meshforge.formats.sdf.reading.shapes import chosen, mesh_part
from meshforge.formats.slots import Slot
from meshforge.formats.triangles import pieces_of
from meshforge.formats.xml import Element, Splice
from meshforge.geometry import Capsule, Ellipsoid, Piece, Polytope, Pose, Shape
from meshforge.words import counted


@dataclass(frozen=True, eq=False, slots=True)
class Maker:
    """Makes elements for one file; folder: a reference's folder for hulls whose parent has no mesh.

    meshes: the files that the document refers to, where one may have to be parted.
    """

    data: bytes
    line_end: bytes
    version: Version
    files: HullFiles
    folder: str = ""
    meshes: KeptMeshes | None = None
    notes: list[str] = field(default_factory=list)
    _pieces: dict[tuple[str, tuple[str, ...]], list[Piece]] = field(default_factory=dict)

    def make_slot(self, geom: Geom, root_t_link: Pose, template: Element | None, lead: bytes) -> Slot:
        shape = geom.shape.move(root_t_link.inverse())
        if isinstance(shape, Native) and (self.version >= ROUND or not isinstance(shape, Capsule | Ellipsoid)):
            pose, kind = shape.pose, native_lines(shape)
        else:
            pose, kind = Pose.identity(), mesh_lines(self._add_mesh(geom, shape, template))
        if template is None:
            slot = Slot(geom.body, (geom.name,), text=fresh(pose, kind, lead, self.line_end))
        else:
            edits = reshaped(self.data, template, pose, self._fit_lines(kind, template))
            slot = Slot(geom.body, (geom.name,), None, template, edits, copy=True)
        slot.name = attribute_for(slot)  # SDF asks for one
        return slot

    def extract_piece(self, element: Element, name: str, k: int) -> tuple[Splice, ...]:
        mesh, resolver = geometry_of(element), self.files.resolver
        assert mesh is not None and resolver is not None and self.meshes is not None  # only meshes have several pieces
        reference, part = mesh_uri(mesh), mesh_part(mesh)
        if (reference, part) not in self._pieces:
            surfaces = chosen(self.meshes.surfaces(reference, resolver), part)
            self._pieces[reference, part] = pieces_of(surfaces, name=reference)
        piece = self._pieces[reference, part][k]
        made = self.files.add(name, self.files.folder_of(reference), piece.vertices, piece.faces)
        return refiled(self.data, mesh, made)

    def _fit_lines(self, kind: Sequence[bytes], template: Element) -> Sequence[bytes]:
        """The lines of a shape; all in one where the template has its own in one."""
        old = geometry_of(template)
        assert old is not None  # only elements with pieces are copied
        return kind if b"\n" in self.data[old.start : old.end] else [b"".join(line.strip() for line in kind)]

    def _add_mesh(self, geom: Geom, shape: Shape, template: Element | None) -> str:
        """The reference to the mesh file of a hull, which is made."""
        if not isinstance(shape, Polytope):
            version = ".".join(map(str, self.version))
            corners = counted(len(shape.vertices), "vertex", "vertices")
            self.notes.append(f"SDF {version} has no {shape.kind}: {geom.name!r} is written as a hull of {corners}")
        mesh = geometry_of(template) if template else None
        beside = mesh_uri(mesh) if mesh is not None and mesh.tag == "mesh" else None
        folder = self.files.folder_of(beside) if beside else self.folder
        return self.files.add(geom.name, folder, shape.vertices, shape.faces)
