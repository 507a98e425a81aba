"""The format SDF as the registry has it: what an SDF can hold, what one holds besides hulls, joints, masses and
visuals, and making one from an asset of another format."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from meshforge.common import AssetError
from meshforge.formats import base, xml
from meshforge.formats.sdf.document import VISUAL_SUFFIXES, SdfDocument, is_main_file, parse_root
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

    name = "sdf"
    engines = ("bullet",)
    suffixes = (".sdf",)
    is_description = True
    title = "SDF"
    up = "z"
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
        from meshforge.formats.sdf import read  # lazy: only SDF needs it

        return read.read_sdf(path, options)

    def write(self, asset: Asset, name: str, mass: base.Mass = "keep") -> base.Output:
        if not isinstance(asset.document, SdfDocument):
            raise AssetError("this asset was not read from an SDF", where=str(asset.path))
        from meshforge.formats.sdf import edit  # lazy: only SDF needs it

        return edit.write_sdf(asset, asset.document, name, mass)

    def create(self, asset: Asset, name: str) -> base.Output:
        from meshforge.formats.sdf import create  # lazy: only SDF needs it

        return create.create_sdf(asset, name)

    def features(self, asset: Asset) -> Iterable[Feature]:
        return features_of(asset.document) if isinstance(asset.document, SdfDocument) else ()


def features_of(document: SdfDocument) -> Iterator[Feature]:
    """The features of an SDF, and of what it includes, that its asset does not have."""
    from meshforge.formats.sdf.frames import is_true  # lazy: only SDF needs it

    roots = [parse_root(source.text.data, "")[0] for source in document.sources]
    every = [element for root in roots for element in root.walk()]
    for tag, what in _ELEMENTS.items():
        yield _feature_of(what, (e for e in every if e.tag == tag))
    collisions = [e for e in every if e.tag == "collision"]
    yield _feature_of(FeatureKind.CONTACT, (e for e in collisions if e.first("surface")))
    joints = [e for e in every if e.tag == "joint"]
    yield _feature_of(FeatureKind.MIMICS, (j for j in joints if any(a.first("mimic") for a in j.children)))
    dynamics = [
        (j, part) for j in joints for axis in j.children if (found := axis.first("dynamics")) for part in found.children
    ]
    springs = dict.fromkeys(j for j, part in dynamics if part.tag in _SPRINGS and part.text not in ("", "0"))
    yield _feature_of(FeatureKind.DYNAMICS, springs)
    yield _feature_of(FeatureKind.MATERIALS, (s for m in every if m.tag == "material" for s in m.each("script")))
    maps = dict.fromkeys(e.text for e in every if e.tag in _MAPS and e.text and e.text != "__default__")
    yield Feature(FeatureKind.TEXTURES, tuple(maps))
    static = ["static" for e in every if e.tag == "static" and is_true(e.text)]
    settings = [e.tag for e in every if e.tag in _SETTINGS and e.children]
    yield base.feature_of_tags(FeatureKind.SETTINGS, [*static, *settings])
    yield base.feature_of_tags(FeatureKind.OTHERS, (e.tag for e in every if e.tag in _OTHERS))
    yield Feature(FeatureKind.COMMENTS, unnamed=sum(source.text.data.count(b"<!--") for source in document.sources))


def _feature_of(what: FeatureKind, elements: Iterable[xml.Element]) -> Feature:
    return base.feature_of(what, (element.attributes.get("name", "") for element in elements))
