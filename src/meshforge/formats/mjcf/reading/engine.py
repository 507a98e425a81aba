"""MuJoCo as a reader: files to a compiled model, with its messages about the authored lines, and nothing printed."""

from __future__ import annotations

import math
import re
import threading
import warnings as python_warnings
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.errors import AssetError
from meshforge.formats.meshfile import FARTHEST
from meshforge.formats.mjcf.files.flat import Flat, flatten
from meshforge.formats.mjcf.files.sources import Tree, gather
from meshforge.formats.mjcf.files.submodels import submodels

if TYPE_CHECKING:
    import mujoco

_ONE_AT_A_TIME = threading.RLock()  # where MuJoCo's messages go is a setting of the whole process
_LINE = re.compile(r"\bline (?:number=)?(\d+)", re.I)
_PARSER = re.compile(r"Error=\w+ ErrorID=\d+ \(0x\w+\) Line number=\d+: ")
_HEAD = re.compile(r"^(?:(?:(?:XML )?Error|XML parse error \d+)\s*:\s*)+", re.I)
_NAMELESS = re.compile(r"Element name '', id \d+(?:, line \d+)?\s*")
_NAMED = re.compile(r"Element (?:name )?'([^']*)'(?:, id \d+)?(?:, line \d+)?\s*")


@dataclass(frozen=True, eq=False, slots=True)
class Compiled:
    """A model, the spec it was compiled from, its bodies and geoms in the model's order, and what MuJoCo warned of."""

    spec: mujoco.MjSpec
    model: mujoco.MjModel
    bodies: tuple[mujoco.MjsBody, ...]
    geoms: tuple[mujoco.MjsGeom, ...]
    warnings: tuple[str, ...]


def compiled(main: Path, files: Mapping[Path, bytes] | None = None) -> mujoco.MjModel:
    """The model that MuJoCo makes of an MJCF; files: contents that count instead of those on disk, meshes too.

    Static bodies are not fused and visual geoms not discarded, whatever the compiler settings say.
    Raises AssetError with MuJoCo's message, at `file:line` where that is known.
    """
    tree = gather(main, files)
    return compile_flat(tree, flatten(tree)).model


def compile_flat(tree: Tree, flat: Flat) -> Compiled:
    """The model of a tree's text. Raises AssetError with MuJoCo's message."""
    warnings: list[str] = []
    spec = _parsed(tree, flat, warnings)
    return _compiled(tree, flat, spec, warnings)


def parse_flat(tree: Tree, flat: Flat) -> mujoco.MjSpec:
    """The spec of a tree's text, assets not yet read. Raises AssetError with MuJoCo's message."""
    return _parsed(tree, flat, [])


def compile_spec(tree: Tree, flat: Flat, spec: mujoco.MjSpec) -> Compiled:
    """The model of a spec. Raises AssetError with MuJoCo's message."""
    return _compiled(tree, flat, spec, [])


def _parsed(tree: Tree, flat: Flat, warnings: list[str]) -> mujoco.MjSpec:
    import mujoco

    with _heard(warnings), _files(tree, flat) as vfs:
        try:
            return mujoco.MjSpec.from_file(str(tree.main.path), vfs=vfs)
        except _failures() as error:
            raise _told(str(error), tree, flat) from None


def _compiled(tree: Tree, flat: Flat, spec: mujoco.MjSpec, warnings: list[str]) -> Compiled:
    bodies = tuple(spec.bodies)
    geoms = geoms_of(bodies)
    _refuse_unplaced(tree, flat, bodies, geoms)
    with _heard(warnings), _files(tree, flat) as vfs:
        try:
            model = spec.compile(vfs=vfs)
        except _failures() as error:
            raise _told(str(error), tree, flat) from None
    told = tuple(dict.fromkeys(_plain(warning) for warning in warnings))
    in_order = tuple(sorted(bodies, key=lambda body: body.id)), tuple(sorted(geoms, key=lambda geom: geom.id))
    return Compiled(spec, model, *in_order, told)


def geoms_of(bodies: Iterable[mujoco.MjsBody]) -> tuple[mujoco.MjsGeom, ...]:
    """The geoms of a spec's bodies; asked for all at once, MuJoCo takes the square of their number in time."""
    return tuple(geom for body in bodies for geom in body.geoms)


def _refuse_unplaced(
    tree: Tree, flat: Flat, bodies: tuple[mujoco.MjsBody, ...], geoms: tuple[mujoco.MjsGeom, ...]
) -> None:
    """Raise AssetError for a pose that is not of finite numbers, of which MuJoCo only warns, or beyond any size."""
    for kind, of_kind in (("body", bodies), ("geom", geoms)):
        for thing in of_kind:
            if problem := _unplaced(thing):
                node = flat.node_at(thing.info)
                where = tree.where(node) if node else str(tree.main.path)
                told = f"{kind} {thing.name!r}" if thing.name else f"a {kind} without a name"
                raise AssetError(problem.format(told), where=where)


def _unplaced(thing: mujoco.MjsBody | mujoco.MjsGeom) -> str | None:
    if not math.isfinite(thing.pos.sum() + thing.quat.sum()):
        return "the pose of {} is not of finite numbers"
    if max(map(abs, (*thing.pos, *getattr(thing, "size", ())))) > FARTHEST:
        return "the place or size of {} is larger than anything"
    return None


def _failures() -> tuple[type[Exception], ...]:
    import mujoco

    return (ValueError, RuntimeError, mujoco.FatalError, mujoco.UnexpectedError)


@contextmanager
def _files(tree: Tree, flat: Flat) -> Iterator[mujoco.MjVfs]:
    """The files that MuJoCo shall see instead of those on disk."""
    import mujoco

    with mujoco.MjVfs() as vfs:
        included = {source.path for source in tree.sources}
        seen = {path: data for path, data in tree.files.items() if path not in included}
        for path, data in (seen | submodels(tree, len(flat.nodes))).items():
            vfs[str(path)] = data
        vfs[str(tree.main.path)] = flat.text
        yield vfs


@contextmanager
def _heard(warnings: list[str]) -> Iterator[None]:
    """Warnings go into a list, neither to the console nor to a MUJOCO_LOG.TXT in the current folder."""
    import mujoco

    with _ONE_AT_A_TIME, python_warnings.catch_warnings(record=True) as raised:
        python_warnings.simplefilter("always")
        handler, config = mujoco.get_mju_user_warning(), mujoco.MjLogConfig.get()
        before = config.logto_console, config.logto_file
        config.logto_console = config.logto_file = False
        config.set()
        mujoco.set_mju_user_warning(warnings.append)
        try:
            yield
        finally:
            mujoco.set_mju_user_warning(handler)
            config.logto_console, config.logto_file = before
            config.set()
            warnings += [str(warning.message) for warning in raised]


def _told(message: str, tree: Tree, flat: Flat) -> AssetError:
    """MuJoCo's message in one line, about the authored file and line."""
    lines = [node for number in _LINE.findall(message) if (node := flat.node_at(f"line {number}"))]
    where = tree.where(lines[-1]) if lines else str(tree.main.path)
    return AssetError(f"MuJoCo refuses this file: {_plain(message)}", where=where)


def _plain(message: str) -> str:
    """A message of MuJoCo in one line, without the line numbers of our text."""
    text = _NAMELESS.sub("", _PARSER.sub("", _HEAD.sub("", message.strip())))
    return " ".join(_NAMED.sub(r"(element '\1') ", text).split())
