"""An edited MJCF in the making: its texts, and what MuJoCo makes of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from meshforge.errors import AssetError
from meshforge.formats.mjcf.files.sources import Node, Tree, gather
from meshforge.formats.mjcf.reading.model import Reading
from meshforge.formats.mjcf.writing.compiling import again, plain
from meshforge.formats.mjcf.writing.hull_meshes import HullMeshes
from meshforge.formats.mjcf.writing.kept_masses import (
    always_from_geoms,
    changed,
    inertial,
    no_longer_always,
    refuse_weighing,
    says_mass,
    weighed,
)
from meshforge.formats.mjcf.writing.places import Kept
from meshforge.formats.mjcf.writing.plan import Plan
from meshforge.formats.slots import Slot, at_end, lead_inside
from meshforge.formats.xml import Splice, Text, newline, parsed, spliced

_ROUNDS = 4  # what one body or geom says may change what another has to say


class Edit:
    """An edited document. authored: the unedited one with plain masses; is_whole: whether MuJoCo takes all of it.

    weighs: the numbers of the bodies that say their masses, which they did not.
    """

    def __init__(self, plan: Plan, meshes: HullMeshes, authored: Reading, is_whole: bool) -> None:
        self.plan, self.meshes, self.authored, self.is_whole = plan, meshes, authored, is_whole
        self.tree = plan.tree
        self.weighs: list[int] = []
        self.expected = plan.predict_geoms()
        taken = {geom.name for geom in authored.spec_geoms}
        for slot in plan.new_slots():
            _name(slot, slot.names[0], taken)

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
            out.append(_file(source.text, splices, k > 0) if splices else source.raw)
        return out

    def read_back(self) -> Reading:
        """What MuJoCo makes of the texts. Raises AssetError where it refuses them."""
        return again(self._build_tree(), self.is_whole)

    def read_back_unscaled(self) -> Reading:
        """The same with plain masses."""
        tree = self._build_tree()
        reading = again(tree, self.is_whole)
        return plain(tree, reading) if self.is_whole else reading

    def keep_masses(self) -> None:
        """Let each body say its mass that would have another one. Raises AssetError where one cannot."""
        for _ in range(_ROUNDS):
            bodies = self._find_reweighed()
            if not bodies:
                break
            self.weighs += bodies
        self._inertial_texts()

    def name_geoms(self) -> tuple[Reading, dict[str, str]]:
        """Name the geoms that would else read back under other names.

        Returns what MuJoCo makes of them, and the names that cannot be had, with what they read back as.
        """
        for _ in range(_ROUNDS):
            after = self.read_back()
            misread = list(self._find_misread(after))
            taken = {geom.name for geom in (*after.spec_geoms, *self.authored.spec_geoms)}
            named = [_name(slot, wanted, taken) for slot, wanted, _ in misread if slot is not None]
            if not any(named):
                break
        return after, {wanted: read for _, wanted, read in misread}

    def _build_tree(self) -> Tree:
        main = self.tree.main.path
        files = dict(zip((source.path for source in self.tree.sources), self.build_texts(), strict=True))
        tree = gather(main, files | {main.parent / place: data for place, data in self.meshes.files.made.items()})
        if amiss := [fault for fault in tree.faults if fault not in self.tree.faults]:
            raise AssetError(amiss[0], where=str(main))
        return tree

    def _find_reweighed(self) -> list[int]:
        """The bodies that have to say their masses, besides those that do."""
        try:
            found = changed(self.authored, self.read_back_unscaled())
        except AssetError:  # perhaps for a body that has lost the geoms that it has its mass from
            names = self.authored.body_names
            found = [names.index(body) for body in self.plan.bodies_to_change]
            found = [body for body in found if self.authored.model.body_mass[body] > 0]
        nodes = {body: self.plan.body_node(self.authored.body_names[body]) for body in found}
        return [body for body in found if body not in self.weighs and not says_mass(nodes[body], self.tree)]

    def _mass_splices(self) -> Iterator[tuple[int, Splice]]:
        if self.weighs and always_from_geoms(self.tree):
            yield from no_longer_always(self.tree)
        for node, text in self._inertial_texts().values():
            if node.element.children:
                yield from weighed(self.tree, node, text)

    def _inertial_texts(self) -> dict[str, tuple[Node, bytes]]:
        """The elements of the bodies that say their masses, and what they say; copies of a body have one mass."""
        found: dict[int, tuple[str, Node, bytes]] = {}
        for body in self.weighs:
            name = self.authored.body_names[body]
            node = self.plan.body_node(name)
            if node is None:
                raise refuse_weighing(name, "it has no element of its own", self.tree)
            if body in self.authored.unweighed:
                raise refuse_weighing(name, "a visual mesh that weighs could not be read", self.tree)
            found.setdefault(id(node), (name, node, inertial(self.authored, body)))
        return {name: (node, text) for name, node, text in found.values()}

    def _asset_splices(self) -> Iterator[tuple[int, Splice]]:
        """The made meshes, at the end of the last `<asset>` of the main file, or in a new one."""
        if not self.meshes.elements:
            return
        data, root = self.tree.main.text.data, self.tree.root.element
        made = [Slot("", (), text=text) for text in self.meshes.elements]
        own = list(root.each("asset"))
        if own:
            yield 0, at_end(data, own[-1], made)
        else:
            lead = lead_inside(data, root)
            lines = [b"<asset>", *(2 * lead + slot.text for slot in made), lead + b"</asset>"]
            yield 0, at_end(data, root, [Slot("", (), text=newline(data).join(lines))])

    def _find_misread(self, after: Reading) -> Iterator[tuple[Slot | None, str, str]]:
        """The geoms that read back under other names: what may be named, the name as it should be, and as it is."""
        if len(after.names) != len(self.expected):
            return
        for entry, read in zip(self.expected, after.names, strict=True):
            if isinstance(entry, Kept):
                wanted = self.authored.names[entry.number]
                named = self.authored.spec_geoms[entry.number].name
                slot = None if named else entry.slot
            else:
                wanted, slot = entry.geom.name, entry.slot
            if wanted != read:
                yield slot, wanted, read


def _file(text: Text, splices: Sequence[Splice], is_included: bool) -> bytes:
    """The bytes of an edited file; of an included one that nothing is left in, with an element that says nothing.

    MuJoCo refuses to include an empty file. What it held were geoms or masses, so a frame may stand there.
    """
    data = spliced(text.data, splices)
    if is_included and not (root := parsed(data, "an edited file")).children:
        data = spliced(data, [Splice(root.inside, root.inside, b"<frame/>")])
    return text.encode(data)


def _name(slot: Slot, wanted: str, taken: set[str]) -> bool:
    """Give an element a name attribute under which it reads as wanted, if there is one that is free; take that."""
    for name in (wanted.removeprefix(f"{slot.body}/"), wanted):
        if name not in taken and name != slot.name:
            slot.name = name
            taken.add(name)
            return True
    return False
