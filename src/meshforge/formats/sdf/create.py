"""Making an SDF from an asset of another format: links, joints, native shapes and mesh files."""

from pathlib import Path

import numpy as np

from meshforge.common import join_names, pluralize
from meshforge.formats import element_edits, kinematic_tree, link_output, mesh_output, xml
from meshforge.formats.base import Loss, Output
from meshforge.formats.sdf import document, edit
from meshforge.formats.sdf.frames import WORLD
from meshforge.geometry import Pose
from meshforge.symbolic import Asset, FeatureKind, NonConvexPiece, Rgba, Surface

_VERSION, _WITH_COUPLINGS = (1, 8), "1.11"
_MAIN = "model.sdf"


class SdfCreator(link_output.LinkCreator):
    """Makes the files of an asset that came from another format.

    Bodies become links, each with its frame on the joint that leads to it, so that at zero all is where it was; hulls
    become native shapes or mesh files, non-convex pieces meshes. `model.sdf` gets a `model.config` beside it.
    """

    native = kinematic_tree.LinkShape
    title = "SDF"
    kinds = ("fixed", "revolute", "prismatic", "ball", "floating")
    has_world = True
    visual_suffixes = document.VISUAL_SUFFIXES
    lead = b"      "

    def __init__(self, asset: Asset, name: str) -> None:
        self.name, stem = name, Path(name).stem
        self.model = asset.path.stem if name == _MAIN else stem
        super().__init__(asset, edit.SdfElementMaker("SDF 1.8", b"", mesh_output.HullFiles(stem), version=_VERSION))
        self.renamed: dict[str, str] = {}
        for link, own in self.outputs.items():
            for output in own:
                self._rename(output, self.links[link])

    def build_output(self) -> Output:
        others = element_edits.assign_names([output for own in self.outputs.values() for output in own])
        names = {was: others.pop(name, name) for was, name in self.renamed.items()} | others
        inside = [line for link in self.links for line in self._link_lines(link)]
        if WORLD in self.links:  # what is part of the world does not fall
            link = self.links[WORLD]
            fixed = kinematic_tree.LinkJoint("world_fixed", None, WORLD, link, Pose.identity(), np.zeros(3))
            inside += edit.joint_lines(fixed, WORLD, link, None)
        for joint in self.chain.joints:
            inside += self._joint_lines(joint)
        version = _WITH_COUPLINGS if self.couplings.by_joint else ".".join(map(str, _VERSION))
        model = xml.nest("sdf", *xml.nest("model", *inside, name=self.model), version=version)
        main = b"\n".join([b'<?xml version="1.0"?>', *model, b""])
        made = dict(self.maker.files.made)
        if self.name == _MAIN:
            listed = xml.tag("sdf", {"version": version}, closed=False) + xml.escape(self.name) + b"</sdf>"
            config = xml.nest("model", edit.leaf("name", self.model), listed)
            # it makes the folder a Gazebo model
            made[document.CONFIG] = b"\n".join([b'<?xml version="1.0"?>', *config, b""])
        return Output(main, made, self.visuals.copies, self._collect_notes(), names, self.collect_losses())

    def name_links(self, bare: set[str]) -> dict[str, str]:
        """The name of each link; none for the world where it has nothing: joints can hold on to it without."""
        taken = set(self.chain.frames)
        names = {link: link for link in self.chain.frames if link != WORLD}
        if WORLD in self.chain.frames and WORLD not in bare:
            names = {WORLD: kinematic_tree.claim_name(f"{WORLD}_link", taken), **names}
        return {link: _legal_name(name, taken) for link, name in names.items()} or {WORLD: f"{WORLD}_link"}

    def _rename(self, output: element_edits.OutputElement, link: str) -> None:
        output.name = element_edits.name_attribute_of(output)
        if link != output.body:
            names = tuple(f"{link}/{name.removeprefix(f'{output.body}/')}" for name in output.names)
            self.renamed |= dict(zip(output.names, names, strict=True))
            output.body, output.names = link, names

    def refuse_surface(self, surface: Surface) -> str:
        return "" if len(surface.faces) else "it has no triangle"

    def build_plane(self, piece: NonConvexPiece, link_t_plane: Pose) -> list[element_edits.OutputElement]:
        kind = xml.nest("plane", edit.leaf("normal", "0 0 1"), edit.leaf("size", "100 100"))
        text = self.maker.build_collision(link_t_plane, kind, self.lead)
        return [element_edits.OutputElement(piece.body, (piece.name,), text=text)]

    def color_lines(self, rgba: Rgba) -> list[bytes]:
        color = xml.format_numbers(rgba)
        lines = xml.nest("material", edit.leaf("ambient", color), edit.leaf("diffuse", color))
        return [*lines, edit.number_leaf("transparency", 1 - rgba[3])] if rgba[3] < 1 else lines

    def _link_lines(self, link: str) -> list[bytes]:
        frame = self.chain.frames[link]
        inertial, base = self.inertial_of(link)
        inside = [edit.pose_leaf(Pose(frame.rotation, kinematic_tree.drop_rounding(frame.translation)))]
        inside += edit.inertial_lines(inertial, base) if inertial else []
        for k, visual in enumerate(self.shown[link]):
            inside += self.visual_lines(visual, name=f"visual{k}")
        collisions = [output.to_bytes(b"").split(b"\n") for output in self.outputs[link]]
        inside += [line.removeprefix(self.lead) for lines in collisions for line in lines]
        return xml.nest("link", *inside, name=self.links[link])

    def _joint_lines(self, made: kinematic_tree.LinkJoint) -> list[bytes]:
        """The lines of a joint; none for one that leaves its link free."""
        if made.joint is not None and made.joint.kind == "floating":
            name = made.joint.name
            why = "a link without a joint moves freely in SDF"
            self.lost.append(Loss(FeatureKind.JOINTS, (name,) * bool(name), why, None, not name))
            return []
        coupling = self.couplings.by_joint.get(made.name)
        return edit.joint_lines(made, self.links.get(made.parent, WORLD), self.links[made.child], coupling)

    def _collect_notes(self) -> tuple[str, ...]:
        notes = [*self.chain.notes, *self.couplings.notes, *self.maker.notes]
        renamed = [f"{link} as {name}" for link, name in self.links.items() if link != name]
        if renamed:
            notes.append(f"links that SDF has no such names for are written otherwise ({join_names(renamed, 3)})")
        if weightless := [self.links[link] for link in self.weightless]:
            links = f"{pluralize(len(weightless), 'link')} without a mass ({join_names(weightless, 3)})"
            notes.append(f"{links}: Gazebo takes 1 kg, with moments of 1 kg m^2")
        return tuple(notes)


def _legal_name(name: str, taken: set[str]) -> str:
    """A name that SDF allows: `::` parts scopes, and names between double underscores are its own."""
    allowed = name.replace("::", "__")
    if allowed.startswith("__") and allowed.endswith("__"):
        allowed = f"link{allowed}"
    return name if allowed == name else kinematic_tree.claim_name(allowed, taken)
