"""Making an MJCF from an asset of another format: nested bodies with joints and masses, a geom for each hull."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from meshforge.asset import Asset, Joint, What
from meshforge.formats.base import Output
from meshforge.formats.body_tree import BodyTree
from meshforge.formats.losses import Loss
from meshforge.formats.mjcf.elements import pose_attributes, tag
from meshforge.formats.mjcf.making.joints import joint_tag, parts_of
from meshforge.formats.mjcf.making.masses import LEAST, LIGHT, inertial_tag, light_tag
from meshforge.formats.mjcf.making.new_geoms import NewGeoms
from meshforge.formats.mjcf.making.new_names import WORLD, new_body_names, new_geom_names
from meshforge.geometry import Pose
from meshforge.words import counted, listed


def create_mjcf(asset: Asset, name: str) -> Output:
    """The files of an asset that came from another format.

    Bodies are nested as joints have it, those without a joint stand in the world and do not move. Hulls become native
    geoms or meshes, one a file; opaque pieces and visuals geoms that do not collide.
    """
    return _Creator(asset, Path(name).stem).build_output()


class _Creator:
    def __init__(self, asset: Asset, stem: str) -> None:
        self.asset, self.stem = asset, stem
        self.tree = BodyTree.of(asset)
        self.poses = asset.body_poses
        self.inertials = {inertial.body: inertial for inertial in asset.mechanism.inertials}
        self.joint_names = self.tree.joint_names
        self.bodies = new_body_names(self.tree)
        self.named = new_geom_names(asset, self.tree, self.bodies)
        self.made = NewGeoms(asset, stem, self.tree, {piece: name for piece, (name, _) in self.named.items()})
        self.lost: list[Loss] = []
        self.notes: dict[str, list[str]] = {}

    def build_output(self) -> Output:
        body = list(self._body_lines())
        head = [tag("mujoco", {"model": self.stem}, closed=False), b"  " + tag("compiler", {"angle": "radian"})]
        defaults = _DEFAULTS if self.made.shown or self.asset.opaque else []
        meshes, files = self.made.meshes, self.made.files
        main = b"\n".join([*head, *defaults, *meshes.lines(), *body, b"</mujoco>", b""])
        reads = {geom.name: self.named[geom.name][1] for geom in self.asset.geoms}
        names = {name: read for name, read in reads.items() if read != name}
        lost = (*self.made.losses(), *self.lost)
        return Output(main, dict(meshes.files.made), files.copies, self._collect_notes(), names, lost)

    def _body_lines(self) -> Iterator[bytes]:
        """The `<worldbody>`, bodies nested in it."""
        below: dict[str, list[str]] = {}
        for body in self.tree.order:
            if self.bodies[body] != WORLD:
                below.setdefault(self._place_of(body), []).append(body)
        yield b"  <worldbody>"
        if self.bodies.get(WORLD) == WORLD:
            yield from self._element_lines(WORLD, b"    ")
        waiting: list[tuple[str, int] | bytes] = [(body, 2) for body in reversed(below.get("", []))]
        while waiting:
            entry = waiting.pop()
            if isinstance(entry, bytes):
                yield entry
                continue
            body, depth = entry
            lead = b"  " * depth
            yield lead + tag("body", {"name": self.bodies[body], **pose_attributes(self._pose(body))}, closed=False)
            yield from self._element_lines(body, lead + b"  ")
            waiting.append(lead + b"</body>")
            waiting += [(child, depth + 1) for child in reversed(below.get(body, []))]
        yield b"  </worldbody>"

    def _place_of(self, body: str) -> str:
        """The body in which the element of a body stands, empty for the world."""
        parent = self.tree.parent(body)
        floats = [joint.kind for joint in self.tree.joints[body]] == ["floating"]
        if parent is None or self.bodies[parent] == WORLD or (floats and self.tree.is_static(parent)):
            return ""
        return parent

    def _pose(self, body: str) -> Pose:
        """place_T_body."""
        place = self._place_of(body)
        return self.poses[place].inverse() @ self.poses[body] if place else self.poses[body]

    def _element_lines(self, body: str, lead: bytes) -> Iterator[bytes]:
        """Joints, mass, geoms and visuals of a body."""
        top = not self._place_of(body)
        joints = [part for joint in self.tree.joints[body] for part in self._split_joint(joint, top)]
        own = [geom for geom in self.asset.geoms if geom.body == body]
        yield from (lead + joint_tag(joint, self.poses[body]) for joint in joints)
        yield from (lead + text for text in self._mass_lines(body, bool(joints), sum(geom.shape.volume for geom in own)))
        yield from (lead + self.made.make_hull(geom) for geom in own)
        pieces = [piece for piece in self.asset.opaque if piece.body == body]
        yield from (lead + text for piece in pieces if piece.plane for text in self.made.make_plane(piece, piece.plane))
        yield from (lead + text for text in self.made.make_visuals(body))
        yield from (
            lead + text for piece in pieces if piece.surface for text in self.made.make_surface(piece, piece.surface)
        )

    def _split_joint(self, joint: Joint, top: bool) -> Sequence[Joint]:
        parts = parts_of(joint, top, self.joint_names)
        if len(parts) > 1:
            how = f"{listed([part.name for part in parts])} together move as {joint.kind} {joint.name or joint.child}"
            self.notes.setdefault(how, [])
        return parts

    def _mass_lines(self, body: str, moves: bool, volume: float) -> Iterator[bytes]:
        """The mass of a body, whose hulls have a volume [m^3]; one that is to move has some mass in any case."""
        inertial = self.inertials.get(body)
        if self.bodies[body] == WORLD:
            if inertial is not None:
                self.lost.append(Loss(What.MASSES, (body,), "the world of MuJoCo has none"))
        elif inertial is not None and (inertial.mass >= LEAST or not moves):
            text, changed = inertial_tag(inertial, self.poses[body])
            if changed:
                self.notes.setdefault(_MENDED, []).append(body)
            yield text
        elif inertial is None and volume * _DENSITY >= (LIGHT if moves else 0) and volume > 0:
            self.notes.setdefault(_COMPUTED, []).append(body)
        elif moves:
            self.notes.setdefault(_LIGHT, []).append(body)
            yield light_tag()

    def _collect_notes(self) -> tuple[str, ...]:
        notes = [f"{text} ({listed(bodies, 3)})" if bodies else text for text, bodies in self.notes.items()]
        if not any(joint.kind == "floating" for joint in self.asset.mechanism.joints):
            roots = [self.bodies[root] for root in self.tree.roots if self.bodies[root] != WORLD]
            roots = roots or [b for b in self.tree.order if self.tree.parent(b) == WORLD and self.tree.is_static(b)]
            if roots:
                notes.append(
                    f"{counted(len(roots), 'body', 'bodies')} fixed to the world ({listed(roots, 3)}): for one that "
                    "moves freely, write <freejoint/> as the first thing in its <body>"
                )
        return tuple(notes)


_MENDED = "moments of inertia that no rigid body has are replaced by their mean"
_DENSITY = 1000.0  # [kg/m^3], at which MuJoCo computes masses
_COMPUTED = f"MuJoCo computes the masses that are not told, at {_DENSITY:g} kg/m^3"
_LIGHT = f"moving bodies without a mass to speak of get {LIGHT:g} kg"
_DEFAULTS = [
    b"  <default>",
    b'    <default class="collision">',
    b'      <geom group="3"/>',
    b"    </default>",
    b'    <default class="visual">',
    b'      <geom contype="0" conaffinity="0" group="2" mass="0"/>',
    b"    </default>",
    b"  </default>",
]
