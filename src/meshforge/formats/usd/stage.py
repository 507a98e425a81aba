"""OpenUSD, the library, used by one asset at a time; layers as files; what is kept of a stage to write it back; and an
open stage: its prims in order, and where they are in metres."""

import io
import re
import struct
import tempfile
import threading
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import Any, Literal, Self

import numpy as np

from meshforge.common import AssetError, is_beyond_reach
from meshforge.common.processes import report_progress
from meshforge.formats.collision_pieces import CollisionElement, is_edited
from meshforge.formats.libraries import pxr
from meshforge.geometry import Floats, Pose
from meshforge.symbolic import Asset, Document

PACKAGE_SUFFIX = ".usdz"
LAYER_SUFFIXES = (".usd", ".usda", ".usdc")
REMEDY = "Repair the file, or export it anew."
_CRATE_MARK = b"PXR-USDC"
_PACKAGE_MARK = b"PK\x03\x04"
_ALIGNMENT = 64
_HEADER = 30  # bytes of a local header before the name
_PADDING = 0x1986  # the id of the extra field that holds nothing


def is_crate(data: bytes) -> bool:
    """Return whether bytes are a layer in the binary form."""
    return data.startswith(_CRATE_MARK)


def is_crate_wanted(suffix: str, source: bytes | None) -> bool:
    """Return whether a file of a suffix is binary; `.usd` is what its source was, and binary where it is new."""
    return source is None or is_crate(source) if suffix == ".usd" else suffix != ".usda"


def export_layer(layer: Any, *, crate: bool) -> bytes:
    """Return a layer as a file of its own."""
    if not crate:
        text: str = layer.ExportToString()
        return text.encode()
    with tempfile.TemporaryDirectory(prefix="meshforge-") as folder:
        path = Path(folder) / "layer.usdc"
        layer.Export(str(path))
        return path.read_bytes()


def pack_usdz(files: Mapping[str, bytes]) -> bytes:
    """Return a package of files by their names, in that order, the data of each on a multiple of 64."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_STORED) as archive:
        for name, data in files.items():
            info = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            info.external_attr = 0o644 << 16
            missing = -(stream.tell() + _HEADER + len(name.encode())) % _ALIGNMENT
            missing += _ALIGNMENT * (0 < missing < 4)  # a field is four bytes at least
            info.extra = struct.pack("<HH", _PADDING, missing - 4) + bytes(missing - 4) if missing else b""
            archive.writestr(info, data)
    return stream.getvalue()


def unpack_usdz(data: bytes) -> dict[str, bytes]:
    """Return the files of a package by their names, in their order."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {info.filename: archive.read(info) for info in archive.infolist() if not info.is_dir()}


def refuse_far_references(path: Path, data: bytes) -> None:
    """Raise AssetError where a file, or one that it refers to, leads to what may not be read or is no file.

    To be used within `usd`; data: the bytes of the file.
    """
    known, waiting = set[Path](), [(path, data)]
    while waiting:
        file, content = waiting.pop()
        if file.absolute() in known:
            continue
        known.add(file.absolute())
        if content.startswith(_PACKAGE_MARK):
            _refuse_package(content, str(file))
        layer = pxr.Sdf.Layer.FindOrOpen(str(file))
        for reference in sorted(filter(None, layer.GetCompositionAssetDependencies() if layer else ())):
            found = file.parent / reference.split(":SDF_FORMAT_ARGS:", 1)[0]
            if is_beyond_reach(found):
                raise AssetError(f"it refers to {reference}, which is not beside it", where=str(file))
            try:
                if found.is_file():
                    waiting.append((found, found.read_bytes()))
                elif found.exists():  # a pipe would be waited for, a device may never end
                    problem = f"it refers to {reference}, which is a pipe, a folder or a device"
                    raise AssetError(problem, where=str(file))
            except (OSError, ValueError):
                continue


