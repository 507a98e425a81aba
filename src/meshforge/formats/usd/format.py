"""The format USD as the registry has it, what a stage holds besides hulls, bodies, joints, masses and visuals, and a
`Usd.Stage` that is open in memory: its file where that says it all, else the stage as it is, flattened."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

from meshforge.common import AssetError
from meshforge.common.processes import call_isolated
from meshforge.formats import base
from meshforge.formats.libraries import make_folder
from meshforge.formats.usd.stage import UsdDocument, UsdStage, usd
from meshforge.symbolic import Asset, Feature, FeatureKind, FileNote, Surface

_FLAT = FileNote("read from a stage that differs from its files: flattened into one layer, which is what gets edited")
_OTHERS = (
    *("Material", "Camera", "SkelRoot", "PhysicsScene", "PhysicsCollisionGroup"),
    *("PhysicsDistanceJoint", "PhysicsJoint"),
)


class UsdFormat(base.SceneFormat):
    """Universal Scene Description, as text (.usda), crate (.usdc), either (.usd) or a package (.usdz)."""

    name = "usd"
    title = "USD"
    suffixes = (".usda", ".usd", ".usdc", ".usdz")
    up = "z"
    marks = "as colliders of UsdPhysics"
    holds = base.BODY_FEATURES | {FeatureKind.CAPSULES, FeatureKind.NON_CONVEX, FeatureKind.PLANES, FeatureKind.PAIRS}
    instead: ClassVar[Mapping[FeatureKind, str]] = {FeatureKind.ELLIPSOIDS: "written as triangles"}

    # The library runs in a process of its own, since a damaged file may crash it.
    def read(self, path: Path, options: base.ReadOptions) -> Asset:
        from meshforge.formats.usd import read  # lazy: only USD needs it

        return call_isolated(read.read_usd, path, where=str(path))

    def write(self, asset: Asset, name: str, mass: base.Mass = "keep") -> base.Output:
        if not isinstance(asset.document, UsdDocument):
            raise AssetError("this asset was not read from a USD file", where=str(asset.path))
        from meshforge.formats.usd import edit  # lazy: only USD needs it

        return call_isolated(edit.write_usd, asset, asset.document, name, mass, where=str(asset.path))

    def create(self, asset: Asset, name: str) -> base.Output:
        from meshforge.formats.usd import edit  # lazy: only USD needs it

        return edit.create_usd(asset, name)

    def features(self, asset: Asset) -> Iterable[Feature]:
        if not isinstance(asset.document, UsdDocument):
            return ()
        return call_isolated(_read_features, asset.path, where=str(asset.path))

    def is_unmarked(self, asset: Asset) -> bool:
        return isinstance(asset.document, UsdDocument) and not asset.document.physics

    def is_edited(self, asset: Asset) -> bool:
        assert isinstance(asset.document, UsdDocument)
        return asset.document.is_edited(asset)

    def surfaces_of(self, asset: Asset) -> Sequence[Surface]:
        assert isinstance(asset.document, UsdDocument)
        from meshforge.formats.usd import read  # lazy: only USD needs it

        return call_isolated(read.read_stage_surfaces, asset, asset.document, where=str(asset.path))

    def add_colliders(self, asset: Asset, name: str) -> base.Output:
        assert isinstance(asset.document, UsdDocument)
        from meshforge.formats.usd import edit  # lazy: only USD needs it

        return call_isolated(edit.add_usd_colliders, asset, asset.document, name, where=str(asset.path))


def _read_features(path: Path) -> list[Feature]:
    with usd(str(path)):
        return [base.feature_of_others(kind for prim in UsdStage.open(path).prims() for kind in _list_others(prim))]


def _list_others(prim: Any) -> Iterator[str]:
    kind, attributes = str(prim.GetTypeName()), prim.GetAuthoredAttributes()
    names = {attribute.GetName() for attribute in attributes}
    if kind in _OTHERS or kind.endswith("Light"):
        yield kind
    if any(attribute.GetNumTimeSamples() > 1 for attribute in attributes):
        yield "time samples"
    if kind == "Shader" and prim.GetAttribute("info:id").Get() == "UsdUVTexture":
        yield "texture"
    if any("physics:dynamicFriction" in name or name.startswith("physxMaterial") for name in names):
        yield "contact setting"
    if any(name.startswith("drive:") for name in names):
        yield "drive"


def read_stage(stage: base.StageObject) -> Asset:
    """Return the asset in a stage.

    A stage as its saved files have it is read from these, so that an edit keeps all the rest of them. One that is made
    in memory, or has unsaved changes, is flattened, references resolved, in a folder that lasts as long as the process.
    Raises AssetError as reading a file does.
    """
    from meshforge.formats.usd import read  # lazy: only USD needs it

    root = stage.GetRootLayer()
    name = Path(str(root.GetDisplayName() or "stage")).stem or "stage"
    with usd(name):
        if _is_saved(stage):
            path, flat = Path(str(root.realPath)), False
        else:
            path, flat = make_folder() / f"{name}.usda", True
            stage.Flatten().Export(str(path))
    asset = call_isolated(read.read_usd, path, where=str(path))
    return replace(asset, notes=(_FLAT, *asset.notes)) if flat else asset


def _is_saved(stage: base.StageObject) -> bool:
    session = stage.GetSessionLayer()
    layers = [layer for layer in stage.GetUsedLayers() if layer != session]
    is_pure = session is None or session.empty
    return is_pure and all(layer.realPath and not layer.dirty and Path(layer.realPath).is_file() for layer in layers)
