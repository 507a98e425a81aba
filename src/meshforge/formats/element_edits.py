"""The collision elements of an edited description before they are text: authored, copied or new, named and placed."""

import re
from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from meshforge.common import AssetError, nearest_name, pluralize
from meshforge.formats import collision_pieces, mesh_output, xml
from meshforge.formats.link_reader import CollisionMeshes, geometry_of
from meshforge.formats.references import reference_of
from meshforge.geometry import Floats, Piece, Polytope, Pose, Shape
from meshforge.symbolic import Asset, Geom, NonConvexPiece, Surface

_MADE_UP = re.compile(r"geom\d+(#\d+)?(@\d+)?(~\d+)*")  # what a collision without a name is called, and hulls after it
_TAG = re.compile(rb"<([^\s/>]+)")


@dataclass(slots=True, eq=False)
class OutputElement:
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
        """Return its text; data: the authored document."""
        if self.source is None:
            tag = _TAG.match(self.text)
            assert tag is not None  # a text is an element
            element = xml.Element(tag[1].decode(), {}, line=0, start=0, inside=tag.end())
            return xml.apply_splices(self.text, [xml.set_attribute(self.text, element, "name", self.name)])
        edits = self.edits
        if self.name != self.source.attributes.get("name"):
            edits = (xml.set_attribute(data, self.source, "name", self.name), *edits)
        text = xml.apply_splices(data, edits, self.source.start, self.source.end)
        return xml.COMMENT.sub(b"", text) if self.copy else text


@dataclass(eq=False)
class ElementMaker(ABC):
    """Makes elements for one file of a format; title: as notes name that; data: the text of the file.

    folder: for hulls whose parent has no mesh; meshes: the files of the document, of which one may be split.
    """

    title: str
    data: bytes
    files: mesh_output.HullFiles
    folder: str = ""
    meshes: CollisionMeshes | None = None
    notes: list[str] = field(default_factory=list)

    @abstractmethod
    def native_lines(self, shape: Shape) -> tuple[Pose, list[bytes]] | None:
        """Return the pose of a shape that the format has of its own, and its lines without that; None for others."""

    @abstractmethod
    def mesh_lines(self, reference: str, scale: Floats | None = None) -> list[bytes]:
        """Return the lines of a mesh file in metres, which factors (3,) may scale."""

    @abstractmethod
    def pose_tag(self, pose: Pose) -> bytes:
        """Return the element of a pose, its numbers in full precision."""

    def geometry_lines(self, pose: Pose, kind: Sequence[bytes]) -> list[bytes]:
        """Return the lines of a pose and of a geometry, whose own lines are `kind`."""
        return [self.pose_tag(pose), *xml.nest("geometry", *kind)]

    def build_collision(self, pose: Pose, kind: Sequence[bytes], lead: bytes) -> bytes:
        """Return a `<collision>` without a name, whose lines but the first are indented by `lead`."""
        return (xml.newline_of(self.data) + lead).join(xml.nest("collision", *self.geometry_lines(pose, kind)))

    @abstractmethod
    def replace_geometry(
        self, collision: xml.Element, pose: Pose, kind: Sequence[bytes], reference: str | None
    ) -> tuple[xml.Splice, ...]:
        """Return the edits that give a copy of a collision another pose and geometry, all else of it being inherited.

        reference: of a mesh.
        """

    @abstractmethod
    def extract_piece(self, element: xml.Element, name: str, k: int) -> tuple[xml.Splice, ...]:
        """Return the edits that leave of an element its k-th piece alone, as authored; name: of that piece."""

    def explain_hull(self, shape: Shape) -> str:
        """Return why a native shape is written as a hull."""
        return f"{self.title} has no {shape.kind}"

    def make_element(self, geom: Geom, root_t_link: Pose, template: xml.Element | None, lead: bytes) -> OutputElement:
        """Return the element of a hull; template: that of its parent, all but pose and geometry of which is inherited.

        lead: the blanks before an element without a template.
        """
        shape = geom.shape.move(root_t_link.inverse())
        native = self.native_lines(shape)
        reference = None if native else self._make_mesh(geom, shape, template)
        pose, kind = native or (Pose.identity(), self.mesh_lines(reference or ""))
        if template is None:
            return OutputElement(geom.body, (geom.name,), text=self.build_collision(pose, kind, lead))
        edits = self.replace_geometry(template, pose, kind, reference)
        return OutputElement(geom.body, (geom.name,), None, template, edits, copy=True)

    def make_surface(self, piece: NonConvexPiece, root_t_link: Pose, surface: Surface, lead: bytes) -> OutputElement:
        """Return the element of a non-convex surface as it is."""
        vertices = root_t_link.inverse().apply(np.asarray(surface.vertices))
        kind = self.mesh_lines(self.files.add(piece.name, "", vertices, surface.faces))
        return OutputElement(piece.body, (piece.name,), text=self.build_collision(Pose.identity(), kind, lead))

    def make_piece(self, reference: str, part: tuple[str, ...], name: str, k: int) -> tuple[Piece, str]:
        """Return the k-th piece of a mesh, or of a part of it, and the reference to a file that is made of it."""
        assert self.files.resolver is not None and self.meshes is not None  # only meshes have several pieces
        path = self.files.resolver.find(reference)
        if path is None:
            raise collision_pieces.change_error(f"the mesh {reference!r}", reference)
        piece = self.meshes.pieces(path, part)[k]
        return piece, self.files.add(name, self.files.folder_of(reference), piece.vertices, piece.faces)

    def find_folder(self, collisions: Iterable[xml.Element]) -> str:
        """Return the folder of the first mesh of some collisions, in which hulls go whose parents have none."""
        meshes = (kind for element in collisions if (kind := geometry_of(element)) and kind.tag == "mesh")
        first = next(meshes, None)
        return self.files.folder_of(reference_of(first) if first else None)

    def _make_mesh(self, geom: Geom, shape: Shape, template: xml.Element | None) -> str:
        if not isinstance(shape, Polytope):
            corners = pluralize(len(shape.vertices), "vertex", "vertices")
            self.notes.append(f"{self.explain_hull(shape)}: {geom.name!r} is written as a hull of {corners}")
        own = geometry_of(template) if template else None
        folder = self.find_folder([template]) if template and own and own.tag == "mesh" else self.folder
        return self.files.add(geom.name, folder, shape.vertices, shape.faces)


