"""The format MJCF as the registry has it, what an MJCF can hold, and what one holds besides bodies, hulls, joints,
masses and visuals."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from meshforge.common import AssetError, require_mujoco
from meshforge.formats.base import BODY_FEATURES, Format, Mass, Output, ReadOptions, feature_of_others, list_others
from meshforge.formats.mjcf.document import MjcfDocument
from meshforge.symbolic import Asset, Feature, FeatureKind

_ROOT = re.compile(r"[^<]*+(?:<(?>\?.*?\?>|!--.*?-->|![^-][^>]*>)[^<]*+)*+<([\w:.-]+)", re.S)
"""An XML text up to the tag of its first element."""

_TAKEN = ("worldbody", "asset", "body", "frame", "replicate")
_LEAVES = (
    *("compiler", "default", "geom", "joint", "freejoint", "inertial", "mesh", "model", "attach", "include"),
    "equality",  # of which couplings of joints are taken, see below
)
_CONTACT = ("contype", "conaffinity", "condim", "friction", "solref", "solimp", "solmix", "margin", "gap", "priority")
_DYNAMICS = ("stiffness", "springref", "springdamper", "springlength", "armature")


class MjcfFormat(Format):
    """MuJoCo's own format for models."""

    name = "mjcf"
    engines = ("mujoco",)
    suffixes = (".xml", ".mjcf")
    is_description = True
    title = "MJCF"
    up = "z"
    holds = BODY_FEATURES | {
        *(FeatureKind.CAPSULES, FeatureKind.ELLIPSOIDS, FeatureKind.PLANES, FeatureKind.NON_CONVEX),
        *(FeatureKind.JOINTS, FeatureKind.BALL_JOINTS, FeatureKind.MIMICS),
    }

    def matches_head(self, head: bytes) -> bool:
        root = _ROOT.match(head.decode("utf-8", "replace").replace("\0", ""))
        return root is None or root[1].lower() == "mujoco"

    def read(self, path: Path, options: ReadOptions) -> Asset:
        require_mujoco("an MJCF", str(path))
        from meshforge.formats.mjcf import read  # lazy: only MJCF needs it

        return read.read_mjcf(path)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, MjcfDocument):
            raise AssetError("this asset was not read from an MJCF", where=str(asset.path))
        require_mujoco("an MJCF", str(asset.path))
        from meshforge.formats.mjcf import edit  # lazy: only MJCF needs it

        return edit.write_mjcf(asset, asset.document, name, mass)

    def create(self, asset: Asset, name: str) -> Output:
        from meshforge.formats.mjcf import create  # lazy: only MJCF needs it

        return create.create_mjcf(asset, name)

    def top(self, asset: Asset) -> Path:
        if not isinstance(asset.document, MjcfDocument):
            return super().top(asset)
        from meshforge.formats.mjcf import references  # lazy: only MJCF needs it

        return references.top_folder(asset.document)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return features_of(asset.document) if isinstance(asset.document, MjcfDocument) else ()


def features_of(document: MjcfDocument) -> Iterator[Feature]:
    """The features of an MJCF that its asset does not have, as its elements say; those that classes set count once."""
    root = document.tree.root
    others = [*list_others(root, _TAKEN, _LEAVES)]
    constraints = [child for node in root.each("equality") for child in node.children]
    coupled = [c.attributes.get("joint1") for c in constraints if c.is_coupling]
    others += [f"equality {c.tag}" for c in constraints if not c.is_coupling]
    others += ["second coupling of a joint"] * (len(coupled) - len(set(coupled)))
    for kind, tag, keys in (("contact setting", "geom", _CONTACT), ("spring or armature", "joint", _DYNAMICS)):
        others += [kind for node in root.walk() if node.tag == tag and any(key in node.attributes for key in keys)]
    others += ["comment"] * sum(source.raw.count(b"<!--") for source in document.sources)
    yield feature_of_others(others)
