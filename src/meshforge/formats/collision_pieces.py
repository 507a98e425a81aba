"""The collision geometry of a file as a reader finds it: named pieces, convex shapes or surfaces in the root frame."""

import posixpath
from collections.abc import Callable, Container, Hashable, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from meshforge import geometry
from meshforge.common import AssetError, GeometryError, file_digest
from meshforge.formats.meshfile.surface import RawSurface, parts_of_surfaces
from meshforge.formats.xml import Element, format_numbers
from meshforge.geometry import FLATNESS, Floats, Ints, Piece, Pose, Shape, Sphere, principal_extents
from meshforge.symbolic import Asset, Geom, Mentions, NonConvexPiece, Surface, unique_names

_NO_LENGTH = 1e-9  # of the radius, for a capsule
_RING = 32  # corners of each end of a tapered cylinder


@dataclass(frozen=True, eq=False, slots=True)
class CollisionPiece:
    """A piece of collision geometry in the root frame: a shape, or None with the reason why it is no hull.

    plane: root_T_plane of an endless plane, whose normal is Z; fill: see `Geom`.
    """

    shape: Shape | None
    reason: str = ""
    surface: Surface | None = None
    plane: Pose | None = None
    fill: float | None = None


@dataclass(frozen=True, slots=True)
class CollisionElement:
    """An element of a file that collides: its body, and the names of its pieces in order, hulls and others."""

    body: str
    names: tuple[str, ...]

    @property
    def element(self) -> str:
        """What its pieces have for `element`."""
        return element_of(self.names)


def place_pieces(
    pieces: Sequence[Piece], linear: Floats, offset: Floats, surfaces: Sequence[RawSurface] = ()
) -> list[CollisionPiece]:
    """Return the pieces of a mesh file under x -> linear @ x + offset, reflections included.

    surfaces: those that the pieces are of, where their names are to be kept as parts.
    """
    known = parts_of_surfaces(surfaces) if surfaces and any(piece.shape is None for piece in pieces) else None
    parts: list[CollisionPiece] = []
    for piece in pieces:
        if piece.shape is not None:
            parts.append(CollisionPiece(piece.shape.transform(linear, offset)))
            continue
        placed = place_surface(piece.vertices, piece.faces, linear, offset)
        own = known.select(piece.face_indices) if known else None
        parts.append(CollisionPiece(None, piece.reason or "no hull", replace(placed, parts=own)))
    return parts or [CollisionPiece(None, "the mesh holds no triangles")]


def place_surface(vertices: Floats, faces: Ints, linear: Floats, offset: Floats, body: str | None = None) -> Surface:
    """Return a surface under x -> linear @ x + offset; a reflection turns its faces round."""
    return Surface(vertices @ linear.T + offset, faces if np.linalg.det(linear) > 0 else faces[:, ::-1], body)


def is_flat(vertices: Floats) -> bool:
    """Return whether points (n, 3) span no volume to speak of; MuJoCo refuses a mesh of such points."""
    extents = principal_extents(vertices)[2]
    return bool(extents.min() <= FLATNESS * extents.max())


def turn_z_to(normal: Floats) -> Pose:
    """Return the least turn that takes Z onto a direction (3,)."""
    length = float(np.linalg.norm(normal))
    x, y, z = normal / length if length > 0 else np.array([0.0, 0.0, 1.0])
    if z < -1 + 1e-12:
        return Pose(np.diag([1.0, -1.0, -1.0]), np.zeros(3))
    cross = np.array([[0, 0, x], [0, 0, y], [-x, -y, 0]])
    return Pose(np.eye(3) + cross + cross @ cross / (1 + z), np.zeros(3))


def build_solid(kind: str, sizes: Sequence[float] | Floats, make: Callable[[], Shape]) -> CollisionPiece:
    """Return the shape that `make` makes, unless it has no volume; sizes: its own [m], none of which may be zero."""
    if not np.isfinite(sizes).all() or min(sizes) <= 0:
        return CollisionPiece(None, f"a {kind.lower()} without volume: {', '.join(f'{s:g}' for s in sizes)} m")
    try:
        return CollisionPiece(make())
    except GeometryError as error:
        return CollisionPiece(None, error.problem)


