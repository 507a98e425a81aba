"""Writing an edited MJCF: other geoms, all else byte for byte as it was, compiled again before it is given out."""

from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, join_names
from meshforge.formats import collision_pieces, element_edits, xml
from meshforge.formats.base import Mass, Output
from meshforge.formats.mjcf import collision_only, compiler, elements, references
from meshforge.formats.mjcf.document import MjcfDocument, MjcfNode, MjcfTree, read_tree
from meshforge.formats.mjcf.geom_edits import GeomEdits
from meshforge.formats.mjcf.model import MjcfModel, compile_tree, read_excludes
from meshforge.formats.mjcf.new_geoms import NewGeoms
from meshforge.formats.references import note_absolute
from meshforge.geometry import Shape
from meshforge.symbolic import Asset

_ROUNDS = 4  # the mass that one body says may change what another has to say
_FROM_GEOMS = "inertiafromgeom"
_SLIGHT = 1e-6  # relative: MuJoCo keeps vertices in single precision


def write_mjcf(asset: Asset, document: MjcfDocument, name: str, mass: Mass) -> Output:
    """Return the files of an asset that was read from an MJCF; without an edit, their own bytes.

    MuJoCo compiles what is written, and finds what it found before but for the edited geoms.
    Raises AssetError: a hull cannot be removed or made, a geom that goes is referred to, MuJoCo refuses a file.
    """
    tree = document.tree
    copies, notes = references.list_copies(asset, tree)
    if not (collision_pieces.is_edited(asset, document.names) or asset.mechanism.added):
        return _build_output(tree, [source.raw for source in tree.sources], {}, copies, notes, {})
    try:
        before = compile_tree(tree, compiler.drop_scaling)
    except AssetError:
        if not document.refusal:
            raise
        before = _strip(tree)
    edit = MjcfEdit(asset, before, Path(name).stem)
    texts = edit.build_checked_texts(mass)
    if edit.masses.bodies and edit.masses.are_ignored:
        bodies = join_names([before.body_names[k] for k in edit.masses.bodies], 3)
        notes.append(f"inertiafromgeom is 'auto' now, so that <inertial> keeps the masses of {bodies}")
    return _build_output(tree, texts, edit.maker.files.made, copies, notes, edit.geoms.names)


def _strip(tree: MjcfTree) -> MjcfModel:
    refusal = AssetError("MuJoCo refuses its collision geometry", where=str(tree.main.path))
    return collision_only.strip_to_collision(tree, refusal, masses="fixed")


def _build_output(
    tree: MjcfTree,
    texts: list[bytes],
    made: dict[str, bytes],
    copies: dict[str, Path],
    notes: list[str],
    names: dict[str, str],
) -> Output:
    """The output of all files; the included ones go where they were, from the main one."""
    included = zip(references.output_places(tree)[1:], texts[1:], tree.sources[1:], strict=True)
    files = dict(made)
    for place, text, source in included:
        if place is None:
            notes.append(note_absolute(source.reference))
        else:
            files[place] = text
    return Output(texts[0], files, copies, tuple(notes), names)


