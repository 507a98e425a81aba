"""Put a written asset on disk: where it goes, the whole tree of its files, each file atomically, the main file last."""

import contextlib
import filecmp
import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field, replace
from pathlib import Path

from meshforge.common import AssetError, UsageError, plain_path, replace_atomically, write_atomically
from meshforge.formats.base import Collision, Format, Mass, Output, SceneFormat
from meshforge.formats.conversion import ConversionReport, report_conversion, turn_upright
from meshforge.formats.engine_names import MarkName
from meshforge.formats.registry import SUFFIXES, folder_format, format_for, format_named, format_with_names, load_format
from meshforge.geometry import Pose
from meshforge.symbolic import Asset, Body, Document, FeatureKind, Geom, SymbolicMesh

_MESHES = (".dae", ".msh", ".off", ".skn", ".usd", ".usda", ".usdc", ".usdz", ".bin", ".mtl", ".hf")
_PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".gif", ".tga", ".tif", ".tiff", ".dds", ".webp", ".hdr", ".exr", ".ktx2")
_KINDS = frozenset((*SUFFIXES, *_MESHES, *_PICTURES))
"""The suffixes of files that assets consist of."""

ONE_FILE_A_HULL = ("urdf", "sdf")
"""The formats in which a mesh may hold several hulls, of which each can get a file and an element of its own."""
Content = bytes | Path
"""What a file is to hold: these bytes, or what another file holds."""


@dataclass(frozen=True, slots=True)
class SaveResult:
    """What was written: the main file or folder, all files of its tree, and what the format could not hold.

    names: of hulls that the file reads back under another name, that name.
    hulled: the names of the hulls that it reads back besides, which its engine makes of non-convex pieces.
    report: on an asset that was read from another format, what this one holds and what it does not.
    """

    path: Path
    files: tuple[Path, ...]
    names: Mapping[str, str] = field(default_factory=dict)
    hulled: tuple[str, ...] = ()
    report: ConversionReport = field(default=ConversionReport())

    @property
    def notes(self) -> tuple[str, ...]:
        return self.report.sentences


def save(
    what: SymbolicMesh | Asset,
    out: str | Path,
    *,
    mass: Mass = "keep",
    link: bool = False,
    overwrite: bool = False,
    names: MarkName | None = None,
    collision: Collision | None = None,
    urdf_capsules: bool = False,
) -> SaveResult:
    """Write an asset, in the format it was read from where the suffix of `out` fits it, else made anew.

    Every file that the asset refers to goes along. A path without suffix is a folder of one file a hull.
    mass: whether bodies keep their masses where a format derives them from geometry;
    link: files that are only copied become hard links; overwrite: existing files may be replaced;
    names: how the file marks collision: by the names of an engine, "khr" or "usd"; one that does so already is edited,
    others are made anew. collision: for scenes (glTF, USD) in which nothing is marked, whether hulls are written beside
    what is seen, all of which stays, or in its place; None writes them beside it if an edit changed them or there are
    `names`, and else leaves such a file as it is. urdf_capsules: whether a URDF gets `<capsule>`, which not all readers
    know; one that has some gets more of them in any case.
    Raises AssetError: the format cannot hold the hulls, or a file of the input, or another one that exists, would be
    overwritten. Raises UsageError: collision cannot be marked so in files of this format.
    """
    asset = _to_asset(what)
    out = Path(os.path.normpath(out))
    known = format_for(out, asset.format)
    known = format_with_names(known, names) if names else known
    if urdf_capsules and known.name == "urdf":
        known = load_format("urdf.format:UrdfWithCapsules")
    where = _place_collision(asset, known, names, collision)
    output, report = _make_output(asset, known, out.name, mass, where)
    plan = _plan_files(output, out, known.is_folder)
    _refuse_overwrite(plan, asset, overwrite)
    extra = _find_extra_files(plan, out, overwrite) if known.is_folder else []
    with _build_in_draft(out) if known.is_folder and not out.exists() else nullcontext(out) as place:
        for target, content in plan.items():
            _put_file(place / target.relative_to(out) if target.is_relative_to(out) else target, content, link)
    for path in extra:
        path.unlink()
    kept = {} if isinstance(what, Asset) else what.names_in_file
    found = output.names | {name: output.names.get(own, own) for name, own in kept.items()}
    return SaveResult(out, tuple(plan), found, output.hulled, report)


