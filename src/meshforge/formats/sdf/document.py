"""What is kept of an SDF to write it back: its files, their references, roots and versions, and `model.config`."""

import os
import posixpath
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from meshforge.common import AssetError, is_file
from meshforge.formats.collision_pieces import CollisionElement
from meshforge.formats.references import Resolver, placement, reference_of
from meshforge.formats.xml import Element, SourceFile, XmlText, parse_numbers, parse_xml
from meshforge.symbolic import Document

Version = tuple[int, int]
OLDEST: Version = (1, 2)
"""The first with elements as they are now; 1.0 had attributes."""
NEWEST: Version = (1, 12)
AXIS_IN_JOINT: Version = (1, 5)
"""From here on the axis of a joint is given in the joint's frame, not in the model's."""
ROUND_SHAPES: Version = (1, 8)
"""From here on there are capsules and ellipsoids."""

_VERSION_TEXT = re.compile(r"\s*(\d{1,4})\.(\d{1,4})\s*")

_MODEL = re.compile(r"(?:package|model)://+([^/]+)/(.*)", re.S)
_FILE = "file://"

VISUAL_SUFFIXES = (".obj", ".stl", ".dae", ".glb", ".gltf")
"""The mesh files that Gazebo reads."""
CONFIG = "model.config"
"""The file that makes a folder a Gazebo model."""
_USUAL_NAME = "model.sdf"

_MAPS = (
    *("albedo_map", "normal_map", "roughness_map", "metalness_map", "emissive_map", "light_map"),
    *("environment_map", "ambient_occlusion_map", "glossiness_map", "specular_map", "diffuse", "normal"),
)
_BUILT_IN = ("file://media/", "__default__")
"""References to what Gazebo brings along."""

_MOST_SCRIPTS = 1000  # files of one folder of material scripts


def parse_version(text: str) -> Version | None:
    """Return the version in a text, None where there is none."""
    found = _VERSION_TEXT.fullmatch(text)
    return (int(found[1]), int(found[2])) if found else None


ElementPlace = tuple[int, int]
"""Where an element is: the number of its file, and the byte offset in that file's text."""