def build_primitive(kind: str, sizes: Floats, pose: Pose) -> CollisionPiece:
    """Return a native shape of URDF or SDF about a pose, a cone as a hull; none without volume.

    sizes: sides of a box, radii of an ellipsoid, radius and, of what has one, length [m].
    """
    without = CollisionPiece(None, f"a {kind} without volume: {format_numbers(sizes)} m")
    if sizes.min() <= 0:
        return without
    radius, half = float(sizes[0]), float(sizes[-1]) / 2
    match kind:
        case "box":
            shape: Shape = geometry.Box(pose, sizes / 2)
        case "ellipsoid":
            shape = geometry.Ellipsoid(pose, sizes)
        case "sphere":
            shape = Sphere(pose, radius)
        case "cone":  # its tip up, centred at half its height
            made = build_round(kind, pose, radius, 0.0, half).shape
            if made is None:
                return without
            shape = made
        case _:
            shape = (geometry.Capsule if kind == "capsule" else geometry.Cylinder)(pose, radius, half)
    return CollisionPiece(shape) if shape.volume > 0 else without


def build_round(kind: str, pose: Pose, bottom: float, top: float, half: float) -> CollisionPiece:
    """Return a cylinder, a cone or a capsule about Z of a pose; bottom, top: radii; half: of its straight height [m].

    A tapered one, which no engine has natively, is a hull; a capsule without a straight part a sphere.
    """
    is_capsule, sizes = kind.lower().startswith("capsule"), [max(bottom, top), 2 * half]
    if is_capsule and bottom == top and abs(half) <= _NO_LENGTH * bottom:
        return build_solid("sphere", sizes[:1], lambda: Sphere(pose, top))
    if bottom == top:
        make = geometry.Capsule if is_capsule else geometry.Cylinder
        return build_solid(kind, sizes, lambda: make(pose, top, half))
    if min(bottom, top) < 0:
        return CollisionPiece(None, f"a {kind} of negative radius")
    ends = [_end_points(radius, height, is_capsule) for radius, height in ((bottom, -half), (top, half))]
    return build_solid(kind, sizes, lambda: geometry.convex_hull(pose.apply(np.concatenate(ends))))


def _end_points(radius: float, height: float, is_ball: bool) -> Floats:
    """Points (n, 3) of the disk or ball at a height along Z: the end of a tapered cylinder or capsule."""
    centre = np.array([0.0, 0.0, height])
    if radius == 0:
        return centre.reshape(1, 3)
    if is_ball:
        return Sphere(Pose.of_translation(centre), radius).vertices
    angles = np.arange(_RING) * (2 * np.pi / _RING)
    return np.column_stack([radius * np.cos(angles), radius * np.sin(angles), np.full(_RING, height)])


def leaves_volume(linear: Floats, least: float = 1e-12) -> bool:
    """Return whether a map (3, 3) leaves volume: no stretch is less than a share of the largest one."""
    stretch = np.linalg.svd(linear, compute_uv=False)
    return bool(stretch[-1] > least * stretch[0])


def name_pieces(bases: Iterable[tuple[str, int]]) -> list[tuple[str, ...]]:
    """Return the names of pieces; for each element its own name and how many pieces it has: `#k` for one of several."""
    each = [[base] if count == 1 else [f"{base}#{k}" for k in range(count)] for base, count in bases]
    unique = iter(unique_names(name for names in each for name in names))
    return [tuple(next(unique) for _ in names) for names in each]


def name_element_pieces(elements: Sequence[tuple[str | None, str | None, int]]) -> list[tuple[str, ...]]:
    """Return the names that the pieces of collision elements read as; for each element its link, own name and pieces.

    `link/name`, without a link for None; `geomK` for the K-th of a link without a name; `#k` for one of several.
    """
    count: dict[str | None, int] = {}
    bases = []
    for link, name, _ in elements:
        own = name or f"geom{count.get(link, 0)}"
        bases.append(own if link is None else f"{link}/{own}")
        count[link] = count.get(link, 0) + 1
    return name_pieces(zip(unique_names(bases), (pieces for _, _, pieces in elements), strict=True))


def own_name_of(names: tuple[str, ...], body: str | None) -> str:
    """Return the name of an element whose pieces are to have names: that of the first, without body and `#0`."""
    name = names[0].removeprefix(f"{body}/")
    return name if len(names) == 1 else name.removesuffix("#0")


