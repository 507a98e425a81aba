"""Writing an edited URDF: the authored text with other collision elements, all else byte for byte as it was."""

from __future__ import annotations

import posixpath
from pathlib import Path

from meshforge.asset import Asset
from meshforge.errors import AssetError
from meshforge.formats.base import Output
from meshforge.formats.collision_meshes import KeptMeshes
from meshforge.formats.companions import companions
from meshforge.formats.element_names import settle
from meshforge.formats.element_plan import Plan
from meshforge.formats.hull_files import HullFiles
from meshforge.formats.references import Resolver, placement
from meshforge.formats.urdf.document import UrdfDocument
from meshforge.formats.urdf.made import Maker
from meshforge.formats.urdf.robot import collisions, references, robot_of
from meshforge.formats.urdf.shapes import geometry_of
from meshforge.formats.xml import Element, Text, newline, spliced


def write_urdf(asset: Asset, document: UrdfDocument, name: str) -> Output:
    """The files of an asset that was read from a URDF; without an edit, its own bytes.

    Raises AssetError: a hull on a link that is not there, or a mesh file that changed since the asset was read.
    """
    text = Text.of(document.source)
    robot = robot_of(text.data, str(asset.path))
    files = HullFiles(Path(name).stem, document.resolver)
    files.avoid(references(robot))
    meshes = KeptMeshes(document.digests, str(asset.path))
    maker = Maker(text.data, newline(text.data), files, files.folder_of(_first_mesh(robot)), meshes)
    links = {link.attributes["name"]: link for link in robot.each("link")}
    plan = Plan(asset, document.authored, [element for _, element in collisions(robot)], links, maker)
    names = settle(plan.slots)
    data = spliced(text.data, plan.splices)
    main = document.source if data == text.data else text.encode(data)
    copies, far = _copies(robot_of(data, str(asset.path)), document.resolver)
    return Output(main, dict(files.made), copies, (*maker.notes, *far), names)


def _first_mesh(robot: Element) -> str | None:
    """The reference of the first collision mesh, in whose folder hulls of no mesh's kin go."""
    kinds = (geometry_of(collision) for _, collision in collisions(robot))
    meshes = (kind.attributes.get("filename") for kind in kinds if kind is not None and kind.tag == "mesh")
    return next(meshes, None)


def _copies(robot: Element, resolver: Resolver) -> tuple[dict[str, Path], list[str]]:
    """The input files that the output refers to, by where they go; and notes on those that stay where they are."""
    copies: dict[str, Path] = {}
    notes = []
    for reference in references(robot):
        place, path = placement(reference), resolver.find(reference)
        if path is None:  # made, or missing from the start
            continue
        if place is None:
            notes.append(f"{reference!r} is an absolute reference: the file is used where it is, not copied")
            continue
        if copies.setdefault(place, path) != path:
            raise AssetError(
                f"{copies[place]} and {path} would both become {place!r}",
                where=str(path),
                remedy="Rename one of them, or put both under one package root.",
            )
        for key, companion in companions(path).items():
            copies.setdefault(posixpath.normpath(posixpath.join(posixpath.dirname(place), key)), companion)
    return copies, notes
