"""MuJoCo as a compiler: one text of all files, messages about the authored lines, nothing printed."""

from __future__ import annotations

import math
import os
import re
import threading
import warnings as python_warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

from meshforge.common import AssetError
from meshforge.formats.libraries import mujoco
from meshforge.formats.meshfile.surface import FARTHEST
from meshforge.formats.mjcf.document import MjcfNode, MjcfTree
from meshforge.formats.mjcf.references import AssetFolders, read_submodels
from meshforge.formats.xml import escape

_UNKNOWN_CLASS = "Write a <default> of that class inside the first <default>, or take the class from the element."
_LOCK = threading.RLock()  # where MuJoCo's messages go is a setting of the whole process
_LINE = re.compile(r"\bline (?:number=)?(\d+)", re.I)
_PARSER = re.compile(r"Error=\w+ ErrorID=\d+ \(0x\w+\) Line number=\d+: ")
_HEAD = re.compile(r"^(?:(?:(?:XML )?Error|XML parse error \d+)\s*:\s*)+", re.I)
_NAMELESS = re.compile(r"Element name '', id \d+(?:, line \d+)?\s*")
_NAMED = re.compile(r"Element (?:name )?'([^']*)'(?:, id \d+)?(?:, line \d+)?\s*")

KeepAttributes = Callable[[MjcfNode], Mapping[str, str] | None]
"""Which attributes of an element go into the text; None leaves the element out, with all below it."""

_FUSING = {"compiler": ("fusestatic", "discardvisual"), "body": ("fuse",)}
_SCALING = {"compiler": ("settotalmass", "alignfree"), "freejoint": ("align",), "joint": ("align",)}


@dataclass(frozen=True, eq=False, slots=True)
class Compilation:
    """A text, what MuJoCo made of it, its warnings, and its bodies and geoms in the order of the model."""

    flat: FlatText
    spec: mujoco.MjSpec
    model: mujoco.MjModel
    bodies: tuple[mujoco.MjsBody, ...]
    geoms: tuple[mujoco.MjsGeom, ...]
    warnings: tuple[str, ...]


def compile_text(flat: FlatText) -> Compilation:
    """Return what MuJoCo makes of a text. Raises AssetError with MuJoCo's message."""
    warnings: list[str] = []
    return compile_spec(flat, parse_text(flat, warnings), warnings)


def parse_text(flat: FlatText, warnings: list[str] | None = None) -> mujoco.MjSpec:
    """Return the spec of a text, assets not yet read; warnings: gets those of MuJoCo. Raises AssetError."""
    with collect_warnings([] if warnings is None else warnings), _provide_files(flat) as vfs:
        return mujoco.MjSpec.from_file(str(flat.tree.main.path), vfs=vfs)


def compile_spec(flat: FlatText, spec: mujoco.MjSpec, warnings: Sequence[str] = ()) -> Compilation:
    """Return the model of a spec; warnings: those that MuJoCo gave before. Raises AssetError with MuJoCo's message."""
    bodies = tuple(spec.bodies)
    geoms = geoms_of(bodies)
    for kind, of_kind in (("body", bodies), ("geom", geoms)):
        for thing in of_kind:
            _refuse_bad_pose(flat, kind, thing)
    every = list(warnings)
    with collect_warnings(every), _provide_files(flat) as vfs:
        model = spec.compile(vfs=vfs)
    messages = tuple(dict.fromkeys(_clean_message(warning) for warning in every))
    in_order = tuple(sorted(bodies, key=lambda body: body.id)), tuple(sorted(geoms, key=lambda geom: geom.id))
    return Compilation(flat, spec, model, *in_order, messages)


def geoms_of(bodies: Iterable[mujoco.MjsBody]) -> tuple[mujoco.MjsGeom, ...]:
    """Return the geoms of a spec's bodies; asked for all at once, MuJoCo takes the square of their number in time."""
    return tuple(geom for body in bodies for geom in body.geoms)


def _refuse_bad_pose(flat: FlatText, kind: str, thing: mujoco.MjsBody | mujoco.MjsGeom) -> None:
    """Raise AssetError for a pose that is not of finite numbers, of which MuJoCo only warns, or beyond any size."""
    called = f"{kind} {thing.name!r}" if thing.name else f"a {kind} without a name"
    if not math.isfinite(thing.pos.sum() + thing.quat.sum()):
        raise AssetError(f"the pose of {called} is not of finite numbers", where=flat.where(thing.info))
    if max(map(abs, (*thing.pos, *getattr(thing, "size", ())))) > FARTHEST:
        raise AssetError(f"the place or size of {called} is larger than anything", where=flat.where(thing.info))


