"""The files that an MJCF refers to: where MuJoCo looks for them, which are missing, where copies of them go."""

from __future__ import annotations

import os
import posixpath
import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from meshforge.common import AssetError, MeshForgeError, is_beyond_reach, is_file, relative_name
from meshforge.formats.mesh_reader import read_content
from meshforge.formats.mjcf.document import MjcfDocument, MjcfNode, MjcfTree, read_tree
from meshforge.formats.references import add_copy, find_companions, note_absolute
from meshforge.symbolic import Asset

_OF_TEXTURE = tuple(f"file{side}" for side in ("", "right", "left", "up", "down", "front", "back"))
_REFERRING = {"mesh": "mesh", "hfield": "mesh", "skin": "mesh", "flexcomp": "mesh", "model": "", "texture": "texture"}
"""The elements with a `file`, and the folder in which it is looked for."""

_FACE = re.compile(rb"^[ \t]*f[ \t]+([^\r\n#]*)", re.M)
_GROUP = re.compile(rb"^[ \t]*[og](?=\s|$)", re.M)
_NUMBER = re.compile(rb"[+-]?\d+")
_HEADER, _RECORD = 84, 50  # bytes of a binary STL: before the first triangle, and each
_MOST_TRIANGLES = 200_000  # triangles of an STL that MuJoCo takes
_LEAST_VERTICES = 4  # vertices


@dataclass(frozen=True, slots=True)
class AssetFolders:
    """What the `<compiler>` says about where files are; of several, each counts in its turn."""

    main: Path
    mesh: str
    texture: str
    strip: bool

    @staticmethod
    def of(tree: MjcfTree) -> AssetFolders:
        mesh = texture = strip = ""
        for compiler in tree.root.each("compiler"):
            attributes = compiler.attributes
            mesh, texture = attributes.get("assetdir", mesh), attributes.get("assetdir", texture)
            mesh, texture = attributes.get("meshdir", mesh), attributes.get("texturedir", texture)
            strip = attributes.get("strippath", strip)
        return AssetFolders(tree.main.path.parent, mesh, texture, strip == "true")

    def find(self, tree: MjcfTree, node: MjcfNode, attribute: str = "file") -> Path:
        """Where the file of an attribute is, or would be."""
        beside = self.path_beside_include(tree, node, attribute)
        reference = str(beside or node.attributes[attribute].replace("\\", "/"))
        if self.strip:
            reference = Path(reference).name
        return self._join(self._folder(node), reference)

    def place(self, tree: MjcfTree, node: MjcfNode, attribute: str = "file") -> str | None:
        """Where the file of an attribute goes beside a main file in another folder, None for an absolute place.

        As references say, not as the disk is: `../cup/a.stl` stays so, whatever the main file's folder is called.
        """
        if beside := self.path_beside_include(tree, node, attribute):
            return relative_name(beside, self.main)
        folder, reference = (text.replace("\\", "/") for text in (self._folder(node), node.attributes[attribute]))
        if Path(folder).is_absolute() or (Path(reference).is_absolute() and not self.strip):
            return None
        return posixpath.normpath(posixpath.join(folder, posixpath.basename(reference) if self.strip else reference))

    def path_beside_include(self, tree: MjcfTree, node: MjcfNode, attribute: str) -> Path | None:
        """The path of a file beside the included file that refers to it, None where the usual place counts."""
        reference = node.attributes[attribute].replace("\\", "/")
        if not node.source or Path(reference).is_absolute() or tree.has(self._join(self._folder(node), reference)):
            return None
        return Path(os.path.normpath(tree.sources[node.source].path.parent / reference))

    def _folder(self, node: MjcfNode) -> str:
        return {"mesh": self.mesh, "texture": self.texture, "": ""}[_REFERRING.get(node.tag, "")]

    def _join(self, folder: str, reference: str) -> Path:
        return Path(os.path.normpath(self.main / folder / reference))


def iterate_file_references(tree: MjcfTree) -> Iterator[tuple[MjcfNode, str]]:
    """The elements that refer to a file, and by which attribute, in document order."""
    for node in tree.root.walk():
        if node.tag in _REFERRING:
            for attribute in _OF_TEXTURE if node.tag == "texture" else ("file",):
                if node.attributes.get(attribute):
                    yield node, attribute


def refuse_beyond_reach(tree: MjcfTree) -> None:
    """Raise AssetError for a file that lies where reading is not allowed to go, before MuJoCo looks for it."""
    waiting, seen = [tree], {tree.main.path}
    while waiting:
        inner = waiting.pop()
        folders = AssetFolders.of(inner)
        for node, attribute in iterate_file_references(inner):
            path, reference = folders.find(inner, node, attribute), node.attributes[attribute]
            if is_beyond_reach(path):
                raise AssetError(f"the file {reference!r} is not there", where=inner.where(node))
            if node.tag == "model" and path not in seen and is_file(path):
                seen.add(path)
                with suppress(MeshForgeError):  # of another format than MJCF, or one that MuJoCo complains of
                    waiting.append(read_tree(path))


def find_files(tree: MjcfTree) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """The files but for the main one, with their companions, in order of mention; and references without a file."""
    files: dict[Path, None] = {}
    missing: dict[str, None] = {}
    _add_files(tree, files, missing)
    files.pop(tree.main.path, None)
    return tuple(files), tuple(missing)


def _add_files(tree: MjcfTree, files: dict[Path, None], missing: dict[str, None]) -> None:
    folders = AssetFolders.of(tree)
    files |= dict.fromkeys(source.path for source in tree.sources)
    for node, attribute in iterate_file_references(tree):
        path = folders.find(tree, node, attribute)
        if not tree.has(path):
            missing[node.attributes[attribute]] = None
        elif node.tag == "model":
            if path not in files:
                _add_model(path, files, missing)
        else:
            files |= dict.fromkeys([path, *find_companions(path).values()])
    files |= dict.fromkeys(_plugin_files(tree))


