"""Making an MJCF from an asset of another format: nested bodies with joints and masses, geoms for hulls and visuals."""

import posixpath
from collections import Counter
from collections.abc import Iterator

import numpy as np

from meshforge.common import join_names, pluralize
from meshforge.formats import collision_pieces, conversion, kinematic_tree, mesh_output, visuals, xml
from meshforge.formats.base import Loss, Output
from meshforge.formats.mjcf import document, elements, references
from meshforge.geometry import Aabb, Floats, Ints, Pose, convex_hull
from meshforge.symbolic import Asset, FeatureKind, Geom, NonConvexPiece, Surface

WORLD = "world"
"""What MuJoCo calls the body that never moves; no other may have this name."""

_REPAIRED = "moments of inertia that no rigid body has are replaced by their mean"
_DENSITY = 1000.0  # [kg/m^3], at which MuJoCo computes masses
_COMPUTED = f"MuJoCo computes the masses that the file does not say, at {_DENSITY:g} kg/m^3"
_LIGHT_MASS = kinematic_tree.LIGHT_INERTIAL.mass
_LIGHT = f"moving bodies without a mass to speak of get {_LIGHT_MASS:g} kg"
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
_TINY = 1e-12  # [m^3], below which MuJoCo cannot compute a mass from the volume of a mesh
_FAR = 100.0  # sizes away from its body, beyond which a mesh is placed: MuJoCo keeps its vertices in single precision