class MjcfEdit:
    """An edited document; before: the model of the unedited one, its masses not scaled."""

    def __init__(self, asset: Asset, before: MjcfModel, stem: str) -> None:
        self.before, self.tree, self.excludes = before, before.tree, asset.mechanism.added
        self.maker = NewGeoms(asset, before.tree, stem)
        self.geoms = GeomEdits(asset, before, self.maker)
        self.masses = BodyMasses(self.geoms)

    def build_checked_texts(self, mass: Mass) -> list[bytes]:
        """Return the bytes of each of the files, with the masses that bodies have to say.

        Raises AssetError where MuJoCo refuses them, or finds in them what the edit does not say.
        """
        where = str(self.tree.main.path)
        for _ in range(_ROUNDS):
            texts = self.build_texts()
            try:
                after = self._compile(texts)
            except AssetError as error:  # perhaps for a body that has lost the geoms that it has its mass from
                if mass == "keep" and self.masses.add(self.geoms.changed_bodies):
                    continue
                remedy = "Keep the masses (--mass keep)." if mass == "recompute" else error.remedy
                raise AssetError(f"of the edited file: {error.problem}", where=where, remedy=remedy) from None
            changed = [] if mass == "recompute" else _find_changed_masses(self.before, after)
            if not self.masses.add(changed):
                break
        if wrong := "masses" if changed else self._find_difference(after):
            problem = f"the edited file would differ from the authored one in more than the edit says: {wrong}"
            remedy = "This is a fault of MeshForge; please report it. Nothing was written."
            raise AssetError(problem, where=where, remedy=remedy)
        return texts

    def build_texts(self) -> list[bytes]:
        """Return the bytes of each of the files. Raises AssetError where one of them cannot be edited."""
        rest = [*self.masses.build_splices(), *self._asset_splices(), *self._contact_splices()]
        return [
            self._edit_file(k, [*self.geoms.build_splices(k), *(splice for owner, splice in rest if owner == k)])
            for k in range(len(self.tree.sources))
        ]

    def _edit_file(self, number: int, splices: list[xml.Splice]) -> bytes:
        """The bytes of an edited file; in an included one that nothing is left in, an element that says nothing.

        MuJoCo refuses to include an empty file. What it held were geoms or masses, so a frame may stand there.
        """
        source = self.tree.sources[number]
        if not splices:
            return source.raw
        if source.place is None:
            problem = f"the edit is in {source.reference!r}, which is included by an absolute path"
            raise AssetError(problem, where=str(source.path), remedy="Include it by a path relative to the main file.")
        data = xml.apply_splices(source.text.data, splices)
        if number and not (root := xml.parse_xml(data, "an edited file")).children:
            data = xml.apply_splices(data, [xml.Splice(root.inside, root.inside, b"<frame/>")])
        return source.text.encode(data)

    def _asset_splices(self) -> Iterator[tuple[int, xml.Splice]]:
        """The edits, with their files, that add the new meshes."""
        if self.maker.elements:
            yield self._append_to("asset", self.maker.elements)

    def _contact_splices(self) -> Iterator[tuple[int, xml.Splice]]:
        """The edits, with their files, that exclude pairs, and name the bodies of these that have no name."""
        for body in dict.fromkeys(name for pair in self.excludes for name in pair):
            node = self.geoms.body_node(body)
            if node is not None and node.tag == "body" and "name" not in node.attributes:
                if sum(self.geoms.body_node(other) is node for other in self.before.body_names) > 1:
                    problem = f"body {body!r} has no name, and its element stands for several bodies"
                    raise AssetError(problem, where=self.tree.where(node), remedy="Give it a name in the file.")
                text = self.tree.sources[node.source].text.data
                yield node.source, xml.set_attribute(text, node.element, "name", body)
        if self.excludes:
            yield self._append_to(
                "contact",
                [xml.tag("exclude", dict(zip(("body1", "body2"), pair, strict=True))) for pair in self.excludes],
            )

    def _append_to(self, section: str, texts: list[bytes]) -> tuple[int, xml.Splice]:
        """The edit of the main file that adds elements to its last section of a name, or to a new one."""
        data, root = self.tree.main.text.data, self.tree.root.element
        parent, name = next(iter([*root.each(section)][-1:]), root), section.encode()
        if parent is root:
            lead = element_edits.child_indent_of(data, root)
            lines = [b"<%s>" % name, *(2 * lead + text for text in texts), lead + b"</%s>" % name]
            texts = [xml.newline_of(data).join(lines)]
        outputs = [element_edits.OutputElement("", (), text=text) for text in texts]
        return 0, element_edits.append_elements(data, parent, outputs)

    def _compile(self, texts: list[bytes]) -> MjcfModel:
        """What MuJoCo makes of the texts, of as much as was read before. Raises AssetError where it refuses them."""
        main = self.tree.main.path
        files = dict(zip((source.path for source in self.tree.sources), texts, strict=True))
        tree = read_tree(main, files | {main.parent / place: data for place, data in self.maker.files.made.items()})
        if amiss := [fault for fault in tree.faults if fault not in self.tree.faults]:
            raise AssetError(amiss[0], where=str(main))
        return compile_tree(tree, compiler.drop_scaling) if self.before.is_whole else _strip(tree)

    def _find_difference(self, after: MjcfModel) -> str:
        """What MuJoCo finds otherwise than the edit says, empty where all is right.

        Elements refer to geoms by names, and other elements are as they were: right where the names are.
        """
        if after.model.ngeom != len(self.geoms.geoms):
            return f"{after.model.ngeom} geoms where {len(self.geoms.geoms)} were expected"
        for k, (geom, read) in enumerate(zip(self.geoms.geoms, self.geoms.read_names(), strict=True)):
            if (after.spec_geoms[k].name, after.names[k], after.body_of[k]) != (geom.attribute, read, geom.body):
                return f"the name of geom {geom.name!r}"
            if geom.hull is not None and not _is_same_shape(after.read_piece(k).shape, geom.hull.shape):
                return f"the geometry of hull {geom.name!r}"
        found = set(map(frozenset, read_excludes(after)))
        missing = [":".join(pair) for pair in self.excludes if frozenset(pair) not in found]
        return f"the excluded pair {missing[0]}" if missing and self.before.is_whole else ""