def _add_model(path: Path, files: dict[Path, None], missing: dict[str, None]) -> None:
    files[path] = None
    try:
        _add_files(read_tree(path), files, missing)
    except MeshForgeError:  # of another format than MJCF
        return


def _plugin_files(tree: MjcfTree) -> Iterator[Path]:
    for node in tree.root.walk():
        value = node.attributes.get("value", "") if node.tag == "config" else ""
        if value and "\0" not in value:
            path = Path(os.path.normpath(tree.main.path.parent / value))
            if is_file(path):
                yield path


def read_submodels(tree: MjcfTree, lines: int) -> dict[Path, bytes]:
    """The texts of all sub-models, moved down below line `lines`, so that no line is one of the model's own text."""
    found: dict[Path, bytes] = {}
    waiting = [tree]
    while waiting:
        for path in find_submodels(waiting.pop()):
            if path in found:
                continue
            try:
                inner = read_tree(path)
            except MeshForgeError:  # MuJoCo says what is wrong with it, or reads it in another way
                continue
            found[path] = b"\n" * lines + inner.main.text.data
            waiting.append(inner)
    return found


def find_submodels(tree: MjcfTree) -> Iterator[Path]:
    """The files of the `<model>` assets of a tree that are there."""
    folders = AssetFolders.of(tree)
    for node in tree.root.walk():
        if node.tag == "model" and node.attributes.get("file"):
            path = folders.find(tree, node)
            if is_file(path):
                yield path


def output_places(tree: MjcfTree) -> list[str | None]:
    """Where each of the authored files goes, relative to the main one's folder; None for one at an absolute path.

    As the `<include>` says, not as the disk is: `../kettle/body.xml` stays so, whatever the main file's folder is
    called.
    """
    found: list[str | None] = [tree.main.path.name]
    main = tree.main.path.parent
    for source in tree.sources[1:]:
        place = posixpath.normpath(source.reference.replace("\\", "/"))
        from_main = Path(os.path.normpath(main / place)) == source.path
        found.append(None if source.place is None else place if from_main else source.place)
    return found


def list_copies(asset: Asset, tree: MjcfTree) -> tuple[dict[str, Path], list[str]]:
    """The files besides the authored ones; and notes on those that stay where they are.

    Raises AssetError where two of them would become one.
    """
    found: dict[str, Path] = {}
    far: dict[Path, str] = {}
    for place, path, reference in _locate_references(tree):
        if place is None:
            far[path] = reference
            far |= dict.fromkeys(find_companions(path).values(), "")
        else:
            add_copy(found, place, path)
    known = {*found.values(), *far, *(source.path for source in tree.sources)}
    for path in asset.files:  # those of sub-models and plugins
        if path not in known:
            found.setdefault(relative_name(path, tree.main.path.parent), path)
    absolute = dict.fromkeys(reference for reference in far.values() if reference)
    return found, [note_absolute(reference) for reference in absolute]


def top_folder(document: MjcfDocument) -> Path:
    """The highest folder that references pass through, from the main file's folder."""
    tree = document.tree
    meshes = posixpath.normpath(posixpath.join(AssetFolders.of(tree).mesh.replace("\\", "/"), "hull.obj"))
    named = [meshes, *output_places(tree), *(place for place, _, _ in _locate_references(tree))]
    ups = max(place.split("/").count("..") for place in named if place)
    return [tree.main.path.parent, *tree.main.path.parent.parents][ups]


def _locate_references(tree: MjcfTree) -> Iterator[tuple[str | None, Path, str]]:
    """Where each referenced file goes, None for one at an absolute path; where it is; how it is referred to."""
    folders = AssetFolders.of(tree)
    for node, attribute in iterate_file_references(tree):
        path = folders.find(tree, node, attribute)
        if tree.has(path):
            yield folders.place(tree, node, attribute), path, node.attributes[attribute]
            if node.tag == "model":
                yield from _absolute_references(path)


def _absolute_references(path: Path) -> Iterator[tuple[str | None, Path, str]]:
    try:
        yield from (found for found in _locate_references(read_tree(path)) if found[0] is None)
    except MeshForgeError:  # of another format than MJCF
        return


def is_shown_whole(path: Path) -> bool:
    """Whether MuJoCo shows all triangles of a mesh file.

    Of an OBJ it shows the first group alone, and refuses corners of different kinds; of STLs it takes binary ones.
    """
    try:
        data = read_content(path)
    except MeshForgeError:
        return False
    match path.suffix.lower():
        case ".obj":
            return _is_one_group(data) and _is_uniform(data)
        case ".stl":
            count = int.from_bytes(data[_HEADER - 4 : _HEADER], "little")
            return len(data) == _HEADER + count * _RECORD and _LEAST_VERTICES <= 3 * count <= 3 * _MOST_TRIANGLES
        case _:
            return False


def _is_one_group(data: bytes) -> bool:
    first = _FACE.search(data)
    return first is not None and b"\\\n" not in data and _GROUP.search(data, first.end()) is None


def _is_uniform(data: bytes) -> bool:
    """Whether all corners of an OBJ name vertices, texture coordinates and normals alike, of enough vertices."""
    kinds = {_NUMBER.sub(b"1", corner) for face in _FACE.findall(data) for corner in face.split()}
    enough = len(re.findall(rb"^[ \t]*v[ \t]", data[:_MOST_TRIANGLES], re.M)) >= _LEAST_VERTICES
    return len(kinds) == 1 and enough