class MjcfCreator:
    """Makes the files of an asset that came from another format.

    Bodies are nested as joints have it, those without a joint stand in the world and do not move. Hulls become native
    geoms or meshes, one a file; non-convex pieces meshes, whose hulls MuJoCo takes; visuals geoms that do not collide.
    """

    def __init__(self, asset: Asset, stem: str) -> None:
        self.asset, self.stem = asset, stem
        self.tree = kinematic_tree.BodyTree.of(asset)
        self.poses = asset.body_poses
        self.inertials = {inertial.body: inertial for inertial in asset.mechanism.inertials}
        self.couplings = conversion.plan_couplings(asset.mechanism.joints, "MJCF", polynomials=True)
        self.bodies = _name_bodies(self.tree)
        self.named = _name_geoms(asset, self.tree, self.bodies)
        self.geoms = _GeomTexts(asset, stem, {piece: name for piece, (name, _) in self.named.items()})
        self.lost: list[Loss] = []
        self.notes: dict[str, list[str]] = {}

    def build_output(self) -> Output:
        body = list(self._body_lines())
        head = [xml.tag("mujoco", {"model": self.stem}, closed=False), b"  " + xml.tag("compiler", {"angle": "radian"})]
        defaults = _DEFAULTS if self.geoms.shown else []
        meshes = [b"    " + element for element in self.geoms.meshes]
        assets = [b"  <asset>", *meshes, b"  </asset>"] if meshes else []
        main = b"\n".join(
            [*head, *defaults, *assets, *body, *self._equality_lines(), *self._contact_lines(), b"</mujoco>", b""]
        )
        reads = {geom.name: self.named[geom.name][1] for geom in self.asset.geoms}
        names = {name: read for name, read in reads.items() if read != name}
        lost = (*visuals.unreadable_visuals(self.geoms.visuals.refused), *self.lost, *self.couplings.lost)
        hulled = tuple(self.named[piece.name][1] for piece, _ in self.geoms.hulled)
        files, copies = dict(self.geoms.files.made), self.geoms.visuals.copies
        return Output(main, files, copies, self._collect_notes(), names, lost, hulled)

    def _body_lines(self) -> Iterator[bytes]:
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
            lead, place = b"  " * depth, self._place_of(body)
            pose = self.poses[place].inverse() @ self.poses[body] if place else self.poses[body]  # place_T_body
            yield lead + xml.tag("body", {"name": self.bodies[body], **elements.pose_attributes(pose)}, closed=False)
            yield from self._element_lines(body, lead + b"  ")
            waiting.append(lead + b"</body>")
            waiting += [(child, depth + 1) for child in reversed(below.get(body, []))]
        yield b"  </worldbody>"

    def _equality_lines(self) -> Iterator[bytes]:
        if not self.couplings.by_joint:
            return
        yield b"  <equality>"
        for joint, coupling in self.couplings.by_joint.items():
            numbers = xml.format_numbers([*coupling.coefficients, *[0.0] * (5 - len(coupling.coefficients))])
            yield b"    " + xml.tag("joint", {"joint1": joint, "joint2": coupling.joint, "polycoef": numbers})
        yield b"  </equality>"

    def _contact_lines(self) -> Iterator[bytes]:
        if pairs := self.asset.mechanism.apart:
            yield b"  <contact>"
            yield from (b"    " + elements.exclude_tag(self.bodies[one], self.bodies[other]) for one, other in pairs)
            yield b"  </contact>"

    def _place_of(self, body: str) -> str:
        parent = self.tree.parent(body)
        floats = [joint.kind for joint in self.tree.joints[body]] == ["floating"]
        if parent is None or self.bodies[parent] == WORLD or floats:
            return ""
        return parent

    def _element_lines(self, body: str, lead: bytes) -> Iterator[bytes]:
        joints = [joint for joint in self.tree.joints[body] if joint.kind != "fixed"]
        own = [geom for geom in self.asset.geoms if geom.body == body]
        yield from (lead + elements.joint_tag(joint, self.poses[body]) for joint in joints)
        hulls = [self.geoms.make_hull(geom) for geom in own]
        hulls += [
            text for piece in self.asset.non_convex if piece.body == body for text in self._make_non_convex(piece)
        ]
        volume = sum(geom.shape.volume for geom in own) + sum(v for piece, v in self.geoms.hulled if piece.body == body)
        lines = [*self._mass_lines(body, bool(joints), volume), *hulls, *self.geoms.make_visuals(body)]
        yield from (lead + text for text in lines)

    def _make_non_convex(self, piece: NonConvexPiece) -> Iterator[bytes]:
        """The geom of an endless plane, or of a mesh as it is: MuJoCo collides with its convex hull."""
        if piece.plane and not self.tree.is_static(piece.body):
            why = "MuJoCo has planes on bodies that do not move only"
            self.lost.append(Loss(FeatureKind.PLANES, (piece.name,), why))
        elif piece.plane:
            yield self.geoms.make_plane(piece, piece.plane)
        elif piece.surface is not None and piece.name not in self.named:
            self.lost.append(Loss(FeatureKind.NON_CONVEX, (piece.name,), "MuJoCo refuses a mesh that is flat"))
        elif piece.surface is not None:
            yield self.geoms.make_surface(piece, piece.surface)

    def _mass_lines(self, body: str, moves: bool, volume: float) -> Iterator[bytes]:
        inertial = self.inertials.get(body)
        if self.bodies[body] == WORLD:
            if inertial is not None:
                self.lost.append(Loss(FeatureKind.MASSES, (body,), "the world of MuJoCo has none"))
        elif inertial is not None and (inertial.mass >= elements.LEAST_MASS or not moves):
            text, changed = elements.inertial_tag(inertial, self.poses[body])
            if changed:
                self.notes.setdefault(_REPAIRED, []).append(body)
            yield text
        elif inertial is None and volume * _DENSITY >= (_LIGHT_MASS if moves else 0) and volume > 0:
            self.notes.setdefault(_COMPUTED, []).append(body)
        elif moves:
            self.notes.setdefault(_LIGHT, []).append(body)
            yield elements.inertial_tag(kinematic_tree.LIGHT_INERTIAL, Pose.identity())[0]

    def _collect_notes(self) -> tuple[str, ...]:
        notes = [*self.couplings.notes]
        notes += [f"{text} ({join_names(bodies, 3)})" if bodies else text for text, bodies in self.notes.items()]
        notes += conversion.note_hulled([piece for piece, _ in self.geoms.hulled], "MuJoCo")
        if not any(joint.kind == "floating" for joint in self.asset.mechanism.joints):
            roots = [self.bodies[root] for root in self.tree.roots if self.bodies[root] != WORLD]
            roots = roots or [b for b in self.tree.order if self.tree.parent(b) == WORLD and self.tree.is_static(b)]
            if roots:
                notes.append(
                    f"{pluralize(len(roots), 'body', 'bodies')} fixed to the world ({join_names(roots, 3)}): "
                    "for one that moves freely, write <freejoint/> as the first thing in its <body>"
                )
        return tuple(notes)