class ElementEdits:
    """The collision elements of the output.

    places: each authored element, with what stands in its place; ends: what is added to a link without collisions.
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
        self.places: list[tuple[xml.Element, list[OutputElement]]] = []
        self.ends: dict[str, list[OutputElement]] = {}
        self._owner = {name: k for k, one in enumerate(authored) for name in one.names}
        self._elements = elements
        self._poses = asset.body_poses
        self._place_authored()
        for geom in collision_pieces.new_hulls(asset, self._owner):
            refuse_unknown_link(geom, links, str(asset.path))
            self._place_made(geom)

    @property
    def outputs(self) -> list[OutputElement]:
        """All collision elements in the order of the output."""
        by_link: dict[str, list[OutputElement]] = {name: [] for name in self.links}
        for (_, outputs), authored in zip(self.places, self.authored, strict=True):
            by_link[authored.body] += outputs
        for link, outputs in self.ends.items():
            by_link[link] += outputs
        return [output for outputs in by_link.values() for output in outputs]

    @property
    def splices(self) -> list[xml.Splice]:
        """The edits of the document's text."""
        data = self.maker.data
        edited = (place for place in self.places if not (len(place[1]) == 1 and place[1][0].is_untouched))
        edits = [replace_element(data, element, outputs) for element, outputs in edited]
        return edits + [append_elements(data, self.links[link], outputs) for link, outputs in self.ends.items()]

    def _place_authored(self) -> None:
        kept = collision_pieces.names_to_keep(self.asset)
        for element, authored in zip(self._elements, self.authored, strict=True):
            staying = {k: name for k, name in enumerate(authored.names) if name in kept}
            if len(staying) == len(authored.names) and not (self.asset.one_file_a_hull and len(staying) > 1):
                outputs = [OutputElement(authored.body, authored.names, element.attributes.get("name"), element)]
            else:
                outputs = []  # an element for each piece, its triangles as authored in a file of their own
                for k, name in staying.items():
                    edits, old = self.maker.extract_piece(element, name, k), element.attributes.get("name")
                    outputs.append(OutputElement(authored.body, (name,), old, element, edits, copy=bool(outputs)))
            self.places.append((element, outputs))

    def _place_made(self, geom: Geom) -> None:
        """A new element after that of its parent, or else after the last one of its link."""
        own = [k for k, authored in enumerate(self.authored) if authored.body == geom.body]
        parent = self._owner.get(geom.parent or "")
        template = self._elements[parent] if parent is not None else None
        lead = child_indent_of(self.maker.data, self.links[geom.body])
        output = self.maker.make_element(geom, self._poses[geom.body], template, lead)
        if not own:
            self.ends.setdefault(geom.body, []).append(output)
        else:
            self.places[parent if parent in own else own[-1]][1].append(output)


