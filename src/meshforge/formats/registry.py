"""The formats MeshForge knows, one line each, with those of plug-ins; which of them a file is of; reading by them."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping
from contextlib import suppress
from dataclasses import replace
from math import floor
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from meshforge import symbolic
from meshforge.common import AssetError, Plugin, PluginError, Registry, UsageError, is_text, join_names, nearest_name
from meshforge.common.plugins import Targets, make_target
from meshforge.formats.base import Format, ReadOptions, SpecObject, StageObject
from meshforge.formats.meshfile.surface import FARTHEST
from meshforge.formats.plugin_format import guard_format
from meshforge.formats.segmentation import is_segmentation

if TYPE_CHECKING:
    from meshforge.formats.engine_names import MarkName
    from meshforge.formats.plain.folder import FolderFormat

_HEAD = 4096  # bytes by which a format tells its assets from other files of its suffix
_UNREAD = {".mjb": "is a model compiled for one version of MuJoCo: open the XML it was made from"}

_SUFFIXES = {
    "urdf.format:UrdfFormat": ("urdf",),
    "urdf.format:XacroFormat": ("xacro",),
    "mjcf.format:MjcfFormat": ("xml", "mjcf"),
    "sdf.format:SdfFormat": ("sdf",),
    "gltf.format:GltfFormat": ("glb", "gltf"),
    "usd.format:UsdFormat": ("usda", "usd", "usdc", "usdz"),
    "plain.obj:ObjFormat": ("obj",),
    "plain.stl:StlFormat": ("stl",),
    "plain.ply:PlyFormat": ("ply",),
    "plain.stl:WrlFormat": ("wrl",),
}
_MARKED: Mapping[MarkName, tuple[str, ...]] = {
    "unreal": ("gltf.format:GltfForUnreal",),
    "godot": ("gltf.format:GltfForGodot",),
    "unity": ("gltf.format:GltfForUnity",),
    "khr": ("gltf.format:PhysicsGltf",),
    "usd": ("usd.format:UsdFormat",),
}
_EXTENSIONS = {"khr": "KHR_physics_rigid_bodies", "usd": "UsdPhysics"}
SUFFIXES = tuple(f".{suffix}" for suffixes in _SUFFIXES.values() for suffix in suffixes)
"""The suffixes of all files that can be read without plug-ins, lower case, with the dot; folders have none."""
FORMATS_BY_SUFFIX: Registry[Format] = Registry(
    "formats",
    Targets({suffix: f"{__package__}.{target}" for target, suffixes in _SUFFIXES.items() for suffix in suffixes}),
    lambda plugin, kind: guard_format(plugin, kind, [known.name for known in list_formats()]),
)
"""The formats of files by suffix, without the dot, imported on demand: files of broken plug-ins are assets, too."""
MESH_SUFFIXES = (".obj", ".stl", ".ply", ".wrl")
"""The suffixes of plain mesh files, which may be pieces of a folder."""


def load_format(target: str) -> Any:
    """Return the format of a class below this package, `module:class`, always the same."""
    return make_target(f"{__package__}.{target}")


def folder_format() -> FolderFormat:
    """Return the format of folders of mesh files."""
    known: FolderFormat = load_format("plain.folder:FolderFormat")
    return known


def list_formats() -> tuple[Format, ...]:
    """Return the formats that are built in."""
    return (*map(load_format, _SUFFIXES), folder_format())


def list_marked_formats(names: MarkName) -> tuple[Format, ...]:
    """Return the formats that can be written with collision marked in a way: by an engine's names, or an extension."""
    return tuple(map(load_format, _MARKED[names]))


def all_suffixes() -> tuple[str, ...]:
    """Return the suffixes of all files that can be read, those of plug-ins last; no plug-in is loaded for that."""
    return tuple(f".{name}" for name in FORMATS_BY_SUFFIX)


def is_description(path: Path) -> bool:
    """Return whether a file is of a format whose files name mesh files as their parts."""
    try:
        known = _format_of_suffix(path)
    except PluginError:
        return False
    return known is not None and known.is_description


def format_named(name: str) -> Format | None:
    """Return the format of a name, those of plug-ins last; None where there is none."""
    own = FORMATS_BY_SUFFIX.built_in.get(name)  # most are named as one of their suffixes
    if own and own.name == name:
        return own
    known = (*list_formats(), *FORMATS_BY_SUFFIX.loadable().values())
    return next((one for one in known if one.name == name), None)


