"""Writing an edited URDF: the authored text with other collision elements, all else byte for byte as it was."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable
from pathlib import Path

from meshforge.asset import Asset
from meshforge.errors import AssetError
from meshforge.formats.base import Output
from meshforge.formats.companions import companions
from meshforge.formats.hull_files import HullFiles, folder_of
from meshforge.formats.references import Resolver, placement
from meshforge.formats.urdf.document import UrdfDocument
from meshforge.formats.urdf.made import Maker
from meshforge.formats.urdf.plan import Plan
from meshforge.formats.urdf.robot import collisions, references, robot_of
from meshforge.formats.urdf.shapes import geometry_of
from meshforge.formats.urdf.slots import Slot, settle
from meshforge.formats.xml import Element, Splice, Text, indent, newline, removed, spliced


def write_urdf(asset: Asset, document: UrdfDocument, name: str) -> Output:
    """The files of an asset that was read from a URDF; without an edit, its own bytes.

    Raises AssetError: a hull on a link that is not there, or a mesh file that changed since the asset was read.
    """
    text = Text.of(document.source)
    robot = robot_of(text.data, str(asset.path))
    files = HullFiles(Path(name).stem, document.resolver)
    files.avoid(references(robot))
    maker = Maker(text.data, newline(text.data), files, _mesh_folder(robot))
    plan = Plan(asset, document, robot, maker)
    names = settle(plan.slots)
    data = spliced(text.data, _splices(plan))
    main = document.source if data == text.data else text.encoded(data)
    copies, far = _copies(robot_of(data, str(asset.path)), document.resolver)
    return Output(main, dict(files.made), copies, (*maker.notes, *far), names)


def _mesh_folder(robot: Element) -> str:
    """The folder of the first collision mesh, as its reference has it, where hulls of no mesh's kin go."""
    kinds = (geometry_of(collision) for _, collision in collisions(robot))
    meshes = (kind.attributes.get("filename") for kind in kinds if kind is not None and kind.tag == "mesh")
    return folder_of(next(meshes, None))


def _splices(plan: Plan) -> list[Splice]:
    data = plan.maker.data
    edits = [
        _in_place(data, element, slots)
        for element, slots in plan.places
        if not (len(slots) == 1 and slots[0].untouched)
    ]
    return edits + [_at_end(data, plan.links[link], slots) for link, slots in plan.ends.items()]


def _in_place(data: bytes, element: Element, slots: list[Slot]) -> Splice:
    """What stands in the place of an authored element; nothing takes its line away."""
    if not slots:
        return removed(data, element)
    return Splice(element.start, element.end, _joined(data, slots, indent(data, element.start)))


def _at_end(data: bytes, link: Element, slots: list[Slot]) -> Splice:
    """What is added at the end of a link."""
    line_end, before = newline(data), indent(data, link.start) or b""
    if link.children:
        last = link.children[-1]
        lead = indent(data, last.start)
        return Splice(last.end, last.end, (b"" if lead is None else line_end + lead) + _joined(data, slots, lead))
    lead = before + b"  "
    added = lead + _joined(data, slots, lead) + line_end
    if data[link.inside - 2 : link.inside] == b"/>":
        return Splice(link.inside - 2, link.inside, b">" + line_end + added + before + b"</link>")
    closing = data.rfind(b"</", link.inside, link.end)
    blanks = indent(data, closing)
    if blanks is None:
        return Splice(closing, closing, line_end + added + before)
    return Splice(closing - len(blanks), closing - len(blanks), added)


def _joined(data: bytes, slots: Iterable[Slot], lead: bytes | None) -> bytes:
    """Elements one after another, each on lines of its own where the first is."""
    gap = b"" if lead is None else newline(data) + lead
    return gap.join(slot.written(data) for slot in slots)


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
