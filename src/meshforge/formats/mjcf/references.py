"""The files that an MJCF refers to: where MuJoCo looks for them, which are missing, where copies of them go."""

import os
import posixpath
import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from meshforge.common import AssetError, MeshForgeError, is_beyond_reach, relative_name
from meshforge.formats.mesh_reader import read_content
from meshforge.formats.mjcf.document import MjcfDocument, MjcfNode, MjcfTree, read_tree
from meshforge.formats.references import add_copy, find_companions, note_absolute
from meshforge.symbolic import Asset

_OF_TEXTURE = tuple(f"file{side}" for side in ("", "right", "left", "up", "down", "front", "back"))
_REFERRING = {"mesh": "mesh", "hfield": "mesh", "skin": "mesh", "flexcomp": "mesh", "model": "", "texture": "texture"}
"""The elements with a `file`, and the folder in which it is looked for."""

_FACE = re.compile(rb"^[ \t]*f[ \t]+([^\r\n#]*)", re.M)
_VERTEX = re.compile(rb"^[ \t]*v[ \t]", re.M)
_GROUP = re.compile(rb"^[ \t]*[og](?=\s|$)", re.M)
_NUMBER = re.compile(rb"[+-]?\d+")
_HEADER, _RECORD = 84, 50  # bytes of a binary STL: before the first triangle, and each
_MOST_TRIANGLES = 200_000  # triangles of an STL that MuJoCo takes
_LEAST_VERTICES = 4  # vertices


class AssetFolders:
    """Where the files of a tree are, as its `<compiler>` elements say; of several, each counts in its turn."""

    def __init__(self, tree: MjcfTree) -> None:
        self.tree, self.main = tree, tree.main.path.parent
        self.mesh = self.texture = strip = ""
        for compiler in tree.root.each("compiler"):
            attributes = compiler.attributes
            assets = attributes.get("assetdir")
            self.mesh = attributes.get("meshdir", self.mesh if assets is None else assets)
            self.texture = attributes.get("texturedir", self.texture if assets is None else assets)
            strip = attributes.get("strippath", strip)
        self.strip = strip == "true"

    def find(self, node: MjcfNode, attribute: str = "file") -> Path:
        """Return where the file of an attribute is, or would be."""
        beside = self.path_beside_include(node, attribute)
        reference = str(beside or node.attributes[attribute].replace("\\", "/"))
        if self.strip:
            reference = Path(reference).name
        return self._join(self._folder(node), reference)

    def place(self, node: MjcfNode, attribute: str = "file") -> str | None:
        """Return where the file of an attribute goes beside a main file in another folder, None for an absolute place.

        As references say, not as the disk is: `../cup/a.stl` stays so, whatever the main file's folder is called.
        """
        if beside := self.path_beside_include(node, attribute):
            return relative_name(beside, self.main)
        folder, reference = (text.replace("\\", "/") for text in (self._folder(node), node.attributes[attribute]))
        if Path(folder).is_absolute() or (Path(reference).is_absolute() and not self.strip):
            return None
        return posixpath.normpath(posixpath.join(folder, posixpath.basename(reference) if self.strip else reference))

    def path_beside_include(self, node: MjcfNode, attribute: str = "file") -> Path | None:
        """Return the path of a file beside the included file that refers to it, None where the usual place counts."""
        reference = node.attributes[attribute].replace("\\", "/")
        usual = self._join(self._folder(node), reference)
        if not node.source or Path(reference).is_absolute() or self.tree.has(usual):
            return None
        return Path(os.path.normpath(self.tree.sources[node.source].path.parent / reference))

    def _folder(self, node: MjcfNode) -> str:
        return {"mesh": self.mesh, "texture": self.texture}.get(_REFERRING.get(node.tag, ""), "")

    def _join(self, folder: str, reference: str) -> Path:
        return Path(os.path.normpath(self.main / folder / reference))


@dataclass(frozen=True, eq=False, slots=True)
class FileReference:
    """A file that an element refers to.

    text: as it says; tree: in which the element is, the model's own or that of a sub-model; path: where the file is, or
    would be; place: where it goes, see `AssetFolders.place`; is_there: whether it is; model: of a new sub-model.
    """

    text: str
    node: MjcfNode
    tree: MjcfTree
    path: Path
    place: str | None
    is_there: bool
    model: MjcfTree | None = None