def failure_types() -> tuple[type[Exception], ...]:
    """Return what MuJoCo raises."""
    return (ValueError, RuntimeError, mujoco.FatalError, mujoco.UnexpectedError)


@contextmanager
def _provide_files(flat: FlatText) -> Iterator[mujoco.MjVfs]:
    """The files of a text for MuJoCo. Raises AssetError with MuJoCo's message where it refuses what it reads."""
    tree = flat.tree
    included = {source.path for source in tree.sources}
    files = {path: data for path, data in tree.files.items() if path not in included}
    files |= read_submodels(tree, len(flat.nodes)) | {tree.main.path: flat.text}
    with mujoco.MjVfs() as vfs:
        for path, data in files.items():
            vfs[str(path)] = data
        try:
            yield vfs
        except failure_types() as error:
            message = str(error)
            lines = [number for number in _LINE.findall(message) if flat.node_at(f"line {number}")]
            where = flat.where(f"line {lines[-1]}" if lines else "")
            remedy = _UNKNOWN_CLASS if "unknown default class" in message else None
            problem = f"MuJoCo refuses this file: {_clean_message(message)}"
            raise AssetError(problem, where=where, remedy=remedy) from None


@contextmanager
def collect_warnings(warnings: list[str]) -> Iterator[None]:
    """Collect warnings in a list, neither to the console nor to a MUJOCO_LOG.TXT in the current folder."""
    with _LOCK, python_warnings.catch_warnings(record=True) as raised:
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


def _clean_message(message: str) -> str:
    text = _NAMELESS.sub("", _PARSER.sub("", _HEAD.sub("", message.strip())))
    return " ".join(_NAMED.sub(r"(element '\1') ", text).split())


@dataclass(frozen=True, eq=False, slots=True)
class FlatText:
    """The text of a tree, and its elements in order: that of line k is `nodes[k - 1]`."""

    tree: MjcfTree
    text: bytes
    nodes: tuple[MjcfNode, ...]

    def node_at(self, info: str) -> MjcfNode | None:
        """Return the element that MuJoCo means by `line 7`; None where that is a line of another file."""
        line = int(info.removeprefix("line ")) if info.startswith("line ") and info[5:].isdigit() else 0
        return self.nodes[line - 1] if 0 < line <= len(self.nodes) else None

    def where(self, info: str) -> str:
        """Return `file:line` of such an element; the main file where it is in another one."""
        node = self.node_at(info)
        return self.tree.where(node) if node else str(self.tree.main.path)


def flatten(tree: MjcfTree, keep: KeepAttributes | None = None) -> FlatText:
    """Return the text of a tree; keep: for a part of it.

    References of included files are made absolute where MuJoCo would find them beside the included file. Static
    bodies are not fused and visual geoms not discarded, whatever the compiler settings say.
    """
    folders = AssetFolders(tree)
    nodes: list[MjcfNode] = []
    parts: list[bytes] = []
    waiting: list[MjcfNode | bytes] = [tree.root]
    while waiting:
        entry = waiting.pop()
        if isinstance(entry, bytes):
            parts.append(entry)
        elif (attributes := entry.attributes if keep is None else keep(entry)) is not None:
            parts.append(_start_tag(folders, entry, attributes, first=not nodes))
            nodes.append(entry)
            waiting += [b"</%s>" % entry.tag.encode(), *reversed(entry.children)]
    return FlatText(tree, b"".join(parts), tuple(nodes))


def drop_scaling(node: MjcfNode) -> Mapping[str, str]:
    """Return the attributes without those that scale masses, or put frames of free bodies at their centres."""
    return {name: value for name, value in node.attributes.items() if name not in _SCALING.get(node.tag, ())}


def _start_tag(folders: AssetFolders, node: MjcfNode, attributes: Mapping[str, str], first: bool) -> bytes:
    parts = [b"<" if first else b"\n<", node.tag.encode()]
    for name, value in attributes.items():
        if name in _FUSING.get(node.tag, ()):
            continue
        if node.source and name.startswith("file") and (path := folders.path_beside_include(node, name)):
            value = os.fspath(path)
        parts.append(b' %s="%s"' % (name.encode(), escape(value)))
    return b"".join([*parts, b">"])
