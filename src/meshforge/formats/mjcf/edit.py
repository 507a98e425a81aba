"""Writing an edited MJCF: the authored files with other geoms, all else byte for byte as it was, compiled again
before it is given out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from meshforge.common import AssetError, join_names
from meshforge.formats.base import Mass, Output
from meshforge.formats.mjcf import edit_check, elements, references
from meshforge.formats.mjcf.collision_edit import MjcfPlan, NewGeom, OldGeom, is_edited
from meshforge.formats.mjcf.collision_only import strip_to_collision
from meshforge.formats.mjcf.document import MjcfDocument, MjcfNode, MjcfTree, read_tree
from meshforge.formats.mjcf.edit_geoms import ElementContext, HullGeomMaker, HullMeshes
from meshforge.formats.mjcf.model import MjcfModel, compile_tree, compile_unscaled
from meshforge.formats.references import note_absolute
from meshforge.formats.slots import Slot, append_elements, child_indent_of
from meshforge.formats.xml import Splice, XmlText, apply_splices, newline_of, parse_xml
from meshforge.symbolic import Asset

_ROUNDS = 4  # what one body or geom says may change what another has to say


def write_mjcf(asset: Asset, document: MjcfDocument, name: str, mass: Mass) -> Output:
    """The files of an asset that was read from an MJCF; without an edit, their own bytes.

    MuJoCo compiles what is written, and finds what it found before but for the edited geoms.
    Raises AssetError: a hull that cannot be removed or made, a reference to a geom that goes, a file that MuJoCo
    refuses.
    """
    tree = document.tree
    copies, notes = references.list_copies(asset, tree)
    if not is_edited(asset, document):
        return _build_output(tree, [source.raw for source in tree.sources], {}, copies, notes, {})
    before = _compile(tree, can_strip=bool(document.refusal))
    authored = compile_unscaled(before)
    context = ElementContext(tree)
    meshes = HullMeshes(asset, context, Path(name).stem)
    plan = MjcfPlan(asset, document, before, authored, HullGeomMaker(context, meshes))
    edit = MjcfEdit(plan, meshes, authored)
    if mass == "keep":
        edit.keep_masses()
        if edit.weighs and elements.is_inertial_ignored(tree):
            bodies = join_names([authored.body_names[k] for k in edit.weighs], 3)
            notes.append(f"inertiafromgeom is 'auto' now, so that <inertial> keeps the masses of {bodies}")
    names = _check(edit, before, mass)
    return _build_output(tree, edit.build_texts(), meshes.files.made, copies, notes, names)


def _compile(tree: MjcfTree, can_strip: bool) -> MjcfModel:
    """The model of a tree, of its collision geometry alone where MuJoCo refuses the whole and `can_strip`."""
    try:
        return compile_tree(tree)
    except AssetError:
        if not can_strip:
            raise
        return _strip(tree)


def _strip(tree: MjcfTree) -> MjcfModel:
    refusal = AssetError("MuJoCo refuses its collision geometry", where=str(tree.main.path))
    return strip_to_collision(tree, refusal, masses="fixed")


def _check(edit: MjcfEdit, before: MjcfModel, mass: Mass) -> dict[str, str]:
    """The names that hulls cannot have.

    Raises AssetError where MuJoCo refuses the edited file, or finds in it what the edit does not say.
    """
    try:
        after, names = edit.name_geoms()
        if mass == "recompute":  # a free body may stand on its centre of mass
            before, after = edit.authored, edit.read_back_unscaled()
    except AssetError as error:
        remedy = "Keep the masses (--mass keep)." if mass == "recompute" else error.remedy
        raise AssetError(
            f"of the edited file: {error.problem}", where=str(edit.tree.main.path), remedy=remedy
        ) from None
    wrong = next(edit_check.find_differences(before, after, edit.expected, mass == "keep"), None)
    if wrong is not None:
        raise AssetError(
            f"the edited file would differ from the authored one in more than the edit says: {wrong}",
            where=str(edit.tree.main.path),
            remedy="This is a fault of MeshForge; please report it. Nothing was written.",
        )
    return names


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
    """An edited document. authored: the unedited one with plain masses.

    weighs: the numbers of the bodies that say their masses, which they did not.
    """

    def __init__(self, plan: MjcfPlan, meshes: HullMeshes, authored: MjcfModel) -> None:
        self.plan, self.meshes, self.authored = plan, meshes, authored
        self.tree = plan.tree
        self.weighs: list[int] = []
        self.expected = plan.predict_geoms()
        taken = self._names_of_kept()
        for entry in self.expected:
            if isinstance(entry, NewGeom):
                _name_slot(entry.slot, entry.slot.names[0], taken)

    def build_texts(self) -> list[bytes]:
        """The bytes of each of the authored files, edited. Raises AssetError where one of them cannot be."""
        rest = [*self._mass_splices(), *self._asset_splices()]
        masses = {name: text for name, (node, text) in self._inertial_texts().items() if not node.element.children}
        out = []
        for k, source in enumerate(self.tree.sources):
            splices = [*self.plan.build_splices(k, masses), *(splice for owner, splice in rest if owner == k)]
            if splices and source.place is None:
                raise AssetError(
                    f"the edit is in {source.reference!r}, which is included by an absolute path",
                    where=str(source.path),
                    remedy="Include it by a path relative to the main file.",
                )
            out.append(_edit_file(source.text, splices, k > 0) if splices else source.raw)
        return out

    def read_back_unscaled(self) -> MjcfModel:
        """What MuJoCo makes of the texts with plain masses."""
        return compile_unscaled(self._compile_edited())

    def keep_masses(self) -> None:
        """Let each body say its mass that would have another one. Raises AssetError where one cannot."""
        for _ in range(_ROUNDS):
            bodies = self._find_reweighed()
            if not bodies:
                break
            self.weighs += bodies
        self._inertial_texts()

    def name_geoms(self) -> tuple[MjcfModel, dict[str, str]]:
        """Name the geoms that would else read back under other names.

        Returns what MuJoCo makes of them, and the names that cannot be had, with what they read back as.
        """
        for _ in range(_ROUNDS):
            after = self._compile_edited()
            misread = list(self._find_misread(after))
            taken = {geom.name for geom in after.spec_geoms} | self._names_of_kept()
            named = [_name_slot(slot, wanted, taken) for slot, wanted, _ in misread if slot is not None]
            if not any(named):
                break
        return after, {wanted: read for _, wanted, read in misread}

    def _names_of_kept(self) -> set[str]:
        return {self.authored.spec_geoms[e.number].name for e in self.expected if isinstance(e, OldGeom)}

    def _compile_edited(self) -> MjcfModel:
        """What MuJoCo makes of the texts, of as much as was read before. Raises AssetError where it refuses them."""
        main = self.tree.main.path
        files = dict(zip((source.path for source in self.tree.sources), self.build_texts(), strict=True))
        tree = read_tree(main, files | {main.parent / place: data for place, data in self.meshes.files.made.items()})
        if amiss := [fault for fault in tree.faults if fault not in self.tree.faults]:
            raise AssetError(amiss[0], where=str(main))
        return compile_tree(tree) if self.authored.is_whole else _strip(tree)

    def _find_reweighed(self) -> list[int]:
        try:
            found = edit_check.find_changed_masses(self.authored, self.read_back_unscaled())
        except AssetError:  # perhaps for a body that has lost the geoms that it has its mass from
            names = self.authored.body_names
            found = [names.index(body) for body in self.plan.bodies_to_change]
            found = [body for body in found if self.authored.model.body_mass[body] > 0]
        nodes = {body: self.plan.body_node(self.authored.body_names[body]) for body in found}
        return [body for body in found if body not in self.weighs and not elements.has_inertial(nodes[body], self.tree)]

    def _mass_splices(self) -> Iterator[tuple[int, Splice]]:
        if self.weighs and elements.is_inertial_ignored(self.tree):
            yield from elements.stop_ignoring_inertials(self.tree)
        for node, text in self._inertial_texts().values():
            if node.element.children:
                yield from elements.insert_inertial(self.tree, node, text)

    def _inertial_texts(self) -> dict[str, tuple[MjcfNode, bytes]]:
        """The elements of the bodies that say their masses, and what they say; copies of a body have one mass."""
        found: dict[int, tuple[str, MjcfNode, bytes]] = {}
        for body in self.weighs:
            name = self.authored.body_names[body]
            node = self.plan.body_node(name)
            if node is None:
                raise elements.mass_error(name, "it has no element of its own", self.tree)
            if body in self.authored.unweighed:
                raise elements.mass_error(name, "a visual mesh that weighs could not be read", self.tree)
            found.setdefault(id(node), (name, node, elements.inertial_tag_of_model(self.authored, body)))
        return {name: (node, text) for name, node, text in found.values()}

    def _asset_splices(self) -> Iterator[tuple[int, Splice]]:
        if not self.meshes.elements:
            return
        data, root = self.tree.main.text.data, self.tree.root.element
        made = [Slot("", (), text=text) for text in self.meshes.elements]
        own = list(root.each("asset"))
        if own:
            yield 0, append_elements(data, own[-1], made)
        else:
            lead = child_indent_of(data, root)
            lines = [b"<asset>", *(2 * lead + slot.text for slot in made), lead + b"</asset>"]
            yield 0, append_elements(data, root, [Slot("", (), text=newline_of(data).join(lines))])

    def _find_misread(self, after: MjcfModel) -> Iterator[tuple[Slot | None, str, str]]:
        """The geoms that read back under other names: what may be named, the name as it should be, and as it is."""
        if len(after.names) != len(self.expected):
            return
        for entry, read in zip(self.expected, after.names, strict=True):
            if isinstance(entry, OldGeom):
                wanted = self.authored.names[entry.number]
                named = self.authored.spec_geoms[entry.number].name
                slot = None if named else entry.slot
            else:
                wanted, slot = entry.geom.name, entry.slot
            if wanted != read:
                yield slot, wanted, read


def _edit_file(text: XmlText, splices: Sequence[Splice], is_included: bool) -> bytes:
    """The bytes of an edited file; of an included one that nothing is left in, with an element that says nothing.

    MuJoCo refuses to include an empty file. What it held were geoms or masses, so a frame may stand there.
    """
    data = apply_splices(text.data, splices)
    if is_included and not (root := parse_xml(data, "an edited file")).children:
        data = apply_splices(data, [Splice(root.inside, root.inside, b"<frame/>")])
    return text.encode(data)


def _name_slot(slot: Slot, wanted: str, taken: set[str]) -> bool:
    """Give an element a name attribute under which it reads as wanted, if there is one that is free; take that."""
    for name in (wanted.removeprefix(f"{slot.body}/"), wanted):
        if name not in taken and name != slot.name:
            slot.name = name
            taken.add(name)
            return True
    return False
