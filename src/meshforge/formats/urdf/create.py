"""Making a URDF from an asset of another format: links, joints, native shapes and mesh files."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.common import join_names, pluralize
from meshforge.formats import collision_pieces, link_output, mesh_output
from meshforge.formats.base import Loss, Output
from meshforge.formats.conversion import note_hulled
from meshforge.formats.kinematic_tree import LIGHT_INERTIAL, JointRules
from meshforge.formats.slots import Slot, assign_names
from meshforge.formats.urdf import edit
from meshforge.formats.urdf.document import VISUAL_SUFFIXES
from meshforge.formats.xml import escape
from meshforge.geometry import Capsule, Pose
from meshforge.symbolic import Asset, FeatureKind, NonConvexPiece


def create_urdf(asset: Asset, name: str, *, capsules: bool = False) -> Output:
    """The files of an asset that came from another format; capsules: whether they are written as such.

    Bodies become links, each with its frame on the joint that leads to it, so that at zero all is where it was; hulls
    become native shapes or mesh files, non-convex pieces meshes as they are.
    """
    files = mesh_output.HullFiles(Path(name).stem)
    output = _Creator(asset, edit.UrdfElementMaker(b"", b"\n", files, capsules=capsules)).build_output()
    hulled = tuple(geom.name for geom in asset.geoms if isinstance(geom.shape, Capsule) and not capsules)
    loss = Loss(FeatureKind.CAPSULES, hulled, edit.CAPSULE_READERS, "written as triangles")
    return replace(output, lost=(*output.lost, loss)) if hulled else output


class _Creator(link_output.LinkCreator):
    native = edit.UrdfShape
    title = "URDF"
    rules = JointRules(("fixed", "revolute", "prismatic", "floating", "planar"))
    visual_suffixes = VISUAL_SUFFIXES
    lead = b"    "

    def build_output(self) -> Output:
        names = assign_names([slot for own in self.slots.values() for slot in own], unique=True)
        files = self.maker.files
        head = [b'<?xml version="1.0"?>', b'<robot name="%s">' % escape(files.stem)]
        links = [line for link in self.chain.frames for line in self._link_lines(link)]
        joints = [
            line
            for joint in self.chain.joints
            for line in edit.joint_lines(joint, self.couplings.by_joint.get(joint.name))
        ]
        main = b"\n".join([*head, *links, *joints, b"</robot>", b""])
        lost = self.collect_losses()
        return Output(main, dict(files.made), self.visuals.copies, self._collect_notes(), names, lost)

    def build_non_convex(self, piece: NonConvexPiece, root_t_link: Pose) -> list[Slot]:
        """The element of a non-convex piece; none where it has no surface, or a flat one, which engines refuse."""
        surface = piece.surface
        if surface is None or piece.plane is not None:
            return []
        if not len(surface.faces) or collision_pieces.is_flat(surface.vertices):
            self.lost.append(Loss(FeatureKind.NON_CONVEX, (piece.name,), "engines refuse a mesh that is flat"))
            return []
        vertices = root_t_link.inverse().apply(np.asarray(surface.vertices))
        tag = edit.mesh_tag(self.maker.files.add(piece.name, "", vertices, surface.faces))
        return [Slot(piece.body, (piece.name,), text=edit.build_collision(Pose.identity(), tag, self.lead, b"\n"))]

    def _link_lines(self, link: str) -> list[bytes]:
        inertial, frame = self.inertial_of(link)
        inside = edit.inertial_lines(inertial, frame) if inertial else []
        inside += [line for visual in self.shown[link] for line in edit.visual_lines(*visual)]
        inside += [self.lead + slot.to_bytes(b"") for slot in self.slots[link]]
        if not inside:
            return [b'  <link name="%s"/>' % escape(link)]
        return [b'  <link name="%s">' % escape(link), *inside, b"  </link>"]

    def _collect_notes(self) -> tuple[str, ...]:
        notes = [*self.chain.notes, *self.couplings.notes]
        written = {name for own in self.slots.values() for slot in own for name in slot.names}
        notes += note_hulled([p for p in self.asset.non_convex if p.name in written], "MuJoCo and Bullet")
        sliding = [made for made in self.chain.joints if made.joint and made.joint.kind == "prismatic"]
        unlimited = join_names([made.name for made in sliding if made.joint and not made.joint.limits], 3)
        if unlimited:
            notes.append(
                f"prismatic joints without limits ({unlimited}) are limited to {edit.UNLIMITED_TRAVEL:g} m each way"
            )
        if self.chain.light:
            light = join_names(self.chain.light, 3)
            notes.append(f"links of {LIGHT_INERTIAL.mass:g} kg stand between joints of one body ({light})")
        heavy = {*self.inertials, *self.chain.light, "world"}  # of that name, PyBullet knows that it has no mass
        weightless = [link for link in self.chain.frames if link not in heavy]
        if weightless:
            notes.append(
                f"{pluralize(len(weightless), 'link')} without a mass ({join_names(weightless, 3)}): PyBullet takes "
                "1 kg, MuJoCo computes it from the hulls"
            )
        return tuple(notes)
