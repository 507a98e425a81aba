"""What an SDF holds besides links, hulls, joints, masses and visuals, and what one made of another format holds."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from meshforge.asset import Feature, What
from meshforge.formats.sdf.document import SdfDocument
from meshforge.formats.sdf.files.elements import root_of
from meshforge.formats.sdf.files.values import is_true
from meshforge.formats.xml import Element

HOLDS = frozenset(
    {
        What.NAMES,
        What.BODIES,
        What.BOXES,
        What.SPHERES,
        What.CYLINDERS,
        What.CAPSULES,
        What.ELLIPSOIDS,
        What.OPAQUE,
        What.PLANES,
        What.JOINTS,
        What.BALL_JOINTS,
        What.FIXED_JOINTS,
        What.SPEEDS,
        What.MASSES,
        What.VISUALS,
        What.COLORS,
    }
)
COULD = frozenset(
    {
        What.MIMICS,
        What.CONTACT,
        What.DYNAMICS,
        What.SENSORS,
        What.SITES,
        What.CAMERAS,
        What.LIGHTS,
        What.MATERIALS,
        What.TEXTURES,
        What.COMMENTS,
    }
)
MESHES = (".obj", ".stl", ".dae", ".glb", ".gltf")
"""The mesh files that Gazebo reads."""
_ELEMENTS = {"sensor": What.SENSORS, "light": What.LIGHTS, "frame": What.SITES, "actor": What.ANIMATIONS}
_OTHERS = ("plugin", "gripper", "audio_source", "audio_sink", "battery", "particle_emitter", "projector")
_SPRINGS = ("spring_stiffness", "spring_reference")
_MAPS = ("albedo_map", "normal_map", "roughness_map", "metalness_map", "emissive_map", "light_map", "environment_map")
_SETTINGS = ("physics", "scene", "gravity", "magnetic_field", "atmosphere", "wind", "spherical_coordinates", "gui")
_COMMENT = re.compile(rb"<!--")


def features_of(document: SdfDocument) -> Iterator[Feature]:
    """The features of an SDF with what it includes that its asset does not tell."""
    roots = [root_of(source.text.data, "")[0] for source in document.sources]
    every = [element for root in roots for element in root.walk()]
    for tag, what in _ELEMENTS.items():
        yield _named(what, (e for e in every if e.tag == tag))
    collisions = [e for e in every if e.tag == "collision"]
    yield _named(What.CONTACT, (e for e in collisions if e.first("surface")))
    joints = [e for e in every if e.tag == "joint"]
    yield _named(What.MIMICS, (j for j in joints if any(a.first("mimic") for a in j.children)))
    yield _named(What.DYNAMICS, (j for j in joints if any(_springs(axis) for axis in j.children)))
    yield _named(What.MATERIALS, (s for m in every if m.tag == "material" for s in m.each("script")))
    maps = dict.fromkeys(e.text for e in every if e.tag in _MAPS and e.text and e.text != "__default__")
    yield Feature(What.TEXTURES, tuple(maps))
    yield _kinds(What.SETTINGS, [*(_statics(roots)), *(e.tag for e in every if e.tag in _SETTINGS and e.children)])
    yield _kinds(What.OTHERS, [e.tag for e in every if e.tag in _OTHERS])
    yield Feature(What.COMMENTS, unnamed=sum(len(_COMMENT.findall(source.text.data)) for source in document.sources))


def _springs(axis: Element) -> bool:
    dynamics = axis.first("dynamics")
    return dynamics is not None and any(
        child.tag in _SPRINGS and child.text not in ("", "0") for child in dynamics.children
    )


def _statics(roots: Iterable[Element]) -> Iterator[str]:
    """That models are static, once for each."""
    for root in roots:
        yield from ("static" for e in root.walk() if e.tag == "static" and is_true(e.text))


def _kinds(what: What, tags: list[str]) -> Feature:
    names = tuple(dict.fromkeys(tags))
    return Feature(what, names, len(tags) - len(names))


def _named(what: What, elements: Iterable[Element]) -> Feature:
    names = [element.attributes.get("name", "") for element in elements]
    return Feature(what, tuple(name for name in names if name), sum(not name for name in names))
