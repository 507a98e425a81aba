"""Files that a file refers to: where a reference leads, what a mesh needs beside it, where each goes in an output."""

import os
import posixpath
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote, urlsplit

from meshforge.common import AssetError, is_file, nearest_name
from meshforge.formats.meshfile.gltf_document import entries, parse_json, report_damage
from meshforge.formats.xml import Element

_PACKAGE = re.compile(r"(?:package|model)://+([^/]+)/(.*)", re.S)
_FILE = re.compile(r"file:(?://[^/]*(?=/)|//)?(.*)", re.S)
_LONG = 100  # characters of a name in a message
_NAME = re.compile(rb"<name>\s*([^<\s]+)\s*</name>")


@dataclass(frozen=True, slots=True)
class Resolver:
    """Finds referenced files from the folder of the description and the given package roots, both absolute."""

    folder: Path
    roots: tuple[Path, ...] = ()

    def find(self, reference: str) -> Path | None:
        """Return the file a reference leads to, None where it is not there."""
        return next((path for path in self.candidates(reference) if is_file(path)), None)

    def candidates(self, reference: str) -> Iterator[Path]:
        """Yield the places where the file may be, likeliest first; none for an address in the network."""
        reference = reference.strip()
        if package := _PACKAGE.fullmatch(reference):
            yield from (self._join(home, package[2]) for home in self._homes(package[1]))
        elif file := _FILE.fullmatch(reference):
            yield self._join(self.folder, unquote(file[1]))
        elif reference and not is_address(reference):
            yield self._join(self.folder, reference)
            if "\\" in reference:
                yield self._join(self.folder, reference.replace("\\", "/"))

    def place(self, reference: str) -> str | None:
        """Return where the file of a reference goes in an output: `placement`."""
        return placement(reference)

    def find_package(self, package: str) -> Path | None:
        """Return the folder of a package, None where it is not there."""
        return next((home for home in self._homes(package) if home.is_dir()), None)

    def _homes(self, package: str) -> Iterator[Path]:
        """Where a package may be, in the given roots, then upwards: by a folder's name, or by its package.xml."""
        for root in (*self.roots, self.folder, *self.folder.parents):
            yield root / package
            if root.name == package or _read_package_name(root) == package:
                yield root

    @staticmethod
    def _join(folder: Path, rest: str) -> Path:
        return Path(os.path.normpath(folder / rest))

    def advice(self, reference: str) -> str:
        """Return where the file of a reference was looked for, and what to do about it."""
        reference = reference.strip()
        if is_address(reference):
            return "Addresses are not followed: download the file and refer to the copy."
        if "$(" in reference or "${" in reference:
            return "This is a xacro expression: expand the file with xacro first."
        if reference.startswith(("package:", "model:")) and not _PACKAGE.fullmatch(reference):
            return "Write package://NAME/PATH."
        looked = list(self.candidates(reference))
        like = next((near for path in looked if (near := _find_similar(path))), None)
        hint = f" A file of a similar name is there: {like}." if like else ""
        if package := _PACKAGE.fullmatch(reference):
            homes = [home for home in self._homes(package[1]) if home.is_dir()]
            if homes:
                return f"The package {package[1]!r} is at {homes[0]}, but holds no such file.{hint}"
            is_model = reference.startswith("model:")
            roots = f", nor in {', '.join(map(str, self.roots))}" if self.roots else ""
            return (
                f"No folder {package[1]!r} is in {self.folder} or above it{roots}. "
                f"Put the folder that holds it on {'GZ_SIM_RESOURCE_PATH' if is_model else 'ROS_PACKAGE_PATH'}."
            )
        if unusual := next((path for path in looked if os.path.lexists(path)), None):
            return f"{unusual} is no file, or a link that leads nowhere."
        parts = [[name if len(name) <= _LONG else f"{name[:_LONG]}..." for name in path.parts] for path in looked]
        places = " and ".join(str(Path(*names)) for names in parts)
        return f"Looked for {places}.{hint} Put it there, or correct the reference."


def is_address(reference: str) -> bool:
    """Return whether a reference leads into the network."""
    return urlsplit(reference).scheme in ("http", "https", "ftp") if "://" in reference else False


def placement(reference: str) -> str | None:
    """Return where the file of a reference goes, relative to the folder of the written URDF, so that it is found there.

    None for an absolute reference, which is found wherever the URDF lies, and for an address.
    """
    reference = reference.strip()
    if package := _PACKAGE.fullmatch(reference):
        reference = f"{package[1]}/{package[2]}"
    elif _FILE.fullmatch(reference) or Path(reference).is_absolute() or is_address(reference):
        return None
    return posixpath.normpath(reference.replace("\\", "/"))


def _read_package_name(folder: Path) -> str | None:
    try:
        found = _NAME.search((folder / "package.xml").read_bytes()[:10_000])
    except OSError:
        return None
    return found[1].decode("utf-8", "replace") if found else None


def _find_similar(path: Path) -> Path | None:
    try:
        entries = [entry for entry in path.parent.iterdir() if entry.suffix.lower() == path.suffix.lower()]
        names = sorted(entry.name for entry in entries if entry.is_file())
    except (OSError, ValueError):
        return None
    cased = next((name for name in names if name.lower() == path.name.lower()), None)
    like = cased or nearest_name(path.name, names)
    return path.parent / like if like else None