def name_elements(found: Iterable[tuple[str, Element]], pieces: Iterable[int]) -> tuple[CollisionElement, ...]:
    """Return collisions with the names of their pieces; found: their links and elements; pieces: how many each has."""
    own = [(link, e.attributes.get("name"), count) for (link, e), count in zip(found, pieces, strict=True)]
    named = zip(own, name_element_pieces(own), strict=True)
    return tuple(CollisionElement(link, names) for (link, _, _), names in named)


def element_of(names: Sequence[str]) -> str:
    """Return the name of an element of several pieces by theirs; empty where it has one."""
    return names[0].removesuffix("#0") if len(names) > 1 else ""


def build_pieces(
    authored: Sequence[CollisionElement],
    parts: Sequence[Sequence[CollisionPiece]],
    mentions: Sequence[Sequence[Mentions]],
) -> tuple[tuple[Geom, ...], tuple[NonConvexPiece, ...]]:
    """Return the pieces of elements that are hulls, and those that are none; parts: of each element, in order;
    mentions: what else the file calls each of them."""
    hulls, others = list[Geom](), list[NonConvexPiece]()
    for one, own, texts in zip(authored, parts, mentions, strict=True):
        for name, part, mention in zip(one.names, own, texts, strict=True):
            if part.shape:
                hulls.append(Geom(name, one.body, part.shape, mentions=mention, element=one.element, fill=part.fill))
            else:
                piece = NonConvexPiece(name, one.body, part.reason, part.surface, part.plane, mention, one.element)
                others.append(piece)
    return tuple(hulls), tuple(others)


@dataclass(frozen=True, slots=True)
class ShapeNames:
    """The names of a shape that collides or is shown, empty where it has none.

    shape: what it is, so that one which is shown is known again where it collides; of a mesh, its reference.
    """

    shape: Hashable
    name: str = ""
    mesh: str = ""
    material: str = ""


def collect_mentions(
    own: ShapeNames | None, found: Iterable[ShapeNames | None], more: Iterable[tuple[str, str]] = ()
) -> Mentions:
    """Return what a file calls a shape that collides; found: what its body shows; more: further mentions.

    A visual of the same shape is the shape itself to look at. What else the body shows counts where that is one thing.
    """
    if own is None:
        return ()
    shown = [named for named in found if named]
    twins = [other for other in shown if other.shape == own.shape]
    alone = shown[0] if len(shown) == 1 and not twins else None
    mention_of = [("visual", twin.name) for twin in twins]
    mention_of += [("mesh", own.mesh), *more]
    mention_of += [("shown", alone.name), ("shown", alone.mesh)] if alone else []
    mention_of += [("material", named.material) for named in (own, *twins, *([alone] if alone else []))]
    return drop_repeats(mention_of)


def names_to_keep(asset: Asset) -> set[str]:
    """Return the names of the pieces that an edit leaves as they were: hulls without a parent, all non-convex ones."""
    return {geom.name for geom in asset.geoms if geom.parent is None} | {piece.name for piece in asset.non_convex}


def new_hulls(asset: Asset, known: Container[str]) -> list[Geom]:
    """Return the hulls that an edit made; known: the names of the pieces of the file."""
    return [geom for geom in asset.geoms if geom.parent is not None or geom.name not in known]


def is_edited(asset: Asset, known: Iterable[str]) -> bool:
    """Return whether an edit removed or made a hull; known: the names of the pieces of the file."""
    names = set(known)
    return not names <= names_to_keep(asset) or bool(new_hulls(asset, names))


def drop_repeats(found: Iterable[tuple[str, str | None]]) -> Mentions:
    """Return the mentions without empty ones, each name once."""
    names: dict[str, str] = {}
    for kind, name in found:
        if name and name.strip():
            names.setdefault(name.strip(), kind)
    return tuple((kind, name) for name, kind in names.items())


def stem_of(reference: str) -> str:
    """Return the name of a file that is referred to, without folder and suffix."""
    return posixpath.splitext(posixpath.basename(reference.replace("\\", "/").strip()))[0]


def change_error(what: str, where: str) -> AssetError:
    """Return the error about a file that is not what it was."""
    return AssetError(f"{what} has changed since the asset was read", where=where, remedy="Read the asset again.")


def refuse_changed_files(digests: Iterable[tuple[Path, str]], where: str, kind: str = "") -> None:
    """Raise AssetError where a file is not what it was when it had a digest; kind: what to call it, with a blank."""
    for path, digest in digests:
        if not path.is_file() or file_digest(path) != digest:
            raise change_error(f"{kind}{path.name}", where)
