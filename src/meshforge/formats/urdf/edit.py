"""Writing an edited URDF: the authored text with other collision elements, all else byte for byte as it was."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from meshforge.formats.base import Output
from meshforge.formats.collision_pieces import SourceMeshes, is_flat
from meshforge.formats.mesh_output import HullFiles
from meshforge.formats.mesh_reader import split_into_pieces
from meshforge.formats.references import Resolver, add_copy, note_absolute, placement
from meshforge.formats.slots import ElementPlan, Slot, assign_names
from meshforge.formats.urdf import elements
from meshforge.formats.urdf.document import UrdfDocument, collisions, geometry_of, parse_robot, references
from meshforge.formats.xml import Element, Splice, XmlText, apply_splices, newline_of
from meshforge.geometry import Box, Cylinder, Piece, Polytope, Pose, Shape, Sphere
from meshforge.symbolic import Asset, Geom


def write_urdf(asset: Asset, document: UrdfDocument, name: str) -> Output:
    """The files of an asset that was read from a URDF; without an edit, its own bytes.

    Raises AssetError: a hull on a link that is not there, or a mesh file that changed since the asset was read.
    """
    text = XmlText.of(document.source)
    robot = parse_robot(text.data, str(asset.path))
    files = HullFiles(Path(name).stem, document.resolver)
    files.avoid(references(robot))
    meshes = SourceMeshes(document.digests, str(asset.path))
    maker = UrdfElementMaker(text.data, newline_of(text.data), files, files.folder_of(_find_first_mesh(robot)), meshes)
    links = {link.attributes["name"]: link for link in robot.each("link")}
    plan = ElementPlan(asset, document.authored, [element for _, element in collisions(robot)], links, maker)
    names = assign_names(plan.slots)
    data = apply_splices(text.data, plan.splices)
    main = document.source if data == text.data else text.encode(data)
    copies, far = _list_copies(parse_robot(data, str(asset.path)), document.resolver)
    return Output(main, dict(files.made), copies, (*maker.notes, *far), names)


def _find_first_mesh(robot: Element) -> str | None:
    """The reference of the first collision mesh, in whose folder hulls of no mesh's kin go."""
    kinds = (geometry_of(collision) for _, collision in collisions(robot))
    meshes = (kind.attributes.get("filename") for kind in kinds if kind is not None and kind.tag == "mesh")
    return next(meshes, None)


def _list_copies(robot: Element, resolver: Resolver) -> tuple[dict[str, Path], list[str]]:
    """The input files that the output refers to, by where they go; and notes on those that stay where they are."""
    copies: dict[str, Path] = {}
    notes = []
    for reference in references(robot):
        place, path = placement(reference), resolver.find(reference)
        if path is None:  # made, or missing from the start
            continue
        if place is None:
            notes.append(note_absolute(reference))
        else:
            add_copy(copies, place, path, "Rename one of them, or put both under one package root.")
    return copies, notes


@dataclass(frozen=True, eq=False, slots=True)
class UrdfElementMaker:
    """Makes elements for one document; folder: a reference's folder for hulls whose parent has no mesh.

    meshes: the files that the document refers to, where one may have to be split.
    """

    data: bytes
    line_end: bytes
    files: HullFiles
    folder: str = ""
    meshes: SourceMeshes | None = None
    notes: list[str] = field(default_factory=list)
    _pieces: dict[str, list[Piece]] = field(default_factory=dict)

    def make_slot(self, geom: Geom, root_t_link: Pose, template: Element | None, lead: bytes) -> Slot:
        """The element of a hull; template: that of its parent, all but pose and geometry of which is inherited.

        lead: the blanks before an element without a template.
        """
        shape = geom.shape.move(root_t_link.inverse())
        if isinstance(shape, Box | Cylinder | Sphere):
            pose, tag = shape.pose, elements.native_tag(shape)
            edits = elements.replace_geometry(self.data, template, pose, tag) if template else ()
        else:
            pose, reference = Pose.identity(), self._add_mesh(geom, shape, template)
            tag = elements.mesh_tag(reference)
            edits = elements.replace_mesh(self.data, template, pose, reference) if template else ()
        if template:
            return Slot(geom.body, (geom.name,), None, template, edits, copy=True)
        return Slot(geom.body, (geom.name,), text=elements.build_collision(pose, tag, lead, self.line_end))

    def extract_piece(self, element: Element, name: str, k: int) -> tuple[Splice, ...]:
        mesh, resolver = geometry_of(element), self.files.resolver
        assert mesh is not None and resolver is not None and self.meshes is not None  # only meshes have several pieces
        reference = mesh.attributes["filename"]
        if reference not in self._pieces:
            self._pieces[reference] = split_into_pieces(self.meshes.surfaces(reference, resolver), name=reference)
        piece = self._pieces[reference][k]
        made = self.files.add(name, self.files.folder_of(reference), piece.vertices, piece.faces)
        if piece.shape is None and is_flat(piece.vertices):
            self.notes.append(f"flat piece {name!r} stays, now in a file of its own, which MuJoCo refuses")
        return elements.replace_mesh_file(self.data, element, made)

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