def list_references(tree: MjcfTree, seen: set[Path] | None = None) -> Iterator[FileReference]:
    """Yield the files that elements refer to, in document order, those of a sub-model right behind it.

    Raises AssetError for one that lies where reading is not allowed to go, before anything looks into it.
    """
    seen = {tree.main.path} if seen is None else seen
    folders = AssetFolders(tree)
    for node in tree.root.walk():
        for attribute in _OF_TEXTURE if node.tag == "texture" else ("file",) if node.tag in _REFERRING else ():
            if not (text := node.attributes.get(attribute)):
                continue
            path = folders.find(node, attribute)
            if is_beyond_reach(path):
                raise AssetError(f"the file {text!r} is not there", where=tree.where(node))
            place, is_there, model = folders.place(node, attribute), tree.has(path), None
            if node.tag == "model" and is_there and path not in seen:
                seen.add(path)
                with suppress(MeshForgeError):  # of another format than MJCF, or one that MuJoCo complains of
                    model = read_tree(path)
            yield FileReference(text, node, tree, path, place, is_there, model)
            if model is not None:
                yield from list_references(model, seen)


def find_files(tree: MjcfTree) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """Return all files but the main one, with companions, in order of mention; and references without a file."""
    trees, found, missing = [tree], list[Path](), dict[str, None]()
    for reference in list_references(tree):
        if not reference.is_there:
            missing[reference.text] = None
        elif reference.node.tag == "model":
            found.append(reference.path)
        else:
            found += [reference.path, *find_companions(reference.path).values()]
        if reference.model is not None:
            trees.append(reference.model)
    included = [source.path for own in trees for source in own.sources]
    files = dict.fromkeys([*included, *found])
    files.pop(tree.main.path, None)
    return tuple(files), tuple(missing)


def read_submodels(tree: MjcfTree, lines: int) -> dict[Path, bytes]:
    """Return the texts of all sub-models, moved down below line `lines`, so that no line is one of the model's."""
    models = {reference.path: reference.model for reference in list_references(tree)}
    return {path: b"\n" * lines + model.main.text.data for path, model in models.items() if model is not None}


def output_places(tree: MjcfTree) -> list[str | None]:
    """Return where each authored file goes, relative to the main one's folder; None: at an absolute path.

    As the `<include>` says, not as the disk is: `../kettle/body.xml` stays so, whatever the main folder's name.
    """
    found: list[str | None] = [tree.main.path.name]
    main = tree.main.path.parent
    for source in tree.sources[1:]:
        place = posixpath.normpath(source.reference.replace("\\", "/"))
        from_main = Path(os.path.normpath(main / place)) == source.path
        found.append(None if source.place is None else place if from_main else source.place)
    return found


def list_copies(asset: Asset, tree: MjcfTree) -> tuple[dict[str, Path], list[str]]:
    """Return the files besides the authored ones; and notes on those that stay where they are.

    Raises AssetError where two of them would become one.
    """
    found: dict[str, Path] = {}
    far: dict[Path, str] = {}
    for reference in _list_to_copy(tree):
        if reference.place is None:
            far[reference.path] = reference.text
            far |= dict.fromkeys(find_companions(reference.path).values(), "")
        else:
            add_copy(found, reference.place, reference.path)
    known = {*found.values(), *far, *(source.path for source in tree.sources)}
    for path in asset.files:  # those of sub-models
        if path not in known:
            found.setdefault(relative_name(path, tree.main.path.parent), path)
    absolute = dict.fromkeys(text for text in far.values() if text)
    return found, [note_absolute(text) for text in absolute]


def _list_to_copy(tree: MjcfTree) -> list[FileReference]:
    """The references to files that are there, of sub-models those at absolute places alone."""
    return [r for r in list_references(tree) if r.is_there and (r.tree is tree or r.place is None)]


def top_folder(document: MjcfDocument) -> Path:
    """Return the highest folder that references pass through, from the main file's folder."""
    tree = document.tree
    meshes = posixpath.normpath(posixpath.join(AssetFolders(tree).mesh.replace("\\", "/"), "hull.obj"))
    named = [meshes, *output_places(tree), *(reference.place for reference in _list_to_copy(tree))]
    ups = max(place.split("/").count("..") for place in named if place)
    return [tree.main.path.parent, *tree.main.path.parent.parents][ups]


def is_shown_whole(path: Path) -> bool:
    """Return whether MuJoCo shows all triangles of a mesh file.

    Of an OBJ it shows the first group alone, and refuses corners of different kinds; of STLs it takes binary ones.
    """
    try:
        data = read_content(path)
    except MeshForgeError:
        return False
    if path.suffix.lower() == ".stl":
        count = int.from_bytes(data[_HEADER - 4 : _HEADER], "little")
        return len(data) == _HEADER + count * _RECORD and _LEAST_VERTICES <= 3 * count <= 3 * _MOST_TRIANGLES
    first = _FACE.search(data)
    if path.suffix.lower() != ".obj" or first is None or b"\\\n" in data or _GROUP.search(data, first.end()):
        return False
    kinds = {_NUMBER.sub(b"1", corner) for face in _FACE.findall(data) for corner in face.split()}
    return len(kinds) == 1 and len(_VERTEX.findall(data[:_MOST_TRIANGLES])) >= _LEAST_VERTICES