def _is_same_shape(found: Shape | None, wanted: Shape) -> bool:
    if found is None or found.kind != wanted.kind:
        return False
    ends, others = (np.array([shape.aabb.min, shape.aabb.max]) for shape in (found, wanted))
    return bool(np.abs(ends - others).max() <= _SLIGHT * (np.abs(others).max() + wanted.aabb.diagonal))


def _find_changed_masses(before: MjcfModel, after: MjcfModel) -> list[int]:
    """The bodies of another mass, centre or inertia, by number."""
    differ = np.zeros(before.model.nbody, dtype=bool)
    for name in ("body_mass", "body_inertia", "body_ipos", "body_iquat"):
        one, other = (getattr(read.model, name).reshape(len(differ), -1) for read in (before, after))
        differ |= (one != other).any(axis=1)
    return np.flatnonzero(differ).tolist()


class BodyMasses:
    """The bodies, by their numbers, that say in the output the masses which they had, and did not say."""

    def __init__(self, geoms: GeomEdits) -> None:
        self.geoms, self.before, self.tree = geoms, geoms.before, geoms.tree
        self.bodies: list[int] = []
        self._texts: dict[int, tuple[MjcfNode, bytes]] = {}  # copies of a body have one element, and one mass
        settings = [c.attributes[_FROM_GEOMS] for c in self.tree.root.each("compiler") if _FROM_GEOMS in c.attributes]
        self.are_ignored = settings[-1:] == ["true"]

    def add(self, bodies: Iterable[int]) -> bool:
        """Let bodies say their masses; whether there was one that did not. Raises AssetError where one cannot."""
        nodes = {body: self.geoms.body_node(self.before.body_names[body]) for body in bodies}
        own = [body for body, node in nodes.items() if node and not self.are_ignored and any(_inertials_of(node))]
        new = [body for body in nodes if body not in (*self.bodies, *own)]
        for body in new:
            node, why = nodes[body], ""
            if node is None:
                why = "it has no element of its own"
            elif body in self.before.unweighed:
                why = "a visual mesh that weighs could not be read"
            if node is None or why:
                problem = f"the mass of body {self.before.body_names[body]!r} cannot be kept: {why}"
                remedy = "Let MuJoCo take it from the edited hulls (--mass recompute)."
                raise AssetError(problem, where=str(self.tree.main.path), remedy=remedy)
            model = self.before.model
            numbers = model.body_ipos[body], model.body_iquat[body], model.body_inertia[body]
            text = xml.tag("inertial", elements.inertial_attributes(float(model.body_mass[body]), *numbers))
            if id(node) not in self._texts and not node.element.children:
                self.geoms.ends[self.before.body_names[body]].insert(0, element_edits.OutputElement("", (), text=text))
            self._texts.setdefault(id(node), (node, text))
        self.bodies += new
        return bool(new)

    def build_splices(self) -> Iterator[tuple[int, xml.Splice]]:
        """Yield the edits, with their files, that put an `<inertial>` before the children of a body's element.

        Where every `<inertial>` was ignored so far, they count now, and those of the bodies give way.
        """
        texts = [source.text.data for source in self.tree.sources]
        for node in self.tree.root.each("compiler") if self.bodies and self.are_ignored else ():
            if node.attributes.get(_FROM_GEOMS) == "true":
                yield node.source, xml.set_attribute(texts[node.source], node.element, _FROM_GEOMS, "auto")
        for node, text in self._texts.values():
            if node.element.children:
                for old in _inertials_of(node):
                    yield old.source, xml.remove_element(texts[old.source], old.element)
                at, gap = node.element.inside, xml.line_gap(texts[node.source], node.element.children[0].start)
                yield node.source, xml.Splice(at, at, gap + text)


def _inertials_of(node: MjcfNode) -> Iterator[MjcfNode]:
    for child in node.children:
        if child.tag == "inertial":
            yield child
        elif child.tag == "frame":
            yield from _inertials_of(child)
