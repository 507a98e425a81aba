"""Read an SDF: from its files to an asset with visuals, joints and masses, the files it refers to, and notes."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, GeometryError, join_names, plain_path, pluralize
from meshforge.formats import base, collision_pieces, link_reader, references
from meshforge.formats.kinematic_tree import COMMON_KINDS, TENSOR_NAMES, tensor_of_moments
from meshforge.formats.meshfile.surface import RawSurface, join_surfaces
from meshforge.formats.sdf import document, frames, models
from meshforge.formats.sdf.document import AXIS_IN_JOINT
from meshforge.formats.sdf.frames import MODEL, WORLD, is_computed, is_true, pose_of, read_values, text_of
from meshforge.formats.sdf.models import ModelScope, ModelTree
from meshforge.formats.xml import Element, parse_numbers
from meshforge.geometry import Floats, Pose, hull_mesh
from meshforge.symbolic import Asset, Body, Coupling, FileNote, Inertial, Joint, JointKind, Mechanism, Rgba, unit_vector

_UNIT = re.compile(rb"<unit\b[^>]*?\bmeter\s*=\s*[\"']\s*([0-9.eE+-]+)\s*[\"']")
_HEAD_BYTES = 100_000  # bytes within which a file says its unit
_NO_HULLS = {
    "heightmap": "a height map is no hull",
    "image": "an image is no hull",
    "empty": "it is empty",
    "polyline": "a polyline is not read: write it as a mesh",
}
"""Elements of a `<geometry>` that are no shapes, and why."""


def read_sdf(path: Path, options: base.ReadOptions) -> Asset:
    """Return the asset in an SDF file with all that it includes; the root frame is that of the world around the model.

    Raises AssetError naming file, line, link and element: text not understood, a missing frame, model or mesh.
    """
    tree = models.ModelReader(plain_path(path), tuple(map(plain_path, options.package_roots))).tree
    reader, links = _SdfReader(tree), tree.links
    collisions = reader.read_collisions(links.values())
    elements = [element for _, element in collisions.found]
    numbers = {body: link.scope.source.number for body, link in links.items()}
    joints, notes = read_joints(tree)
    world = [Body(frames.WORLD, Pose.identity())] if any(joint.parent == frames.WORLD for joint in joints) else []
    files, missing = _find_files(tree.sources)
    return Asset(
        path=path,
        format="sdf",
        bodies=(*world, *(Body(name, link.pose) for name, link in links.items())),
        geoms=collisions.geoms,
        document=document.SdfDocument(
            tuple(tree.sources),
            collisions.authored,
            tuple((numbers[link.body], element.start) for link, element in collisions.found),
            {body: (numbers[body], link.element.start) for body, link in links.items()},
            tuple(tree.worlds),
            collisions.digests,
        ),
        non_convex=collisions.non_convex,
        visuals=reader.read_visuals(links.values()),
        files=files,
        missing=missing,
        notes=(*tree.notes, *notes, *_collect_notes(tree, elements)),
        mechanism=Mechanism(tuple(joints), tuple(read_masses(tree))),
    )


class _SdfReader(link_reader.LinkReader):
    kinds = ("box", "ellipsoid", "sphere", "cylinder", "capsule", "cone", "plane")

    def __init__(self, tree: models.ModelTree) -> None:
        super().__init__(models.SdfMeshes())
        self.tree = tree

    def place(self, link: link_reader.Link, element: Element) -> Pose:
        return self.tree.pose_in_link(link, element)

    def part_of(self, mesh: Element) -> tuple[str, ...]:
        return models.read_submesh(mesh)

    def unit_of(self, path: Path) -> float:
        return _collada_unit_of(path)

    def read_numbers(self, element: Element, name: str, where: str, default: tuple[float, ...]) -> Floats:
        return frames.read_floats(element, name, where, default)

    def read_shape(self, element: Element, kind: Element, pose: Pose, where: str) -> collision_pieces.CollisionPiece:
        if reason := _NO_HULLS.get(kind.tag):
            return collision_pieces.CollisionPiece(None, reason)
        return super().read_shape(element, kind, pose, where)

    def place_mesh(
        self, kind: Element, path: Path, linear: Floats, offset: Floats
    ) -> list[collision_pieces.CollisionPiece]:
        if kind.attributes.get("optimization") == "convex_hull":
            return [_hull_of(self.meshes.surfaces(path, self.part_of(kind)), linear, offset)]
        return super().place_mesh(kind, path, linear, offset)

    def read_color(self, visual: Element, where: str) -> Rgba | None:
        found = parse_numbers(frames.text_of(visual.first("material"), "diffuse"))
        if not found or len(found) not in (3, 4):
            return None
        red, green, blue, alpha = (min(1.0, max(0.0, share)) for share in [*found, 1.0][:4])
        through = parse_numbers(frames.text_of(visual, "transparency")) or [0.0]
        return red, green, blue, alpha * (1.0 - min(1.0, max(0.0, through[0])))


def _hull_of(surfaces: Sequence[RawSurface], linear: Floats, offset: Floats) -> collision_pieces.CollisionPiece:
    """The convex hull of a mesh with `optimization="convex_hull"`, under x -> linear @ x + offset."""
    whole = join_surfaces(surfaces)
    try:
        hull, fill = hull_mesh(whole.vertices, whole.faces)
        return collision_pieces.CollisionPiece(hull.transform(linear, offset), fill=fill)
    except GeometryError as error:
        return collision_pieces.CollisionPiece(None, error.problem)


def _collada_unit_of(mesh: Path) -> float:
    """The metres of the unit that a mesh file is in: as a Collada file says, 1 for all others."""
    if mesh.suffix.lower() != ".dae":
        return 1.0
    try:
        with mesh.open("rb") as stream:
            found = _UNIT.search(stream.read(_HEAD_BYTES))
        unit = float(found[1]) if found else 1.0
    except (OSError, ValueError):
        return 1.0
    return unit if 0 < unit < float("inf") else 1.0


def _collect_notes(tree: models.ModelTree, collisions: Sequence[Element]) -> Iterator[str]:
    """Notes on worlds, older versions of a model, collisions without a shape, and what is decomposed when loaded."""
    path = tree.sources[0].path
    if tree.worlds:
        count = sum(scope.depth == 1 for scope in tree.scopes)
        yield FileNote(f"it is a world of {pluralize(count, 'model')}, which is only read")
    if tree.version > document.NEWEST:
        own, known = (".".join(map(str, version)) for version in (tree.version, document.NEWEST))
        yield f"SDF {own} is newer than {known}: what is new in it is not understood"
    if not document.is_main_file(path) and (newest := document.find_main_file(path.parent)) is not None:
        yield FileNote(
            f"{document.CONFIG} names {newest.name} for newer versions of Gazebo, which do not read this file"
        )
    if actors := [actor.line for actor in tree.root.each("actor")]:
        yield f"{pluralize(len(actors), 'actor')}, the first on line {actors[0]}: passed over"
    kinds = [(collision.line, link_reader.geometry_of(collision)) for collision in collisions]
    if bare := [f"line {line}" for line, kind in kinds if kind is None]:
        yield f"{pluralize(len(bare), 'collision')} without geometry ({join_names(bare, 3)}): passed over"
    cut = [k for _, k in kinds if k is not None and k.attributes.get("optimization") == "convex_decomposition"]
    if cut:
        meshes = pluralize(len(cut), "mesh", "meshes")
        yield FileNote(f"{meshes} to be decomposed by Gazebo when loaded, shown as authored")


def _find_files(sources: Sequence[document.SdfSource]) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """The included and referenced files that are there, with their companions, and the references that lead nowhere."""
    files: dict[Path, None] = {}
    missing: dict[str, None] = {}
    for number, source in enumerate(sources):
        config = source.path.parent / document.CONFIG
        files |= dict.fromkeys([*[source.path] * bool(number), *[config] * config.is_file()])
        for reference, path in document.list_references(source, source.text.data):
            if path is None:
                missing[reference] = None
            else:
                files |= dict.fromkeys((path, *references.find_companions(path).values()))
    return tuple(files), tuple(missing)


_KINDS: dict[str, JointKind] = {**COMMON_KINDS, "ball": "ball"}
_ENDLESS = 1e15  # limits beyond mean none
_UNIT_TENSOR = (1.0, 0.0, 0.0, 1.0, 0.0, 1.0)


def read_joints(tree: ModelTree) -> tuple[list[Joint], list[str]]:
    """Return the joints of all models that make trees of their bodies, and notes on those that are passed over."""
    joints, notes = list[Joint](), list[str]()
    parents: dict[str, str] = {}
    passed: dict[str, list[str]] = {"not understood": [], "which would close a ring": []}
    for scope in tree.scopes:
        for element in scope.element.each("joint"):
            name = f"{scope.prefix}{element.attributes.get('name', '')}"
            type_ = element.attributes.get("type", "")
            parent, child = (_find_body(tree, scope, text_of(element, role)) for role in ("parent", "child"))
            if type_ not in _KINDS or parent is None or child is None or child == WORLD or parent == child:
                passed["not understood"].append(name)
                continue
            above: str | None = parent
            while above not in (None, child):
                above = parents.get(above or "")
            if child in parents or above == child:
                passed["which would close a ring"].append(name)
                continue
            parents[child] = parent
            joints.append(_read_joint(tree, scope, element, name, parent, child))
    for why, names in passed.items():
        if names:
            notes.append(f"{pluralize(len(names), 'joint')} passed over, {why} ({join_names(names, 3)})")
    return joints, notes


def _find_body(tree: ModelTree, scope: ModelScope, name: str) -> str | None:
    """The body that a name in a joint stands for: a link, or what a frame moves with; None where it is not there."""
    if name == WORLD:
        return WORLD if WORLD not in tree.links else None
    return tree.frames.find_body(scope.path, name)


def _read_joint(tree: ModelTree, scope: ModelScope, element: Element, name: str, parent: str, child: str) -> Joint:
    """The joint of an element; its frame is that of the child unless it names another."""
    type_ = element.attributes["type"]
    at, axis = pose_of(element, scope.where), element.first("axis")
    base, place = at.base or text_of(element, "child"), f"{scope.where}:{at.line}"
    pose = tree.frames.pose_of(scope.path, base, place) @ at.pose
    limit, dynamics = (axis.first("limit"), axis.first("dynamics")) if axis else (None, None)
    limits = _read_limits(limit) if type_ in ("revolute", "prismatic") else None
    return Joint(
        name,
        _KINDS[type_],
        parent,
        child,
        pose.translation,
        _read_axis(tree, scope, axis, pose),
        limits if limits and limits[0] < limits[1] else None,
        damping=_number_or(dynamics, "damping", 0.0),
        friction=_number_or(dynamics, "friction", 0.0),
        effort=_positive_or_none(_read_number(limit, "effort")),
        velocity=_positive_or_none(_read_number(limit, "velocity")),
        empty_limits=limits if limits and not limits[0] < limits[1] else None,
        coupling=_read_coupling(scope, axis.first("mimic")) if axis else None,
    )


def _read_coupling(scope: ModelScope, mimic: Element | None) -> Coupling | None:
    if mimic is None:
        return None
    joint, factor = f"{scope.prefix}{mimic.attributes.get('joint', '')}", _number_or(mimic, "multiplier", 1.0)
    return Coupling(joint, (_number_or(mimic, "offset", 0.0) - factor * _number_or(mimic, "reference", 0.0), factor))


def _read_axis(tree: ModelTree, scope: ModelScope, axis: Element | None, pose: Pose) -> Floats:
    """The direction (3,) of an axis in the root frame; given in the joint's frame, or the one that it names."""
    xyz = axis.first("xyz") if axis else None
    try:
        direction = unit_vector(read_values(xyz, 3, "")) if xyz else None
    except AssetError:
        direction = None
    turn = pose.rotation
    if axis is not None and xyz is not None:
        in_model = is_true(
            text_of(axis, "use_parent_model_frame", "1" if scope.source.version < AXIS_IN_JOINT else "0")
        )
        frame = xyz.attributes.get("expressed_in", "") or (MODEL if in_model else "")
        if frame:
            turn = tree.frames.pose_of(scope.path, frame, f"{scope.where}:{xyz.line}").rotation
    return np.asarray(turn @ (np.array([0.0, 0.0, 1.0]) if direction is None else direction))