def refuse_unknown_link(geom: Geom, links: Collection[str], where: str) -> None:
    """Raise AssetError for a hull on a link that is not there."""
    if geom.body not in links:
        like = nearest_name(geom.body, links)
        problem = f"hull {geom.name!r} is on link {geom.body!r}, which is not there"
        raise AssetError(problem, where=where, remedy=f"The nearest name of a link is {like!r}." if like else None)


def replace_element(data: bytes, element: xml.Element, outputs: Sequence[OutputElement]) -> xml.Splice:
    """Return what stands in the place of an authored element; nothing takes its line away."""
    if not outputs:
        return xml.remove_element(data, element)
    return xml.Splice(element.start, element.end, _join_outputs(data, outputs, xml.indent_of(data, element.start)))


def append_elements(data: bytes, parent: xml.Element, outputs: Sequence[OutputElement]) -> xml.Splice:
    """Return what is added at the end of an element."""
    line_end, before = xml.newline_of(data), xml.indent_of(data, parent.start) or b""
    if parent.children:
        last = parent.children[-1]
        lead = xml.indent_of(data, last.start)
        return xml.Splice(
            last.end, last.end, (b"" if lead is None else line_end + lead) + _join_outputs(data, outputs, lead)
        )
    lead = before + b"  "
    added = lead + _join_outputs(data, outputs, lead) + line_end
    if data[parent.inside - 2 : parent.inside] == b"/>":
        closing_tag = b"</%s>" % parent.tag.encode()
        return xml.Splice(parent.inside - 2, parent.inside, b">" + line_end + added + before + closing_tag)
    closing = data.rfind(b"</", parent.inside, parent.end)
    blanks = xml.indent_of(data, closing)
    if blanks is None:
        return xml.Splice(closing, closing, line_end + added + before)
    return xml.Splice(closing - len(blanks), closing - len(blanks), added)


def child_indent_of(data: bytes, parent: xml.Element) -> bytes:
    """Return the blanks before the children of an element."""
    if parent.children:
        return xml.indent_of(data, parent.children[-1].start) or b""
    return (xml.indent_of(data, parent.start) or b"") + b"  "


def _join_outputs(data: bytes, outputs: Iterable[OutputElement], lead: bytes | None) -> bytes:
    gap = b"" if lead is None else xml.newline_of(data) + lead
    return gap.join(output.to_bytes(data) for output in outputs)


def assign_names(outputs: Sequence[OutputElement], *, unique: bool = False) -> dict[str, str]:
    """Name the elements, given in the order of the output, that would else read back under other names.

    unique: whether a name that MeshForge made up is left out where another element of the file has it, as some engines
    want names unique in the file. Returns the names that cannot be had all the same, with what they read back as: a
    hull of a format whose names do not begin with the body, or an element with the name of a piece of another.
    """
    for _ in range(4):
        for output, _names in _find_misread(outputs):
            output.name = name_attribute_of(output)
    authored = {output.source.attributes.get("name") for output in outputs if output.source and not output.copy}
    taken = set[str | None]()
    for output in outputs if unique else ():
        is_own = output.source is not None and not output.copy and output.name == output.source.attributes.get("name")
        if output.name and not is_own and _MADE_UP.fullmatch(output.name) and output.name in taken | authored:
            output.name = None
        taken.add(output.name)
    return {
        wanted: name
        for output, names in _find_misread(outputs)
        for wanted, name in zip(output.names, names, strict=True)
    }


def _find_misread(outputs: Sequence[OutputElement]) -> list[tuple[OutputElement, tuple[str, ...]]]:
    read = collision_pieces.name_element_pieces([(output.body, output.name, len(output.names)) for output in outputs])
    return [(output, names) for output, names in zip(outputs, read, strict=True) if names != output.names]


def name_attribute_of(output: OutputElement) -> str:
    """Return the name attribute under which a output's pieces have their names."""
    return collision_pieces.own_name_of(output.names, output.body)
