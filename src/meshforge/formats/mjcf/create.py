"""Making an MJCF from an asset of another format: nested bodies with joints and masses, a geom for each hull."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from meshforge.asset import Asset, Geom, Joint, Opaque, Surface, What
from meshforge.formats.base import Output
from meshforge.formats.body_tree import BodyTree, free_name
from meshforge.formats.losses import Loss
from meshforge.formats.mjcf.document import geom_names
from meshforge.formats.mjcf.elements import Native, geom_attributes, mesh_geom_attributes, pose_attributes, tag
from meshforge.formats.mjcf.joints import joint_tag, parts_of
from meshforge.formats.mjcf.masses import LEAST, LIGHT, inertial_tag, light_tag
from meshforge.formats.mjcf.mesh_assets import MeshAssets
from meshforge.formats.mjcf.shown_whole import shown_whole
from meshforge.formats.visual_files import VisualFiles, visuals_of
from meshforge.formats.visuals import Rgba
from meshforge.formats.xml import shown
from meshforge.geometry import Pose
from meshforge.words import counted, listed

WORLD = "world"
"""What MuJoCo calls the body that never moves; no other may have this name."""


def create_mjcf(asset: Asset, name: str) -> Output:
    """The files of an asset that came from another format.

    Bodies are nested as joints have it, those without a joint stand in the world and do not move. Hulls become native
    geoms or meshes, one a file; opaque pieces and visuals geoms that do not collide.
    """
    return _Creator(asset, Path(name).stem).output()


class _Creator:
    def __init__(self, asset: Asset, stem: str) -> None:
        self.asset, self.stem = asset, stem
        self.tree = BodyTree.of(asset)
        self.poses = asset.body_poses
        self.shown = visuals_of(asset)
        self.meshes = MeshAssets(stem)
        self.visuals = VisualFiles(self.meshes.files, shown_whole)
        self.visuals.gather(self.shown)
        self.inertials = {inertial.body: inertial for inertial in asset.mechanism.inertials}
        self.joint_names = self.tree.joint_names
        self.bodies = self._body_names()
        self.named = self._geom_names()
        self.lost: list[Loss] = []
        self.notes: dict[str, list[str]] = {}

    def output(self) -> Output:
        body = list(self._lines())
        head = [tag("mujoco", {"model": self.stem}, closed=False), b"  " + tag("compiler", {"angle": "radian"})]
        defaults = _DEFAULTS if self.shown or self.asset.opaque else []
        main = b"\n".join([*head, *defaults, *self.meshes.lines(), *body, b"</mujoco>", b""])
        reads = {geom.name: self.named[geom.name][1] for geom in self.asset.geoms}
        names = {name: read for name, read in reads.items() if read != name}
        return Output(
            main, dict(self.meshes.files.made), self.visuals.copies, self._told(), names, tuple(self._losses())
        )

    def _body_names(self) -> dict[str, str]:
        """What each body is called; the root of that name is the world."""
        roots = [name for name in self.tree.roots if name == WORLD]
        taken = {WORLD} | {body.name for body in self.asset.bodies}
        return {
            b.name: free_name(b.name, taken) if b.name == WORLD and not roots else b.name for b in self.asset.bodies
        }

    def _geom_names(self) -> dict[str, tuple[str, str]]:
        """For each hull and plane the name attribute, empty where it needs none, and the name that it reads back as."""
        pieces = [(geom.name, geom.body) for geom in self.asset.geoms]
        pieces += [(piece.name, piece.body) for piece in self.asset.opaque if piece.plane]
        ordered = [(name, own) for body in self.tree.order for name, own in pieces if own == body]
        plain = [name.removeprefix(f"{body}/") for name, body in ordered]
        seen = Counter(plain)
        bodies = [self.bodies[body] for _, body in ordered]
        wanted = [f"{body}/{name}" if seen[name] > 1 else name for body, name in zip(bodies, plain, strict=True)]
        unnamed = geom_names([(body, "") for body in bodies])
        taken: set[str] = set()
        attributes = [
            "" if read == f"{body}/{name}" else free_name(attribute, taken)
            for read, body, name, attribute in zip(unnamed, bodies, plain, wanted, strict=True)
        ]
        back = geom_names(list(zip(bodies, attributes, strict=True)))
        return {name: pair for (name, _), pair in zip(ordered, zip(attributes, back, strict=True), strict=True)}

    def _lines(self) -> Iterator[bytes]:
        """The `<worldbody>`, bodies nested in it."""
        below: dict[str, list[str]] = {}
        for body in self.tree.order:
            if self.bodies[body] != WORLD:
                below.setdefault(self._place_of(body), []).append(body)
        yield b"  <worldbody>"
        if self.bodies.get(WORLD) == WORLD:
            yield from self._inside(WORLD, b"    ")
        waiting: list[tuple[str, int] | bytes] = [(body, 2) for body in reversed(below.get("", []))]
        while waiting:
            entry = waiting.pop()
            if isinstance(entry, bytes):
                yield entry
                continue
            body, depth = entry
            lead = b"  " * depth
            yield lead + tag("body", {"name": self.bodies[body], **pose_attributes(self._pose(body))}, closed=False)
            yield from self._inside(body, lead + b"  ")
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

    def _inside(self, body: str, lead: bytes) -> Iterator[bytes]:
        """Joints, mass, geoms and visuals of a body."""
        top = not self._place_of(body)
        joints = [part for joint in self.tree.joints[body] for part in self._parts(joint, top)]
        own = [geom for geom in self.asset.geoms if geom.body == body]
        yield from (lead + joint_tag(joint, self.poses[body]) for joint in joints)
        yield from (lead + text for text in self._mass(body, bool(joints), sum(geom.shape.volume for geom in own)))
        yield from (lead + self._geom(geom) for geom in own)
        pieces = [piece for piece in self.asset.opaque if piece.body == body]
        yield from (lead + text for piece in pieces if piece.plane for text in self._plane(piece, piece.plane))
        yield from (lead + text for text in self._visuals(body))
        yield from (lead + text for piece in pieces if piece.surface for text in self._surface(piece, piece.surface))

    def _parts(self, joint: Joint, top: bool) -> Sequence[Joint]:
        parts = parts_of(joint, top, self.joint_names)
        if len(parts) > 1:
            how = f"{listed([part.name for part in parts])} together move as {joint.kind} {joint.name or joint.child}"
            self.notes.setdefault(how, [])
        return parts

    def _mass(self, body: str, moves: bool, volume: float) -> Iterator[bytes]:
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

    def _geom(self, geom: Geom) -> bytes:
        named = self._name(geom.name)
        class_ = {"class": "collision"} if self.shown else {}
        body_t_root = self.poses[geom.body].inverse()
        shape = geom.shape.moved(body_t_root)
        if isinstance(shape, Native):
            return tag("geom", {**named, **class_, **geom_attributes(shape)})
        middle = shape.aabb.center
        place = Pose.of_translation(middle if np.linalg.norm(middle) > _FAR * shape.aabb.diagonal else np.zeros(3))
        mesh = self.meshes.hull(geom.name, shape.moved(place.inverse()).tessellated())
        return tag("geom", {**named, **class_, **mesh_geom_attributes(mesh, place)})

    def _name(self, piece: str) -> dict[str, str]:
        name = self.named[piece][0]
        return {"name": name} if name else {}

    def _visuals(self, body: str) -> Iterator[bytes]:
        for own, visual in self.shown:
            if own != body or (seen := self.visuals.shown(body, visual, self.poses[body])) is None:
                continue
            if isinstance(seen.what, Native):
                yield _visual(geom_attributes(seen.what), seen.rgba)
            elif isinstance(seen.what, str):
                mesh = self.meshes.shown(seen.what, seen.scale)
                yield _visual(mesh_geom_attributes(mesh, seen.pose), seen.rgba)
            else:
                file = self.meshes.files.add(f"{body}-visual", "", seen.what.vertices, seen.what.faces)
                yield _visual(mesh_geom_attributes(self.meshes.shown(file, np.ones(3)), Pose.identity()), seen.rgba)

    def _plane(self, piece: Opaque, plane: Pose) -> Iterator[bytes]:
        """An endless plane."""
        if not self.tree.is_static(piece.body):
            self.lost.append(Loss(What.PLANES, (piece.name,), "MuJoCo has planes on bodies that do not move only"))
            return
        said = pose_attributes(self.poses[piece.body].inverse() @ plane)
        yield tag("geom", {**self._name(piece.name), "type": "plane", "size": "0 0 1", **said})

    def _surface(self, piece: Opaque, surface: Surface) -> Iterator[bytes]:
        """An opaque surface to look at, where its body shows nothing else."""
        why = "MuJoCo would collide with the convex hull"
        if any(body == piece.body for body, _ in self.shown):
            self.lost.append(Loss(What.OPAQUE, (piece.name,), f"{why}, and the body shows a visual already"))
            return
        seen = self.visuals.shown(piece.name, surface, self.poses[piece.body])
        assert seen is not None  # only files may be unreadable
        assert isinstance(seen.what, str)
        self.lost.append(Loss(What.OPAQUE, (piece.name,), why, "written as a surface that does not collide"))
        yield _visual(mesh_geom_attributes(self.meshes.shown(seen.what, seen.scale), seen.pose), None)

    def _losses(self) -> Iterator[Loss]:
        """What is lost."""
        if self.visuals.refused:
            yield Loss(What.VISUALS, tuple(dict.fromkeys(self.visuals.refused)), "their files cannot be read")
        yield from self.lost

    def _told(self) -> tuple[str, ...]:
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


_FAR = 100.0  # sizes away from its body, beyond which a mesh is placed: MuJoCo keeps its vertices in single precision
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


def _visual(attributes: dict[str, str], rgba: Rgba | None) -> bytes:
    color = {"rgba": shown(rgba)} if rgba else {}
    return tag("geom", {"class": "visual", **attributes, **color})