def plugin_of_suffix(suffix: str) -> Plugin | None:
    """Return the plug-in that alone reads files of a suffix, None where there is none."""
    try:
        return FORMATS_BY_SUFFIX.plugin(suffix.lower().removeprefix("."))
    except PluginError:
        return None


def resolve_asset_path(path: Path) -> Path:
    """Return the file or folder that is meant: the folder of a Gazebo model (with a `model.config`) is its SDF.

    Raises AssetError: its `model.config` is no XML.
    """
    if not path.is_dir():
        return path
    from meshforge.formats.sdf.document import CONFIG, find_main_file  # lazy: most assets are files

    return (find_main_file(path) if (path / CONFIG).is_file() else None) or path


def format_of(path: Path) -> Format:
    """Return the format of a file or folder that is to be read.

    Raises AssetError: no such file, or no known format. Raises PluginError: its plug-in cannot be loaded.
    """
    if path.is_dir():
        return folder_format()
    if not path.exists():
        raise AssetError("there is no such file", where=str(path))
    if not path.is_file():  # reading a pipe would wait, a device may never end
        raise AssetError("cannot be read: it is a pipe or a device", where=str(path))
    found = _format_of_suffix(path)
    if not found:
        raise _unknown_format_error(path)
    return found


def is_asset(path: Path) -> bool:
    """Return whether a file that a folder or a glob holds is an asset: of a known suffix, and no part of another one.

    `package.xml` of ROS is none, nor an MJCF that other ones include, nor an SDF for older versions of Gazebo than that
    beside it, nor segmented points of an asset, `table.points.ply`; named outright, they say what they are.
    """
    if not path.is_file() or is_segmentation(path):
        return False
    try:
        known = _format_of_suffix(path)
    except PluginError:  # its reading says why
        return True
    head = b""  # of one that cannot be read, which its reader will say
    with suppress(OSError), path.open("rb") as stream:
        head = stream.read(_HEAD)
    return known is not None and known.matches_head(head) and known.is_main(path)


def format_for(path: Path, own: str) -> Format:
    """Return the format of a file to be written, by its suffix; own: the name of the format that the asset has.

    A path without a suffix is a folder. Raises AssetError: a suffix of no known format.
    """
    if found := _format_of_suffix(path):
        return found
    if own == "folder" or path.is_dir() or not path.suffix:
        return folder_format()
    raise _unknown_format_error(path)


def format_with_names(known: Format, names: MarkName) -> Format:
    """Return a format that marks collision in a way. Raises UsageError: its files cannot be marked so."""
    for marked in list_marked_formats(names):
        if marked.name == known.name:
            return marked
    files = known.title if known.is_folder else f"{known.title} files"
    mark = f"marked by {_EXTENSIONS[names]}" if names in _EXTENSIONS else f"named for {names.capitalize()}"
    can = ", ".join(suffix for marked in list_marked_formats(names) for suffix in marked.suffixes)
    raise UsageError(f"{files} cannot be {mark}", remedy=f"Formats that can: {can}.")


def _format_of_suffix(path: Path) -> Format | None:
    """The format of a suffix. Raises PluginError about the path where a plug-in has it that cannot be loaded."""
    try:
        return FORMATS_BY_SUFFIX.get(path.suffix.lower().removeprefix("."))
    except PluginError as error:
        raise error.at(str(path)) from error.__cause__


def _unknown_format_error(path: Path) -> AssetError:
    if reason := _UNREAD.get(path.suffix.lower()):
        return AssetError(reason, where=str(path))
    guess = nearest_name(path.suffix.lower(), all_suffixes())
    remedy = f"Known suffixes: {', '.join(all_suffixes())}" + (f"; did you mean {guess}?" if guess else ".")
    return AssetError(f"{path.suffix or path.name} is no format that MeshForge knows", where=str(path), remedy=remedy)


NO_GEOMETRY = "it has no collision geometry: `meshforge new --decompose` makes hulls of what is shown"
"""The note on an asset that holds nothing to reason about."""

_LARGE = 50.0  # m: beyond nearly all assets in metres; a mug in millimetres is 100 across
_SMALL = 1e-3  # m: below nearly all assets in metres


Source = str | os.PathLike[str] | SpecObject | StageObject
"""What an asset is read from: the path of a file or a folder, the text of an MJCF, a `mujoco.MjSpec`, a `Usd.Stage`."""


