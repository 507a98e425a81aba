"""What becomes of an asset in another format: the difference between what it has and what that format holds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from meshforge.asset import Asset, Feature, What, features
from meshforge.formats.base import Format, Output
from meshforge.formats.companions import companions
from meshforge.formats.losses import Loss
from meshforge.formats.visuals import LazySurfaces
from meshforge.words import listed

_PICTURES = (".png", ".jpg", ".jpeg", ".tga", ".bmp", ".tif", ".tiff", ".webp", ".dds")
_WITH_MATERIALS = (".dae", ".glb", ".gltf", ".mtl")
_WORDING = {
    What.OTHERS: "{title} has no place for them",
    What.SETTINGS: "{title} has no place for them",
    What.VISUALS: "{title} does not tell visuals from hulls",
    What.FIXED_JOINTS: "{title} has no named fixed joints",
}


@dataclass(frozen=True, slots=True)
class Report:
    """What the output of another format holds besides the hulls, what it does not, and what else is to be known."""

    held: tuple[Feature, ...] = ()
    lost: tuple[Loss, ...] = ()
    remarks: tuple[str, ...] = ()

    @property
    def sentences(self) -> tuple[str, ...]:
        return (*self.remarks, *map(str, self.lost))


def report(asset: Asset, source: Format | None, target: Format, output: Output, remarks: Iterable[str] = ()) -> Report:
    """The report on an asset of the format `source` (None: of memory) that `target` has made the output of."""
    found = [*features(asset), *_of_visuals(asset), *(source.features(asset) if source else ())]
    renamed = _renamed(output, target) if What.NAMES in target.holds else []
    own = [*output.lost, *renamed]
    gone = {what: {name for loss in own if loss.what is what for name in loss.names} for what in What}
    rest = [left for f in found if f.count and (left := _without(f, gone[f.what])).count]
    return Report(
        held=tuple(f for f in rest if f.what in target.holds),
        lost=(*(_lost(f, target) for f in rest if f.what not in target.holds), *own),
        remarks=(*remarks, *output.notes),
    )


def _without(feature: Feature, names: set[str]) -> Feature:
    """A feature without the things that a creator has told about."""
    return Feature(feature.what, tuple(n for n in feature.names if n not in names), feature.unnamed, feature.reason)


def _lost(feature: Feature, target: Format) -> Loss:
    what = feature.what
    return Loss(what, feature.names, feature.reason or _why(what, target), target.instead.get(what), feature.unnamed)


def _why(what: What, target: Format) -> str:
    if what in target.could:
        return f"MeshForge does not carry {what.many} over to {target.title}"
    return _WORDING.get(what, "{title} has no {many}").format(title=target.title, many=what.many)


def _renamed(output: Output, target: Format) -> list[Loss]:
    """Hulls that the file holds under other names."""
    if not output.names:
        return []
    now = listed(list(output.names.values()), 3)
    return [Loss(What.NAMES, tuple(output.names), f"{target.title} files read back as {now}", "written otherwise")]


def _of_visuals(asset: Asset) -> Iterator[Feature]:
    """Visuals, their colours, and the materials and pictures in the files they come from."""
    if not isinstance(asset.visuals, LazySurfaces):
        bodies = [surface.body for surface in asset.visuals]
        yield _counted(What.VISUALS, bodies)
        return
    visuals = asset.visuals.visuals
    yield _counted(What.VISUALS, [visual.body for visual in visuals])
    yield _counted(What.COLORS, [visual.body for visual in visuals if visual.rgba is not None])
    files = list(dict.fromkeys(v.what for v in visuals if isinstance(v.what, Path)))
    yield Feature(What.MATERIALS, tuple(f.name for f in files if _has(f, _WITH_MATERIALS)))
    yield Feature(What.TEXTURES, tuple(f.name for f in files if _has(f, _PICTURES)))


def _has(file: Path, suffixes: tuple[str, ...]) -> bool:
    return any(path.suffix.lower() in suffixes for path in (file, *companions(file).values()))


def _counted(what: What, bodies: list[str | None]) -> Feature:
    """A feature of things without names, named by the bodies that have them."""
    names = tuple(dict.fromkeys(body for body in bodies if body))
    return Feature(what, names, len(bodies) - len(names))
