"""The formats URDF and xacro as the registry has them: what they hold, and what a file holds that no conversion takes.
Xacro files are read as the URDF that they expand to, and written as plain URDF, as no edit fits into a macro."""

import contextlib
import io
import threading
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

from meshforge.common import AssetError, import_extra, plain_path
from meshforge.formats import base
from meshforge.formats.mesh_reader import read_content
from meshforge.formats.references import Resolver
from meshforge.formats.urdf.document import VISUAL_SUFFIXES, UrdfDocument, parse_robot
from meshforge.formats.xml import XmlText, parse_xml
from meshforge.symbolic import Asset, Feature, FeatureKind, FileNote

_TAKEN = ("link", "joint", "material", "visual")
_LEAVES = (
    *("inertial", "collision", "origin", "geometry", "color"),
    *("parent", "child", "axis", "limit", "dynamics", "mimic"),
)


class UrdfFormat(base.Format):
    """The Unified Robot Description Format; has_capsules: whether it is written with them."""

    name = "urdf"
    suffixes = (".urdf",)
    is_description = True
    title = "URDF"
    up = "z"
    holds = base.BODY_FEATURES | {
        *(FeatureKind.NON_CONVEX, FeatureKind.JOINTS, FeatureKind.FIXED_JOINTS, FeatureKind.SPEEDS, FeatureKind.MIMICS),
        FeatureKind.PAIRS,
    }
    instead: ClassVar[Mapping[FeatureKind, str]] = {
        FeatureKind.CAPSULES: "written as triangles",
        FeatureKind.ELLIPSOIDS: "written as triangles",
        FeatureKind.BALL_JOINTS: "written as three joints that turn about one point",
    }
    shown_files = VISUAL_SUFFIXES
    has_capsules: ClassVar[bool] = False

    def read(self, path: Path, options: base.ReadOptions) -> Asset:
        from meshforge.formats.urdf import read  # lazy: only URDF needs it

        return read.read_urdf(path, options)

    def write(self, asset: Asset, name: str, mass: base.Mass = "keep") -> base.Output:
        if not isinstance(asset.document, UrdfDocument):
            raise AssetError("this asset was not read from a URDF", where=str(asset.path))
        from meshforge.formats.urdf import edit  # lazy: only URDF needs it

        return edit.write_urdf(asset, asset.document, name, capsules=self.has_capsules)

    def create(self, asset: Asset, name: str) -> base.Output:
        from meshforge.formats.urdf import edit  # lazy: only URDF needs it

        return edit.create_urdf(asset, name, capsules=self.has_capsules)

    def features(self, asset: Asset) -> Iterator[Feature]:
        if isinstance(asset.document, UrdfDocument):
            data = XmlText.of(asset.document.source).data
            others = [*base.list_others(parse_robot(data, ""), _TAKEN, _LEAVES), *["comment"] * data.count(b"<!--")]
            yield base.feature_of_others(others)


class UrdfWithCapsules(UrdfFormat):
    """URDF with `<capsule>`, which not all readers know."""

    has_capsules = True
    holds = UrdfFormat.holds | {FeatureKind.CAPSULES}
    instead: ClassVar[Mapping[FeatureKind, str]] = {
        kind: text for kind, text in UrdfFormat.instead.items() if kind is not FeatureKind.CAPSULES
    }


SUFFIX = ".xacro"
_LOCK = threading.Lock()  # xacro keeps what it is at in variables of its module


class XacroFormat(UrdfFormat):
    """URDF with macros, to be read only."""

    name = "xacro"
    suffixes = (SUFFIX,)
    writable = False
    title = "xacro"

    def is_main(self, path: Path) -> bool:
        """Return whether it is a robot, and not macros for others to include: these give their `<robot>` no name."""
        try:
            root = parse_xml(XmlText.of(read_content(path)).data, str(path))
        except AssetError:
            return True  # its reader says what is wrong
        return root.tag == "robot" and "name" in root.attributes

    def read(self, path: Path, options: base.ReadOptions) -> Asset:
        from meshforge.formats.urdf import read  # lazy: only URDF needs it

        source, included = expand(path, options)
        asset = read.read_urdf(path, options, source)
        name = self.output_name(path.name)
        note = FileNote(f"expanded by xacro; it is written as plain URDF, {name}, without its macros")
        return replace(asset, files=tuple(dict.fromkeys((*asset.files, *included))), notes=(note, *asset.notes))

    def output_name(self, name: str) -> str:
        stem = name[: -len(SUFFIX)]
        return stem if stem.lower().endswith(".urdf") else f"{stem}.urdf"

    def write(self, asset: Asset, name: str, mass: base.Mass = "keep") -> base.Output:
        raise self._creation_error(asset)

    def create(self, asset: Asset, name: str) -> base.Output:
        raise self._creation_error(asset)

    def _creation_error(self, asset: Asset) -> AssetError:
        remedy = "Write plain URDF, a file that ends in .urdf."
        return AssetError("xacro files are read, not written", where=str(asset.path), remedy=remedy)


def expand(path: Path, options: base.ReadOptions) -> tuple[bytes, tuple[Path, ...]]:
    """Return the URDF text of a xacro file, its arguments at their defaults, and the files that it includes.

    Raises MeshForgeError: xacro is not installed; AssetError: it cannot be read or expanded.
    """
    xacro = import_extra("xacro", "xacro", f"{path}: a xacro file")
    words = import_extra("xacro.substitution_args", "xacro", f"{path}: a xacro file")
    parse_xml(XmlText.of(read_content(path)).data, str(path))
    resolver = Resolver(plain_path(path).parent, tuple(map(plain_path, options.package_roots)))
    with _LOCK, _find_packages(words, resolver), contextlib.redirect_stderr(io.StringIO()):
        xacro.all_includes.clear()
        try:
            made = xacro.process_file(str(plain_path(path)), mappings={}, verbosity=0)
        except Exception as error:  # whatever an expression of the file does
            problem = " ".join(str(error).split()) or type(error).__name__
            remedy = f"If it needs arguments: xacro {path.name} NAME:=VALUE -o robot.urdf, and take that file."
            raise AssetError(f"xacro cannot expand it: {problem}", where=str(path), remedy=remedy) from error
        text: str = made.toprettyxml(indent="  ")
        return text.encode(), tuple(plain_path(Path(name)) for name in dict.fromkeys(xacro.all_includes))


@contextlib.contextmanager
def _find_packages(words: Any, resolver: Resolver) -> Iterator[None]:
    """Let `$(find NAME)` look where `package://NAME` does, then where ROS has it; words: the module that has `find`."""
    find_in_ros = words._eval_find

    def find(package: str) -> str:
        home = resolver.find_package(package)
        return str(home) if home else str(find_in_ros(package))

    words._eval_find = words._eval_dict["find"] = find
    try:
        yield
    finally:
        words._eval_find = words._eval_dict["find"] = find_in_ros
