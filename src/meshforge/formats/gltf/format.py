"""The format glTF for the registry, with variants for engines that know names; what files hold besides hulls."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import ClassVar

from meshforge.common import AssetError
from meshforge.formats.base import BODY_FEATURES, Mass, Output, ReadOptions, SceneFormat, feature_of_others
from meshforge.formats.collision_pieces import is_edited
from meshforge.formats.engine_names import CollisionNames, GodotNames, UnityNames, UnrealNames, fallbacks_of
from meshforge.formats.gltf.document import Convention, GltfDocument
from meshforge.formats.gltf.physics import KHR, says_mass
from meshforge.formats.meshfile.gltf_document import Json, entries, entry, extension, report_damage
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.symbolic import Asset, Feature, FeatureKind, Surface

_LISTS = ("materials", "textures", "animations", "skins", "cameras")
_LIGHTS = "KHR_lights_punctual"


class GltfFormat(SceneFormat):
    """glTF 2.0, as text with its buffers beside it, or as one GLB."""

    name = "gltf"
    title = "glTF"
    suffixes = (".glb", ".gltf")
    up = "y"
    marks = f"as colliders of {KHR}"
    engine: ClassVar[CollisionNames | None] = None
    convention: ClassVar[Convention | None] = None
    has_pictures = True
    holds = BODY_FEATURES | {FeatureKind.CAPSULES, FeatureKind.NON_CONVEX, FeatureKind.PLANES}
    instead: ClassVar[Mapping[FeatureKind, str]] = {FeatureKind.ELLIPSOIDS: "written as triangles"}

    def read(self, path: Path, options: ReadOptions) -> Asset:
        from meshforge.formats.gltf import read  # lazy: only glTF needs it

        return read.read_gltf(path)

    def can_write_back(self, asset: Asset) -> bool:
        if self.convention is None:
            return super().can_write_back(asset)
        return isinstance(asset.document, GltfDocument) and asset.document.convention == self.convention

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        if not isinstance(asset.document, GltfDocument):
            raise AssetError("this asset was not read from a glTF file", where=str(asset.path))
        from meshforge.formats.gltf import edit  # lazy: only glTF needs it

        return edit.write_gltf(asset, asset.document, name)

    def create(self, asset: Asset, name: str) -> Output:
        from meshforge.formats.gltf import create  # lazy: only glTF needs it

        return create.create_gltf(asset, name)

    def features(self, asset: Asset) -> Iterable[Feature]:
        if not isinstance(asset.document, GltfDocument):
            return ()
        with report_damage(str(asset.path)):
            tree = GltfScene.of(asset.document.source, asset.path).tree
            return list(_list_features(tree, asset.document))

    def is_unmarked(self, asset: Asset) -> bool:
        return isinstance(asset.document, GltfDocument) and asset.document.convention == "plain"

    def is_edited(self, asset: Asset) -> bool:
        assert isinstance(asset.document, GltfDocument)
        return is_edited(asset, (name for element in asset.document.authored for name in element.names))

    def surfaces_of(self, asset: Asset) -> Sequence[Surface]:
        assert isinstance(asset.document, GltfDocument)
        from meshforge.formats.gltf import read  # lazy: only glTF needs it

        return read.SceneSurfaces(asset.document.source, asset.path, unmarked=True)

    def add_colliders(self, asset: Asset, name: str) -> Output:
        assert isinstance(asset.document, GltfDocument)
        from meshforge.formats.gltf import edit  # lazy: only glTF needs it

        return edit.add_gltf_colliders(asset, asset.document, name, self.engine)


class PhysicsGltf(GltfFormat):
    """glTF whose collision is marked by KHR_physics_rigid_bodies."""

    title = f"glTF with {KHR}"
    convention = "khr"


class EngineGltf(GltfFormat):
    """glTF whose collision an engine knows by name."""

    engine: ClassVar[CollisionNames]

    def __init_subclass__(cls) -> None:
        name, cls.holds = cls.engine.title, cls.engine.holds
        cls.convention = cls.engine.engine
        cls.title, cls.marks, cls.instead = f"glTF for {name}", f"under names for {name}", fallbacks_of(cls.engine)

    def create(self, asset: Asset, name: str) -> Output:
        from meshforge.formats.gltf import create  # lazy: only glTF needs it

        return create.create_for_engine(asset, name, self.engine)


class GltfForUnreal(EngineGltf):
    """With prefixes: `UCX_table_00`."""

    engine = UnrealNames()


class GltfForGodot(EngineGltf):
    """With suffixes: `leg-convcolonly`; rigid bodies, where anything moves, by OMI_physics_body."""

    engine = GodotNames()


class GltfForUnity(EngineGltf):
    """With a node for what collides: `table_colliders`."""

    engine = UnityNames()


def _list_features(tree: Json, document: GltfDocument) -> Iterator[Feature]:
    others = [key.removesuffix("s") for key in _LISTS for _ in entries(tree, key)]
    others += ["light"] * len(entries(extension(tree, _LIGHTS) or {}, "lights"))
    parts = [part for mesh in entries(tree, "meshes") for part in entries(mesh, "primitives")]
    for name in ("COLOR_0", "TEXCOORD_0"):
        others += [name] * sum(name in part.get("attributes", {}) for part in parts)
    physics = extension(tree, KHR) or {}
    others += ["contact setting" for key in ("physicsMaterials", "collisionFilters") for _ in entries(physics, key)]
    yield feature_of_others(others)
    joints = [
        "joint" in (extension(node, KHR) or {}) or extension(node, "OMI_physics_joint") is not None
        for node in entries(tree, "nodes")
    ]
    yield Feature(FeatureKind.JOINTS, unnamed=sum(joints))
    heavy = tuple(name for node, name in document.bodies if says_mass(entry(tree, "nodes", node)))
    yield Feature(FeatureKind.MASSES, heavy, reason="masses of a glTF are not read")