_LIBRARY = re.compile(rb"mtllib[ \t]+([^\r\n]+)")  # at the start of a line; asking for that here takes 50 times as long
_MAP = re.compile(rb"^[ \t]*(?:map_\w+|bump|disp|decal|refl|norm)[ \t]+([^\r\n]+)", re.M | re.I)
_IMAGE = re.compile(rb"<init_from[^>]*>\s*(?:<ref>)?\s*([^<]+?)\s*<")
_GLB_HEADER = 20  # bytes: magic, version, length; length and type of the chunk of JSON


def find_companions(mesh: Path) -> dict[str, Path]:
    """Return the files beside a mesh file that it refers to and that are there, by their path relative to its folder.

    An OBJ's material libraries and their textures, a Collada file's images, a glTF file's buffers and images.
    Never raises for what the file holds: what cannot be understood has no companions.
    """
    found: dict[str, Path] = {}
    for reference in _find_references(mesh):
        _add_files(found, mesh.parent, "", reference)
    for key, library in [(k, p) for k, p in found.items() if p.suffix.lower() == ".mtl"]:
        for reference in _find_matches(_MAP, _read_or_empty(library)):
            _add_files(found, mesh.parent, posixpath.dirname(key), reference)
    return found


def reference_of(mesh: Element) -> str:
    """Return the reference of a `<mesh>` of URDF or SDF, which up to version 1.2 called it `<filename>`; else empty."""
    child = mesh.first("uri") or mesh.first("filename")
    return child.text if child else mesh.attributes.get("filename", "").strip()


def find_all(references: Iterable[str], resolver: Resolver) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """Return the files of references that are there, with their companions, and the references that lead nowhere."""
    found = {reference: resolver.find(reference) for reference in references}
    paths = [path for path in found.values() if path is not None]
    files = dict.fromkeys(file for path in paths for file in (path, *find_companions(path).values()))
    return tuple(files), tuple(reference for reference, path in found.items() if path is None)


def add_copy(copies: dict[str, Path], place: str, path: Path, remedy: str = "Rename one of them.") -> None:
    """Copy a file, with its companions, to a place in an output. Raises AssetError where another file goes there."""
    if copies.setdefault(place, path) != path:
        raise AssetError(f"{copies[place]} and {path} would both become {place!r}", where=str(path), remedy=remedy)
    for key, companion in find_companions(path).items():
        copies.setdefault(posixpath.normpath(posixpath.join(posixpath.dirname(place), key)), companion)


def collect_copies(
    found: Iterable[tuple[str, str | None, Path | None]], remedy: str
) -> tuple[dict[str, Path], list[str]]:
    """Return the files of an output by their places, and notes on those that stay where they are.

    found: each reference with its place, None for an absolute one, and its file, None for one that is made or missing.
    Raises AssetError where two files would become one.
    """
    copies, notes = dict[str, Path](), list[str]()
    for reference, place, path in found:
        if path is not None and place is not None:
            add_copy(copies, place, path, remedy)
        elif path is not None:
            notes.append(note_absolute(reference))
    return copies, notes


def note_absolute(reference: str) -> str:
    """Return the note on a file that is not copied."""
    return f"{reference!r} is an absolute reference: the file is used where it is, not copied"


def _find_references(mesh: Path) -> Iterator[str]:
    match mesh.suffix.lower():
        case ".obj":
            data = _read_or_empty(mesh)
            for found in _LIBRARY.finditer(data):
                if not data[data.rfind(b"\n", 0, found.start()) + 1 : found.start()].strip(b" \t"):
                    yield found[1].decode("utf-8", "replace").strip()
        case ".dae":
            yield from (unquote(text.removeprefix("file://")) for text in _find_matches(_IMAGE, _read_or_empty(mesh)))
        case ".gltf" | ".glb":
            yield from map(unquote, _find_uris(mesh))


def _find_matches(pattern: re.Pattern[bytes], data: bytes) -> Iterator[str]:
    for found in pattern.finditer(data):
        yield found[1].decode("utf-8", "replace").strip()


def _find_uris(mesh: Path) -> Iterator[str]:
    data = _read_or_empty(mesh)
    if data[:4] == b"glTF":
        data = data[_GLB_HEADER : _GLB_HEADER + int.from_bytes(data[12:16], "little")]
    try:
        with report_damage(str(mesh)):
            scene = parse_json(data)
            things = [thing for kind in ("buffers", "images") for thing in entries(scene, kind)]
            uris = [thing["uri"] for thing in things if "uri" in thing]
    except AssetError:
        return
    yield from (uri for uri in uris if isinstance(uri, str) and not uri.startswith("data:"))


def _add_files(found: dict[str, Path], folder: Path, inside: str, reference: str) -> None:
    """Add what a reference names: a file whose name may hold blanks, else those of its words that are files.

    A line of an OBJ may name several libraries; options may stand before the name of a texture.
    """
    for text in (reference, *reference.split()):
        key = posixpath.normpath(posixpath.join(inside, text.replace("\\", "/")))
        path = Path(os.path.normpath(folder / key))
        if text and not posixpath.isabs(key) and "\0" not in key and is_file(path):
            found.setdefault(key, path)
            if text == reference:
                return


def _read_or_empty(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError:
        return b""