def part_meshes(mesh: SymbolicMesh, out: str | Path) -> SymbolicMesh:
    """Return a mesh of which each hull gets a file and a collision element of its own when it is written to `out`, for
    engines that make one hull of a file. Raises UsageError: that is no URDF or SDF."""
    if mesh.asset is None:
        return mesh
    known = format_for(Path(out), mesh.asset.format)
    if known.name not in ONE_FILE_A_HULL:
        remedy = "Leave it out: other descriptions have each hull by itself; a path without suffix is a folder."
        raise UsageError(f"--one-file-a-hull is for URDF and SDF, not {known.title}", remedy=remedy)
    return replace(mesh, asset=replace(mesh.asset, one_file_a_hull=True))


def make_output(mesh: SymbolicMesh, kind: str, name: str) -> Output:
    """Return the files of a mesh in the format of a name, main file named `name`. Raises AssetError."""
    known = format_named(kind)
    assert known is not None
    asset = _to_asset(mesh)
    return _make_output(asset, known, name, "keep", _place_collision(asset, known, None, None))[0]


def _to_asset(what: SymbolicMesh | Asset) -> Asset:
    if isinstance(what, Asset) or what.asset:
        return what if isinstance(what, Asset) else what.to_asset()
    bodies, named = dict.fromkeys(hull.body for hull in what.hulls), what.names_in_file
    geoms = tuple(Geom(named.get(h.name, h.name), h.body, h.shape, label=h.label or "") for h in what.hulls)
    return Asset(Path("memory"), "memory", tuple(Body(b, Pose.identity()) for b in bodies), geoms, Document())


def _place_collision(
    asset: Asset, known: Format, names: MarkName | None, collision: Collision | None
) -> Collision | None:
    """Where the hulls of an unmarked scene go when it is written as a scene; None where it is copied, or is no such."""
    source = format_named(asset.format)
    if not isinstance(source, SceneFormat) or not isinstance(known, SceneFormat) or not source.is_unmarked(asset):
        return None
    stays = known.name == source.name and names is None and not source.is_edited(asset)
    return None if collision is None and stays else collision or "beside"


def _make_output(
    asset: Asset, known: Format, name: str, mass: Mass, place: Collision | None
) -> tuple[Output, ConversionReport]:
    """The files of an asset in its own format or another, and the report on them.

    place: where the hulls of an unmarked scene go.
    """
    source, notes = format_named(asset.format), list[str]()
    if asset.mechanism.added and FeatureKind.PAIRS not in known.holds:
        problem, remedy = f"{known.title} has no pairs of bodies that do not touch", "Write MJCF, URDF or USD."
        raise AssetError(problem, where=str(asset.path), remedy=remedy)
    if place == "beside" and isinstance(known, SceneFormat):
        notes.append(f"nothing was marked as collision: what is seen stays, and the hulls are beside it {known.marks}")
    elif place and isinstance(known, SceneFormat) and known.name == asset.format and known.is_edited(asset):
        notes.append("nothing was marked as collision: the hulls are in the place of what was seen")
    if place == "beside" and isinstance(known, SceneFormat) and known.name == asset.format:
        output = known.add_colliders(asset, name)
        return output, ConversionReport(lost=output.lost, remarks=(*notes, *output.notes), marked=False)
    if known.can_write_back(asset):
        output = known.write(asset, name, mass)
        return output, ConversionReport(remarks=(*notes, *output.notes))
    if place == "beside" and isinstance(source, SceneFormat):
        asset = replace(asset, visuals=source.surfaces_of(asset))
    upright, remarks = turn_upright(asset, source, known)
    output = known.create(upright, name)
    return output, report_conversion(upright, source, known, output, (*notes, *remarks))


def _plan_files(output: Output, out: Path, is_folder: bool) -> dict[Path, Content]:
    """What each file is to hold, the main one last. Raises AssetError for one that would lie in a strange place."""
    folder = out if is_folder else out.parent
    beside: dict[str, Content] = {**output.copies, **output.made}
    plan: dict[Path, Content] = {Path(os.path.normpath(folder / name)): content for name, content in beside.items()}
    if not is_folder:
        plan.pop(Path(os.path.normpath(out)), None)
        plan[out] = output.main
    for target in plan:
        if not target.is_relative_to(folder) and target.suffix.lower() not in _KINDS:
            problem = "this is no mesh or texture, and lies outside of the output folder: not written"
            raise AssetError(problem, where=str(target), remedy="Correct the reference to it in the input.")
    return plan