def _read_limits(limit: Element | None) -> tuple[float, float] | None:
    """The limits as they are written, the lower one first; None where there are none."""
    lower, upper = _read_number(limit, "lower"), _read_number(limit, "upper")
    low, high = -np.inf if lower is None else lower, np.inf if upper is None else upper
    if low <= -_ENDLESS or high >= _ENDLESS:
        return None
    return low, high


def _positive_or_none(value: float | None) -> float | None:
    """A largest effort or velocity; negative ones mean none."""
    return value if value is not None and 0 < value < _ENDLESS else None


def _read_number(parent: Element | None, tag: str) -> float | None:
    found = parse_numbers(text_of(parent, tag))
    return found[0] if found and len(found) == 1 else None


def read_masses(tree: ModelTree) -> Iterator[Inertial]:
    """Yield the masses that the file says; not those that Gazebo computes of collisions. Raises AssetError."""
    for body, link in tree.links.items():
        element = link.element.first("inertial")
        mass = _number_or(element, "mass", 1.0)
        if element is None or is_computed(element) or mass <= 0:
            continue
        pose = tree.pose_in_link(link, element)
        tensor = element.first("inertia")
        moments = [_number_or(tensor, name, one) for name, one in zip(TENSOR_NAMES, _UNIT_TENSOR, strict=True)]
        yield Inertial(body, mass, pose.translation, pose.rotation @ tensor_of_moments(moments) @ pose.rotation.T)


def _number_or(parent: Element | None, tag: str, default: float) -> float:
    found = _read_number(parent, tag)
    return default if found is None else found
