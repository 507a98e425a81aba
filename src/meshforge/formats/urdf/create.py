"""Making a URDF from an asset of another format: links, joints, native shapes and mesh files."""

from dataclasses import replace
from pathlib import Path

from meshforge.common import join_names, pluralize
from meshforge.formats import collision_pieces, conversion, element_edits, kinematic_tree, link_output, mesh_output, xml
from meshforge.formats.base import Loss, Output
from meshforge.formats.urdf import document, edit
from meshforge.geometry import Capsule
from meshforge.symbolic import Asset, FeatureKind, Surface


def create_urdf(asset: Asset, name: str, *, capsules: bool = False) -> Output:
    """Return the files of an asset that came from another format; capsules: whether they are written as such.

    Bodies become links, each with its frame on the joint that leads to it, so that at zero all is where it was; hulls
    become native shapes or mesh files, non-convex pieces meshes as they are.
    """
    files = mesh_output.HullFiles(Path(name).stem)
    output = _Creator(asset, edit.UrdfElementMaker("URDF", b"", files, capsules=capsules)).build_output()
    hulled = tuple(geom.name for geom in asset.geoms if isinstance(geom.shape, Capsule) and not capsules)
    loss = Loss(FeatureKind.CAPSULES, hulled, edit.CAPSULE_READERS, "written as triangles")
    return replace(output, lost=(*output.lost, loss)) if hulled else output


class _Creator(link_output.LinkCreator):
    native = edit.UrdfShape
    title = "URDF"
    kinds = ("fixed", "revolute", "prismatic", "floating")
    visual_suffixes = document.VISUAL_SUFFIXES
    lead = b"    "

    def build_output(self) -> Output:
        names = element_edits.assign_names([output for own in self.outputs.values() for output in own], unique=True)
        files = self.maker.files
        inside = [line for link in self.chain.frames for line in self._link_lines(link)]
        for joint in self.chain.joints:
            inside += edit.joint_lines(joint, self.couplings.by_joint.get(joint.name))
        main = b"\n".join([b'<?xml version="1.0"?>', *xml.nest("robot", *inside, name=files.stem), b""])
        lost = self.collect_losses()
        return Output(main, dict(files.made), self.visuals.copies, self._collect_notes(), names, lost)

    def refuse_surface(self, surface: Surface) -> str:
        is_flat = not len(surface.faces) or collision_pieces.is_flat(surface.vertices)
        return "engines refuse a mesh that is flat" if is_flat else ""

    def _link_lines(self, link: str) -> list[bytes]:
        inertial, frame = self.inertial_of(link)
        inside = edit.inertial_lines(inertial, frame) if inertial else []
        inside += [line for visual in self.shown[link] for line in edit.visual_lines(visual)]
        inside += [output.to_bytes(b"") for output in self.outputs[link]]
        return xml.nest("link", *inside, name=link) if inside else [xml.tag("link", {"name": link})]

    def _collect_notes(self) -> tuple[str, ...]:
        notes = [*self.chain.notes, *self.couplings.notes]
        written = {name for own in self.outputs.values() for output in own for name in output.names}
        notes += conversion.note_hulled([p for p in self.asset.non_convex if p.name in written], "MuJoCo and Bullet")
        sliding = [made for made in self.chain.joints if made.joint and made.joint.kind == "prismatic"]
        unlimited = join_names([made.name for made in sliding if made.joint and not made.joint.limits], 3)
        if unlimited:
            travel = f"{edit.UNLIMITED_TRAVEL:g} m each way"
            notes.append(f"prismatic joints without limits ({unlimited}) are limited to {travel}")
        if self.chain.light:
            light, mass = join_names(self.chain.light, 3), kinematic_tree.LIGHT_INERTIAL.mass
            notes.append(f"links of {mass:g} kg stand between joints of one body ({light})")
        # of the name of the world, PyBullet knows that it has no mass
        if weightless := [link for link in self.weightless if link != "world"]:
            notes.append(
                f"{pluralize(len(weightless), 'link')} without a mass ({join_names(weightless, 3)}): PyBullet takes "
                "1 kg, MuJoCo computes it from the hulls"
            )
        return tuple(notes)
