"""Writing an edited URDF: the authored text with other collision elements, all else byte for byte as it was."""

from __future__ import annotations

from pathlib import Path

from meshforge.formats.base import Output
from meshforge.formats.collision_pieces import SourceMeshes, is_flat
from meshforge.formats.mesh_output import HullFiles
from meshforge.formats.references import Resolver, add_copy, note_absolute, placement
from meshforge.formats.slots import ElementMaker, ElementPlan, Slot, assign_names
from meshforge.formats.urdf import elements
from meshforge.formats.urdf.document import UrdfDocument, collisions, geometry_of, parse_robot, references
from meshforge.formats.xml import Element, Splice, XmlText, apply_splices, newline_of, set_attribute
from meshforge.geometry import Pose
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


class UrdfElementMaker(ElementMaker):
    """Makes elements for one document."""

    __slots__ = ()
    title = "URDF"

    def find_mesh(self, collision: Element) -> str | None:
        mesh = geometry_of(collision)
        return mesh.attributes.get("filename") if mesh is not None and mesh.tag == "mesh" else None

    def make_slot(self, geom: Geom, root_t_link: Pose, template: Element | None, lead: bytes) -> Slot:
        shape = geom.shape.move(root_t_link.inverse())
        if isinstance(shape, elements.UrdfShape):
            pose, tag = shape.pose, elements.native_tag(shape)
            edits = elements.replace_geometry(self.data, template, pose, tag) if template else ()
        else:
            pose, reference = Pose.identity(), self.make_mesh(geom, shape, template)
            tag = elements.mesh_tag(reference)
            edits = elements.replace_mesh(self.data, template, pose, reference) if template else ()
        if template:
            return Slot(geom.body, (geom.name,), None, template, edits, copy=True)
        return Slot(geom.body, (geom.name,), text=elements.build_collision(pose, tag, lead, self.line_end))

    def extract_piece(self, element: Element, name: str, k: int) -> tuple[Splice, ...]:
        mesh = geometry_of(element)
        assert mesh is not None  # only meshes have several pieces
        piece, made = self.make_piece(mesh.attributes["filename"], (), name, k)
        if piece.shape is None and is_flat(piece.vertices):
            self.notes.append(f"flat piece {name!r} stays, now in a file of its own, which MuJoCo refuses")
        return (set_attribute(self.data, mesh, "filename", made),)