def _refuse_overwrite(plan: Mapping[Path, Content], asset: Asset, overwrite: bool) -> None:
    inputs = {path.resolve() for path in (asset.path, *asset.files)}
    for target, content in plan.items():
        if target.is_dir():
            raise AssetError("there is a folder of this name", where=str(target), remedy="Write elsewhere.")
        if not target.exists() or has_content(target, content):
            continue
        if target.resolve() in inputs:
            raise AssetError("this file belongs to the input", where=str(target), remedy="Write to another folder.")
        if not overwrite:
            problem = "there is such a file already, with other content"
            remedy = "Allow to overwrite it (--overwrite, overwrite=True), or write elsewhere."
            raise AssetError(problem, where=str(target), remedy=remedy)


def _find_extra_files(plan: Mapping[Path, Content], out: Path, overwrite: bool) -> list[Path]:
    """Mesh files in a folder that are not of the asset which is written there; they would count as its hulls."""
    found = [path for path in folder_format().mesh_files(out) if path not in plan] if out.is_dir() else []
    if found and not overwrite:
        problem = f"this folder has other mesh files in it, such as {found[0].name}"
        remedy = "Write to an empty folder, or allow to overwrite (--overwrite, overwrite=True)."
        raise AssetError(problem, where=str(out), remedy=remedy)
    return found


@contextmanager
def _build_in_draft(out: Path) -> Iterator[Path]:
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=f".{out.name}.", suffix=".tmp", dir=out.parent) as holder:
            place = Path(holder) / out.name
            place.mkdir()
            yield place
            place.replace(out)
    except OSError as error:
        raise AssetError(f"cannot be written: {error.strerror}", where=str(out)) from error


def _put_file(target: Path, content: Content, link: bool) -> None:
    try:
        if target.exists() and has_content(target, content):
            return
        if isinstance(content, bytes):
            write_atomically(target, content)
        else:
            copy_atomically(content, target, link=link)
    except OSError as error:
        raise AssetError(f"cannot be written: {error.strerror}", where=str(target)) from error


def output_path_of(asset: Asset, base: Path, out_dir: Path) -> Path:
    """Return the path of an asset's output: below `out_dir` as the asset is below `base`.

    Where the asset has files outside of `base`, or references that pass through a folder above it (MJCF's
    `../cup/a.stl` from within `cup`), it counts from the deepest folder that holds them all: they stay in `out_dir`.
    """
    path, base = plain_path(asset.path), plain_path(base)
    if path.suffix.lower() in SUFFIXES:
        path = path.with_name(format_for(path, asset.format).output_name(path.name))
    folders = [path.parent, *(plain_path(file).parent for file in asset.files)]
    known = format_named(asset.format)
    folders += [plain_path(known.top(asset))] if known else []
    if not all(folder.is_relative_to(base) for folder in folders):
        base = Path(os.path.commonpath(folders))
    return out_dir / path.relative_to(base)


def has_content(target: Path, content: bytes | Path) -> bool:
    """Return whether a file that exists holds just that already."""
    if isinstance(content, Path):
        if not content.is_file():
            raise AssetError("a file that the asset refers to is gone", where=str(content))
        return target.samefile(content) or filecmp.cmp(target, content, shallow=False)
    return target.stat().st_size == len(content) and target.read_bytes() == content


def copy_atomically(source: Path, target: Path, *, link: bool) -> None:
    """Put a copy of a file in place, or with `link` a hard link where the disk allows it. Folders are made."""
    with replace_atomically(target) as draft:
        if link:
            spare = draft.with_name(draft.name + "l")
            with contextlib.suppress(OSError):  # another disk or file system may not allow it
                os.link(source.resolve(), spare)
                spare.replace(draft)
                return
        with draft.open("wb") as stream, source.open("rb") as original:
            shutil.copyfileobj(original, stream)
            stream.flush()
            os.fsync(stream.fileno())
        draft.chmod(source.stat().st_mode & 0o777)