class _GeomTexts:
    """Makes the elements of what collides and of visuals; names: of what collides its attributes.

    meshes: the `<mesh>` elements so far; hulled: the non-convex pieces, each with the volume [m^3] of its hull.
    """

    def __init__(self, asset: Asset, stem: str, names: dict[str, str]) -> None:
        self.poses, self.names = asset.body_poses, names
        self.shown = visuals.visuals_of(asset)
        self.files = mesh_output.HullFiles(stem)
        self.visuals = mesh_output.VisualFiles(self.files, references.is_shown_whole, elements.MjcfShape)
        self.visuals.gather(self.shown)
        self.meshes: list[bytes] = []
        self.hulled: list[tuple[NonConvexPiece, float]] = []
        self._mesh_names: set[str] = set()
        self._mesh_of_visual: dict[tuple[str, tuple[float, ...]], str] = {}

    def make_hull(self, geom: Geom) -> bytes:
        shape = geom.shape.move(self.poses[geom.body].inverse())
        if isinstance(shape, elements.MjcfShape):
            return xml.tag("geom", {**self._head_of(geom.name), **elements.geom_attributes(shape)})
        place = _place_mesh(shape.aabb)
        own = shape.move(place.inverse()).tessellate()
        inertia = {"inertia": "shell"} if own.volume < _TINY else {}
        return self._make_mesh(geom.name, own.vertices, own.faces, place, inertia)

    def make_surface(self, piece: NonConvexPiece, surface: Surface) -> bytes:
        vertices = self.poses[piece.body].inverse().apply(surface.vertices)
        place, volume = _place_mesh(Aabb.of_points(vertices)), convex_hull(vertices, name=piece.name).volume
        self.hulled.append((piece, volume))
        inertia = {"inertia": "shell" if volume < _TINY else "convex"}
        return self._make_mesh(piece.name, place.inverse().apply(vertices), surface.faces, place, inertia)

    def make_plane(self, piece: NonConvexPiece, plane: Pose) -> bytes:
        place = elements.pose_attributes(self.poses[piece.body].inverse() @ plane)
        return xml.tag("geom", {**self._name_attribute(piece.name), "type": "plane", "size": "0 0 1", **place})

    def make_visuals(self, body: str) -> Iterator[bytes]:
        for own, visual in self.shown:
            if own != body or (seen := self.visuals.add_visual(body, visual, self.poses[body])) is None:
                continue
            if isinstance(seen.what, elements.MjcfShape):
                attributes = elements.geom_attributes(seen.what)
            else:
                assert isinstance(seen.what, str)  # a file is made for every shape that is not native
                key = seen.what, tuple(seen.scale.tolist())
                if key not in self._mesh_of_visual:
                    scaled = {} if np.array_equal(seen.scale, np.ones(3)) else {"scale": xml.format_numbers(seen.scale)}
                    self._mesh_of_visual[key] = self._add_mesh(seen.what, {**scaled, "inertia": "shell"})
                attributes = elements.mesh_geom_attributes(self._mesh_of_visual[key], seen.pose)
            color = {"rgba": xml.format_numbers(seen.rgba)} if seen.rgba else {}
            yield xml.tag("geom", {"class": "visual", **attributes, **color})

    def _head_of(self, piece: str) -> dict[str, str]:
        return self._name_attribute(piece) | ({"class": "collision"} if self.shown else {})

    def _name_attribute(self, piece: str) -> dict[str, str]:
        return {"name": self.names[piece]} if self.names[piece] else {}

    def _make_mesh(self, piece: str, vertices: Floats, faces: Ints, place: Pose, inertia: dict[str, str]) -> bytes:
        mesh = self._add_mesh(self.files.add(piece, "", vertices, faces), inertia)
        return xml.tag("geom", {**self._head_of(piece), **elements.mesh_geom_attributes(mesh, place)})

    def _add_mesh(self, file: str, attributes: dict[str, str]) -> str:
        name = posixpath.splitext(posixpath.basename(file))[0].removeprefix(f"{self.files.stem}--")
        name = kinematic_tree.claim_name(name, self._mesh_names)
        self.meshes.append(xml.tag("mesh", {"name": name, "file": file, **attributes}))
        return name


def _place_mesh(box: Aabb) -> Pose:
    return Pose.of_translation(box.center if np.linalg.norm(box.center) > _FAR * box.diagonal else np.zeros(3))


def _name_bodies(tree: kinematic_tree.BodyTree) -> dict[str, str]:
    """What each body of an asset is called; a root called world is MuJoCo's, no other body is."""
    taken = {WORLD, *tree.order}
    is_root = WORLD in tree.roots
    return {
        name: kinematic_tree.claim_name(name, taken) if name == WORLD and not is_root else name for name in tree.order
    }


def _name_geoms(asset: Asset, tree: kinematic_tree.BodyTree, bodies: dict[str, str]) -> dict[str, tuple[str, str]]:
    """For each hull, plane and mesh the name attribute, empty where it needs none, and the name that it reads back as.

    bodies: what the bodies of the tree are called.
    """
    pieces = [(geom.name, geom.body) for geom in asset.geoms]
    faces = {p.name: p.surface.vertices for p in asset.non_convex if p.surface is not None and len(p.surface.faces)}
    solid = {name for name, vertices in faces.items() if not collision_pieces.is_flat(vertices)}
    pieces += [(piece.name, piece.body) for piece in asset.non_convex if piece.plane or piece.name in solid]
    ordered = [(name, own) for body in tree.order for name, own in pieces if own == body]
    plain = [name.removeprefix(f"{body}/") for name, body in ordered]
    holders = [bodies[body] for _, body in ordered]
    shared = Counter(plain)
    taken: set[str] = set()
    attributes = []
    for unnamed, holder, name in zip(document.geom_names([(h, "") for h in holders]), holders, plain, strict=True):
        wanted = f"{holder}/{name}" if shared[name] > 1 else name
        attributes.append("" if unnamed == f"{holder}/{name}" else kinematic_tree.claim_name(wanted, taken))
    back = document.geom_names(list(zip(holders, attributes, strict=True)))
    return {name: pair for (name, _), pair in zip(ordered, zip(attributes, back, strict=True), strict=True)}
