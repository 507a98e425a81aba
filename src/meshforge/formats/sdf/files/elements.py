"""The elements of an SDF file: its root, its models, and what it refers to."""

from __future__ import annotations

from collections.abc import Iterator

from meshforge.errors import AssetError
from meshforge.formats.sdf.files.version import NEWEST, OLDEST, Version, version_of
from meshforge.formats.xml import Element, numbers, parsed

KINDS = (
    *("box", "sphere", "cylinder", "capsule", "ellipsoid", "cone"),
    *("plane", "mesh", "polyline", "heightmap", "image", "empty"),
)
"""The elements of a `<geometry>` that there are."""
_MAPS = (
    *("albedo_map", "normal_map", "roughness_map", "metalness_map", "emissive_map", "light_map"),
    *("environment_map", "ambient_occlusion_map", "glossiness_map", "specular_map", "diffuse", "normal"),
)
_BUILT_IN = ("file://media/", "__default__")
"""References to what Gazebo brings along."""


def root_of(data: bytes, where: str) -> tuple[Element, Version]:
    """The root element of an SDF text in UTF-8, and its version.

    Raises AssetError: not well formed, of another kind, or of a version that is too old or not known.
    """
    root = parsed(data, where)
    place = f"{where}:{root.line}"
    if root.tag not in ("sdf", "gazebo"):
        remedy = "It is a URDF: name it .urdf, or convert it first." if root.tag == "robot" else None
        raise AssetError(f"is no SDF: its root element is <{root.tag}>, not <sdf>", where=place, remedy=remedy)
    told = root.attributes.get("version", "")
    version = version_of(told)
    if version is None:
        problem = f"version={told!r} of this <sdf> is no version" if told else "this <sdf> tells no version"
        raise AssetError(problem, where=place, remedy='Give it one, as in <sdf version="1.7">.')
    if not version >= OLDEST or version[0] != NEWEST[0]:
        known = f"{'.'.join(map(str, OLDEST))} to {'.'.join(map(str, NEWEST))}"
        raise AssetError(f"SDF {told} is not read, only {known}", where=place, remedy="Convert it: gz sdf -p FILE.")
    return root, version


def geometry_of(element: Element) -> Element | None:
    """What the `<geometry>` of a collision or visual holds, None where there is nothing."""
    geometry = element.first("geometry")
    if geometry is None or not geometry.children:
        return None
    return next((child for child in geometry.children if child.tag in KINDS), geometry.children[0])


def mesh_uri(mesh: Element) -> str:
    """The reference of a `<mesh>`; up to version 1.2 it was called `<filename>`."""
    found = mesh.first("uri") or mesh.first("filename")
    return found.text if found else ""


def references(root: Element) -> list[str]:
    """Every mesh and texture that a file refers to, in order of mention, each once; not what Gazebo brings along."""
    return [text for text in dict.fromkeys(_references(root)) if text and not text.startswith(_BUILT_IN)]


def script_folders(root: Element) -> list[str]:
    """The references of material scripts: folders, or files."""
    scripts = (element for element in root.walk() if element.tag == "script")
    found = dict.fromkeys(uri.text for script in scripts for uri in script.each("uri"))
    return [text for text in found if text and not text.startswith(_BUILT_IN)]


def _references(root: Element) -> Iterator[str]:
    for element in root.walk():
        if element.tag == "mesh":
            yield mesh_uri(element)
        elif element.tag in ("heightmap", "image"):
            yield text_of_uri(element)
        elif element.tag in _MAPS and numbers(element.text) is None:  # <diffuse> is a colour, too
            yield element.text


def text_of_uri(element: Element) -> str:
    """The `<uri>` of a height map or an image."""
    uri = element.first("uri")
    return uri.text if uri else ""