@dataclass(frozen=True, eq=False, slots=True)
class SdfDocument(Document):
    """The source of an asset read from an SDF.

    sources: the files, main first; authored: one entry a `<collision>`, and `at`, where that is; links: the element of
    each link by the name of its body; worlds: the names of worlds in the file, which is read only then; digests: of
    mesh files that hold several pieces.
    """

    sources: "tuple[SdfSource, ...]"
    authored: tuple[CollisionElement, ...]
    at: tuple[ElementPlace, ...]
    links: dict[str, ElementPlace]
    worlds: tuple[str, ...] = ()
    digests: tuple[tuple[Path, str], ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class SdfSource(SourceFile):
    """An authored file; resolver: finds what it refers to; count: how often it is included."""

    resolver: "ModelResolver"
    count: int = 1


@dataclass(frozen=True, slots=True)
class ModelResolver(Resolver):
    """Finds what a file refers to, from its folder, upwards, and in the roots."""

    def candidates(self, reference: str) -> Iterator[Path]:
        """Yield the places where the file may be; without a model of that name, in this one, under another name."""
        reference = reference.strip()
        rest = reference.removeprefix(_FILE)
        if rest != reference and not rest.startswith("/"):  # Gazebo takes it for a path
            yield self._join(self.folder, rest)
        yield from Resolver.candidates(self, reference)
        if model := _MODEL.fullmatch(reference):
            yield self._join(self.folder, model[2])

    def place(self, reference: str) -> str | None:
        """Return where the file goes in an output: what is in the model's own folder stays there."""
        reference = reference.strip()
        rest = reference.removeprefix(_FILE)
        if rest != reference and not rest.startswith("/") and self.find(reference) == self._join(self.folder, rest):
            return posixpath.normpath(rest)
        model = _MODEL.fullmatch(reference)
        if model and self._is_own(model[1], model[2]):
            return posixpath.normpath(model[2])
        return placement(reference)

    def _is_own(self, name: str, rest: str) -> bool:
        found = next((path for path in Resolver.candidates(self, f"model://{name}/{rest}") if is_file(path)), None)
        if found is not None:
            return found == self._join(self.folder, rest)
        return self.folder.name == name or not any(home.is_dir() for home in self._homes(name))

    def find_model_file(self, reference: str) -> Path | None:
        """Return the file of a model that an `<include>` names, maybe by its folder; None where it is not there.

        Raises AssetError: the folder's `model.config` is no XML.
        """
        reference = reference.strip().rstrip("/")
        if (path := next((p for p in Resolver.candidates(self, reference) if is_file(p)), None)) is not None:
            return path
        for beside in self.candidates(f"{reference}/{CONFIG}"):
            if (path := find_main_file(beside.parent)) is not None:
                return path
        return None

    def advise_on_model(self, reference: str) -> str:
        """Return where the model of an `<include>` was looked for, and what to do about it."""
        is_folder = reference.strip().startswith("model:") and not _MODEL.fullmatch(reference.strip())
        return self.advice(f"{reference.strip()}/model.sdf" if is_folder else reference)


def find_main_file(folder: Path) -> Path | None:
    """Return the SDF file of a model's folder: the newest known version in `model.config`, or `model.sdf`.

    None where there is none. Raises AssetError: `model.config` is no XML.
    """
    named = sorted(read_versions(folder).items(), reverse=True)
    names = [name for version, name in named if version <= NEWEST] or [name for _, name in named]
    found = (Path(os.path.normpath(folder / name)) for name in (*names, _USUAL_NAME))
    return next((path for path in found if is_file(path)), None)


def is_main_file(path: Path) -> bool:
    """Return whether a file is the one of its folder's model, or none of those that `model.config` names."""
    try:
        named = read_versions(path.parent)
        return path.name not in named.values() or find_main_file(path.parent) == path
    except AssetError:
        return True


def read_versions(folder: Path) -> dict[tuple[int, int], str]:
    """Return the files that a folder's `model.config` names, by their versions of SDF."""
    path = folder / CONFIG
    if not is_file(path):
        return {}
    try:
        root = parse_xml(XmlText.of(path.read_bytes()).data, str(path))
    except OSError as error:
        raise AssetError(f"cannot be read: {error.strerror}", where=str(path)) from error
    return {parse_version(e.attributes.get("version", "")) or (0, 0): e.text for e in root.each("sdf") if e.text}


def parse_root(data: bytes, where: str) -> tuple[Element, Version]:
    """Return the root element of an SDF text in UTF-8, and its version.

    Raises AssetError: not well formed, of another kind, or of a version that is too old or not known.
    """
    root = parse_xml(data, where)
    place = f"{where}:{root.line}"
    if root.tag not in ("sdf", "gazebo"):
        remedy = "It is a URDF: name it .urdf, or convert it first." if root.tag == "robot" else None
        raise AssetError(f"is no SDF: its root element is <{root.tag}>, not <sdf>", where=place, remedy=remedy)
    text = root.attributes.get("version", "")
    version = parse_version(text)
    if version is None:
        problem = f"version={text!r} of this <sdf> is no version" if text else "this <sdf> has no version"
        raise AssetError(problem, where=place, remedy='Give it one, as in <sdf version="1.7">.')
    if not version >= OLDEST or version[0] != NEWEST[0]:
        known = f"{'.'.join(map(str, OLDEST))} to {'.'.join(map(str, NEWEST))}"
        raise AssetError(f"SDF {text} is not read, only {known}", where=place, remedy="Convert it: gz sdf -p FILE.")
    return root, version


def references(root: Element) -> list[str]:
    """Return each mesh and texture that a file refers to, in order, without what Gazebo brings along."""
    return [text for text in dict.fromkeys(_iterate_references(root)) if text and not text.startswith(_BUILT_IN)]


def _iterate_references(root: Element) -> Iterator[str]:
    for element in root.walk():
        if element.tag == "mesh":
            yield reference_of(element)
        elif element.tag in ("heightmap", "image"):
            uri = element.first("uri")
            yield uri.text if uri else ""
        elif element.tag in _MAPS and parse_numbers(element.text) is None:  # <diffuse> is a colour, too
            yield element.text


def list_references(source: SdfSource, data: bytes) -> list[tuple[str, Path | None]]:
    """Return what a text of a file refers to, and where that is; of material scripts only the files that are there."""
    root, _ = parse_root(data, str(source.path))
    found = [(reference, source.resolver.find(reference)) for reference in references(root)]
    scripts = dict.fromkeys(uri.text for script in root.walk() if script.tag == "script" for uri in script.each("uri"))
    for reference in (text for text in scripts if text and not text.startswith(_BUILT_IN)):
        if (path := source.resolver.find(reference)) is not None:
            found.append((reference, path))
        elif folder := next((path for path in source.resolver.candidates(reference) if path.is_dir()), None):
            inside = sorted(path for path in folder.iterdir() if path.is_file())
            found += [(f"{reference.rstrip('/')}/{path.name}", path) for path in inside[:_MOST_SCRIPTS]]
    return found