def _refuse_package(data: bytes, where: str) -> None:
    """Raise AssetError where a package is no archive, is compressed, holds another, or has places outside of itself."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            entries = archive.infolist()
    except (zipfile.BadZipFile, NotImplementedError, OSError, ValueError, RuntimeError, EOFError) as error:
        raise AssetError(f"its archive is damaged: {error}", where=where, remedy=REMEDY) from error
    for entry in entries:
        if entry.compress_type != zipfile.ZIP_STORED or entry.flag_bits & 1:
            problem = f"{entry.filename} in it is compressed or encrypted, which USDZ does not allow"
            raise AssetError(problem, where=where, remedy="Pack it with usdzip.")
        parts = Path(entry.filename.replace("\\", "/")).parts
        if ".." in parts or entry.filename.startswith(("/", "\\")) or ":" in parts[:1]:
            raise AssetError(f"{entry.filename} in it leads out of the package", where=where, remedy=REMEDY)
        if entry.filename.lower().endswith(PACKAGE_SUFFIX):
            raise AssetError("a package in a package is not read", where=where, remedy="Unpack it first.")
    if sum(entry.file_size for entry in entries) > len(data):
        raise AssetError("its files do not fit into it", where=where, remedy=REMEDY)


BODY = "body"
"""The name of the body of all collision that is part of no rigid body."""


@dataclass(frozen=True, slots=True)
class PrimRecord(CollisionElement):
    """A prim with collision."""

    path: str


@dataclass(frozen=True, eq=False, slots=True)
class UsdDocument(Document):
    """The source of an asset read from a USD file.

    source: the bytes; physics: whether prims say that they collide, else all meshes do; digests: of the other layers.
    """

    source: bytes
    physics: bool
    authored: tuple[PrimRecord, ...]
    digests: tuple[tuple[Path, str], ...] = ()

    def is_edited(self, asset: Asset) -> bool:
        """Return whether the hulls of an asset are not those of its stage."""
        return is_edited(asset, (piece for element in self.authored for piece in element.names))


_LOCK = threading.RLock()
"""Layers are shared in a process: while one asset is edited in memory, nobody may read it."""
_STAGE = re.compile(r"\s*\((?:instantiating|recomposing) stage on stage .*\)\s*$", re.S)
_DAMAGE = (ValueError, LookupError, TypeError, AttributeError, OverflowError, MemoryError)
_INSIDE = re.compile(r"\bpxrInternal\w*::|@anon:0x[0-9a-f]+:[^@]*@,?")  # the library's names for parts of its own
_LONGEST = 300  # characters of a complaint in a message

_CENTIMETRES = 0.01  # metersPerUnit of a stage that does not say it


@contextmanager
def usd(where: str) -> Iterator[list[str]]:
    """Lock the library for one asset alone; the list gets what it complains about in between.

    Raises AssetError at `where`, with its first complaint where it gives up, or where it is not installed.
    """
    try:
        import_module("pxr.Usd")  # lazy: an optional package, and 0.3 s
    except ImportError as error:
        problem = "USD files need the package usd-core, which is not installed"
        raise AssetError(problem, where=where, remedy="Install it: pip install 'meshforge[usd]'.") from error
    complaints: list[str] = []
    with _LOCK:
        delegate = pxr.UsdUtils.CoalescingDiagnosticDelegate()
        try:
            with np.errstate(over="ignore", invalid="ignore"):  # numbers beyond all bounds are found and reported
                yield complaints
        except pxr.Tf.ErrorException as error:
            comment = next(filter(None, map(_text_of, error.args)), "it gives no reason")
            problem = f"USD cannot read it: {shorten(comment, where)}"
            raise AssetError(problem, where=where, remedy=REMEDY) from None
        except _DAMAGE as error:  # names that are no text, values of types that their schema does not know
            problem = f"this USD file is damaged: {shorten(str(error), where)}"
            raise AssetError(problem, where=where, remedy=REMEDY) from error
        finally:
            found = [shorten(_text_of(item), where) for item in delegate.TakeUncoalescedDiagnostics()]
            complaints += sorted(set(found))  # it reads in several threads, whose order is chance
            del delegate


def shorten(text: str, where: str) -> str:
    """Return a complaint in one line, of a long one the beginning; paths count from the folder of the asset."""
    line = " ".join(_INSIDE.sub("", _STAGE.sub("", text)).replace(f"{Path(where).absolute().parent}/", "").split())
    return line if len(line) <= _LONGEST else f"{line[:_LONGEST]} ..."


def _text_of(complaint: object) -> str:
    try:
        return str(getattr(complaint, "commentary", ""))
    except UnicodeDecodeError:
        return "it has names that are no text"


@dataclass(eq=False)
class UsdStage:
    """A stage, to be used within `usd` only; all of it at the first moment of its time line."""

    stage: Any
    path: Path

    @classmethod
    def open(cls, path: Path) -> Self:
        """Return the stage of a file. Raises AssetError: it holds no prim, or its unit is none."""
        scene = cls(pxr.Usd.Stage.Open(str(path)), path)
        if not np.isfinite(scene.metres) or scene.metres <= 0:
            raise AssetError(f"its metersPerUnit is {scene.metres:g}", where=str(path), remedy="Give it a unit.")
        return scene

    @cached_property
    def metres(self) -> float:
        """The metres of the stage's unit."""
        authored_value = pxr.UsdGeom.StageHasAuthoredMetersPerUnit(self.stage)
        return float(pxr.UsdGeom.GetStageMetersPerUnit(self.stage)) if authored_value else _CENTIMETRES

    @cached_property
    def kilograms(self) -> float:
        """The kilograms of the stage's unit of mass."""
        return float(pxr.UsdPhysics.GetStageKilogramsPerUnit(self.stage))

    @property
    def up(self) -> Literal["y", "z"]:
        return "z" if pxr.UsdGeom.GetStageUpAxis(self.stage) == pxr.UsdGeom.Tokens.z else "y"

    @cached_property
    def time(self) -> Any:
        return pxr.Usd.TimeCode.EarliestTime()

    @cached_property
    def _cache(self) -> Any:
        return pxr.UsdGeom.XformCache(self.time)

    def prims(self) -> Iterator[Any]:
        """Yield all prims in the order of the stage, those of instances too; of point instancers, nothing below."""
        predicate = pxr.Usd.TraverseInstanceProxies(pxr.Usd.PrimDefaultPredicate)
        below = iter(pxr.Usd.PrimRange(self.stage.GetPseudoRoot(), predicate))
        for prim in below:
            report_progress()
            yield prim
            if prim.IsA(pxr.UsdGeom.PointInstancer):
                below.PruneChildren()

    def placement(self, prim: Any) -> tuple[Floats, Floats]:
        """Return the map (3, 3), (3,) from the space of a prim, in units of the stage, to the root frame in metres."""
        matrix = np.array(self._cache.GetLocalToWorldTransform(prim), dtype=np.float64)
        return self.metres * matrix[:3, :3].T, self.metres * matrix[3, :3]

    def pose(self, prim: Any) -> Pose:
        """Return root_T_prim without its scale: the rotation nearest to its map."""
        linear, offset = self.placement(prim)
        return Pose(rotation_of(linear), offset)

    def get(self, attribute: Any) -> Any:
        """Return the value of an attribute, None where it has none."""
        return attribute.Get(self.time) if attribute else None

    @cached_property
    def base(self) -> str:
        """The path that names leave out: of the default prim, else the root."""
        prim = self.stage.GetDefaultPrim()
        return str(prim.GetPath()) if prim else "/"

    def shorten_path(self, path: str, base: str = "") -> str:
        """Return a path as names have it: below another one, or the default prim; that prim's own name for itself."""
        base = base or self.base
        if path == base:
            return path.rsplit("/", 1)[-1]
        return path.removeprefix(base.rstrip("/") + "/").lstrip("/")


def rotation_of(linear: Floats) -> Floats:
    """Return the rotation (3, 3) nearest to a map, which may scale and shear; of one that mirrors, to its opposite.

    That is how the library, and engines with it, take a reflection apart.
    """
    left, _, right = np.linalg.svd(linear * np.sign(np.linalg.det(linear) or 1.0))
    rotation: Floats = left @ right
    return rotation
