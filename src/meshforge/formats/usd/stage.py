"""OpenUSD, the library, used by one asset at a time; what is kept of a stage to write it back; and an open stage: its
prims in order, and where they are in metres.
"""

from __future__ import annotations

import re
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import Any, Literal

import numpy as np

from meshforge.common import AssetError
from meshforge.common.processes import report_progress
from meshforge.formats.collision_pieces import is_edited
from meshforge.formats.libraries import pxr
from meshforge.formats.usd.layers import REMEDY
from meshforge.geometry import Floats, Pose
from meshforge.symbolic import Asset, Document

BODY = "body"
"""The name of the body of all collision that is part of no rigid body."""


@dataclass(frozen=True, slots=True)
class PrimRecord:
    """A prim with collision: its path, its body, and the names of its pieces in order, hulls and non-convex ones."""

    path: str
    body: str
    names: tuple[str, ...]


@dataclass(frozen=True, eq=False, slots=True)
class UsdDocument(Document):
    """The source of an asset read from a USD file.

    source: the bytes of the file; physics: whether prims say that they collide, else all meshes count;
    digests: of the layers besides the root layer.
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
            complaints += dict.fromkeys(found)
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

    @staticmethod
    def open(path: Path) -> UsdStage:
        """Return the stage of a file. Raises AssetError: it holds no prim, or its unit is none."""
        scene = UsdStage(pxr.Usd.Stage.Open(str(path)), path)
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