def read(source: Source, options: ReadOptions | None = None) -> symbolic.Asset:
    """Return the asset in a file, in a folder (of mesh files, or of a Gazebo model), in text or in an object.

    options: None takes those of the environment. Raises AssetError; UsageError: nothing that can be read.
    """
    options = options or ReadOptions.from_environment()
    if path := path_of(source):
        asset = format_of(path).read(path, options)
    elif isinstance(source, str):
        from meshforge.formats.mjcf.format import read_text  # lazy: most assets are files

        asset = read_text(source)
    elif isinstance(source, SpecObject):
        from meshforge.formats.mjcf.format import read_spec  # lazy: most assets are files

        asset = read_spec(source)
    elif isinstance(source, StageObject):
        from meshforge.formats.usd.format import read_stage  # lazy: most assets are files

        asset = read_stage(source)
    else:
        remedy = "Give a path, the text of an MJCF, a mujoco.MjSpec or a Usd.Stage; for trimesh there is from_trimesh."
        raise UsageError(f"a {type(source).__name__} is nothing that an asset is read from", remedy=remedy)
    for file in (path, *asset.files):
        if not is_text(str(file)):
            raise AssetError("this name is not UTF-8", where=str(file), remedy="Rename the file.")
    found = (_note_size(asset), _note_fills(asset))
    return replace(asset, notes=(*asset.notes, *(symbolic.FileNote(note) for note in found if note)))


def _note_fills(asset: symbolic.Asset) -> str | None:
    """A note on meshes that are not convex and collide as their hulls, None where there are none."""
    fills = [(g.name, g.fill and f"{floor(100 * g.fill)}%") for g in asset.geoms if g.fill is not None]
    shares = [f"{name} fills {share or 'an unknown share'} of its hull" for name, share in fills]
    advice = "yet engines collide with the whole hull (meshforge decompose makes hulls that fit)"
    return f"not convex: {join_names(shares)}, {advice}" if shares else None


def notes_after(before: symbolic.Asset, written: symbolic.Asset, hulled: Collection[str] = ()) -> tuple[str, ...]:
    """Return what is to be known about how an asset was read, now that it is written: in its own format, of what is
    there now, since an edit may have dealt with what was to be said of the input; in another one, of what either file
    is, of the one that was written alone. hulled: its hulls of which enough was said."""
    if written.format == before.format:
        return written.notes
    known = _note_fills(written)
    fills = _note_fills(replace(written, geoms=tuple(geom for geom in written.geoms if geom.name not in hulled)))
    now = [note for note in written.notes if isinstance(note, symbolic.FileNote) and note != known]
    return (*(note for note in before.notes if not isinstance(note, symbolic.FileNote)), *now, *filter(None, [fills]))


def path_of(source: symbolic.SymbolicMesh | Source) -> Path | None:
    """Return the file or folder that is meant, None for text and objects. Raises as `resolve_asset_path`."""
    is_text = isinstance(source, str) and source.lstrip().startswith("<")
    return resolve_asset_path(Path(source)) if isinstance(source, str | os.PathLike) and not is_text else None


def _note_size(asset: symbolic.Asset) -> str | None:
    """A note on the size of an asset, None where that is usual.

    Raises AssetError where a piece is not in a place of finite numbers, or so far out that numbers lose it.
    """
    pieces = {geom.name: np.array([geom.shape.aabb.min, geom.shape.aabb.max]) for geom in asset.geoms}
    pieces |= {piece.name: piece.surface.vertices for piece in asset.non_convex if piece.surface}
    for name, points in pieces.items():
        if not (np.abs(points) <= FARTHEST).all():  # true of NaN as well
            problem = f"{name} reaches beyond all numbers that are read, {FARTHEST:g} m"
            raise AssetError(problem, where=str(asset.path), remedy="Fix its place, its size or its scale.")
    if not asset.geoms and not asset.non_convex:
        return NO_GEOMETRY
    pieces |= {o.name: o.surface.vertices[o.surface.faces].reshape(-1, 3) for o in asset.non_convex if o.surface}
    corners = np.concatenate([np.zeros((0, 3)), *pieces.values()])
    size = float(np.linalg.norm(np.ptp(corners, axis=0))) if len(corners) else 0.0
    if size == 0 or _SMALL <= size <= _LARGE:
        return None
    advice = "export it in metres, or scale it where a URDF or MJCF refers to it"
    if size > _LARGE:
        return f"it is {size:,.4g} m across: if its unit is the millimetre, {advice}"
    return f"it is {size:.2g} m across: if its unit is not the metre, {advice}"
