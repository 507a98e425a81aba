"""The format SDF as the registry has it, what an SDF can hold, and what one holds besides hulls, joints, masses and
visuals."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import ClassVar, Literal

from meshforge.common import AssetError
from meshforge.formats import base
from meshforge.formats.sdf.create import VISUAL_SUFFIXES, create_sdf
from meshforge.formats.sdf.document import SdfDocument, is_main_file, parse_root
from meshforge.formats.sdf.edit import write_sdf
from meshforge.formats.sdf.frames import is_true
from meshforge.formats.sdf.read import read_sdf
from meshforge.formats.xml import Element
from meshforge.symbolic import Asset, Feature, FeatureKind

_ELEMENTS = {
    "sensor": FeatureKind.SENSORS,
    "light": FeatureKind.LIGHTS,
    "frame": FeatureKind.SITES,
    "actor": FeatureKind.ANIMATIONS,
}
_OTHERS = ("plugin", "gripper", "audio_source", "audio_sink", "battery", "particle_emitter", "projector")
_SPRINGS = ("spring_stiffness", "spring_reference")
_MAPS = ("albedo_map", "normal_map", "roughness_map", "metalness_map", "emissive_map", "light_map", "environment_map")
_SETTINGS = ("physics", "scene", "gravity", "magnetic_field", "atmosphere", "wind", "spherical_coordinates", "gui")


class SdfFormat(base.Format):
    """The Simulation Description Format, of Gazebo."""

    name: ClassVar[str] = "sdf"
    suffixes: ClassVar[tuple[str, ...]] = (".sdf",)
    is_description: ClassVar[bool] = True
    title: ClassVar[str] = "SDF"
    up: ClassVar[Literal["y", "z"] | None] = "z"
    holds = base.BODY_FEATURES | {
        *(FeatureKind.CAPSULES, FeatureKind.ELLIPSOIDS, FeatureKind.OPAQUE, FeatureKind.PLANES),
        *(FeatureKind.JOINTS, FeatureKind.BALL_JOINTS, FeatureKind.FIXED_JOINTS, FeatureKind.SPEEDS),
    }
    could = base.SCENE_FEATURES | {
        *(FeatureKind.MIMICS, FeatureKind.DYNAMICS, FeatureKind.SENSORS, FeatureKind.SITES, FeatureKind.COMMENTS)
    }
    shown_files = VISUAL_SUFFIXES

    def is_main(self, path: Path) -> bool:
        return is_main_file(path)

    def read(self, path: Path, options: base.ReadOptions) -> Asset:
        return read_sdf(path, options)

    def write(self, asset: Asset, name: str, mass: base.Mass = "keep") -> base.Output:
        if not isinstance(asset.document, SdfDocument):
            raise AssetError("this asset was not read from an SDF", where=str(asset.path))
        return write_sdf(asset, asset.document, name, mass)

    def create(self, asset: Asset, name: str) -> base.Output:
        return create_sdf(asset, name)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return features_of(asset.document) if isinstance(asset.document, SdfDocument) else ()


def features_of(document: SdfDocument) -> Iterator[Feature]:
    """The features of an SDF, and of what it includes, that its asset does not have."""
    roots = [parse_root(source.text.data, "")[0] for source in document.sources]
    every = [element for root in roots for element in root.walk()]
    for tag, what in _ELEMENTS.items():
        yield _feature_of(what, (e for e in every if e.tag == tag))
    collisions = [e for e in every if e.tag == "collision"]
    yield _feature_of(FeatureKind.CONTACT, (e for e in collisions if e.first("surface")))
    joints = [e for e in every if e.tag == "joint"]
    yield _feature_of(FeatureKind.MIMICS, (j for j in joints if any(a.first("mimic") for a in j.children)))
    yield _feature_of(FeatureKind.DYNAMICS, (j for j in joints if any(_has_springs(axis) for axis in j.children)))
    yield _feature_of(FeatureKind.MATERIALS, (s for m in every if m.tag == "material" for s in m.each("script")))
    maps = dict.fromkeys(e.text for e in every if e.tag in _MAPS and e.text and e.text != "__default__")
    yield Feature(FeatureKind.TEXTURES, tuple(maps))
    static = ["static" for e in every if e.tag == "static" and is_true(e.text)]
    settings = [e.tag for e in every if e.tag in _SETTINGS and e.children]
    yield base.feature_of_tags(FeatureKind.SETTINGS, [*static, *settings])
    yield base.feature_of_tags(FeatureKind.OTHERS, (e.tag for e in every if e.tag in _OTHERS))
    yield Feature(FeatureKind.COMMENTS, unnamed=sum(source.text.data.count(b"<!--") for source in document.sources))


def _has_springs(axis: Element) -> bool:
    dynamics = axis.first("dynamics")
    return dynamics is not None and any(
        child.tag in _SPRINGS and child.text not in ("", "0") for child in dynamics.children
    )


def _feature_of(what: FeatureKind, elements: Iterable[Element]) -> Feature:
    return base.feature_of(what, (element.attributes.get("name", "") for element in elements))
