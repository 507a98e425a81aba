"""What becomes of an asset in another format: the difference between what it has and what that format holds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from meshforge.asset import Asset, Feature, Surface, What, features
from meshforge.formats.base import Format, Output
from meshforge.formats.companions import companions
from meshforge.formats.losses import Loss
from meshforge.formats.visuals import Visual, VisualSurfaces
from meshforge.words import listed

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
    own = [*output.lost, *_renamed(output, target), *_faded(asset, target)]
    told = [_without(feature, own) for feature in (*features(asset), *_of_visuals(asset))]
    # a creator sees the asset, not the document: what only that tells is never carried over
    beyond = [f for f in (source.features(asset) if source else ()) if f.count]
    lost = [f for f in told if f.count and f.kind not in target.holds]
    return Report(
        held=tuple(f for f in told if f.count and f.kind in target.holds),
        lost=(*(_lost(f, target) for f in (*lost, *beyond)), *_together(own)),
        remarks=(*remarks, *output.notes),
    )


def _without(feature: Feature, losses: Sequence[Loss]) -> Feature:
    """A feature without the things that losses tell about."""
    like = [loss for loss in losses if loss.kind is feature.kind]
    names = {name for loss in like for name in loss.names}
    unnamed = max(0, feature.unnamed - sum(loss.unnamed for loss in like))
    return Feature(feature.kind, tuple(n for n in feature.names if n not in names), unnamed, feature.reason)


def _lost(feature: Feature, target: Format) -> Loss:
    what = feature.kind
    return Loss(what, feature.names, feature.reason or _why(what, target), target.instead.get(what), feature.unnamed)


def _why(what: What, target: Format) -> str:
    if what is What.MATERIALS and What.COLORS in target.holds:
        return f"MeshForge carries their plain colours alone over to {target.title}"
    if what in target.could | target.holds:
        return f"MeshForge does not carry {what.many} over to {target.title}"
    return _WORDING.get(what, "{title} has no {many}").format(title=target.title, many=what.many)


def _renamed(output: Output, target: Format) -> list[Loss]:
    """Hulls that the file holds under other names."""
    if not output.names or What.NAMES not in target.holds:
        return []
    now = listed(list(output.names.values()), 3)
    why = f"{'it reads' if len(output.names) == 1 else 'they read'} back as {now}"
    return [Loss(What.NAMES, tuple(output.names), why, "written otherwise")]


def _of_visuals(asset: Asset) -> Iterator[Feature]:
    """Visuals and their colours."""
    if not isinstance(asset.visuals, VisualSurfaces):
        shown: Sequence[Surface | Visual] = asset.visuals
    else:
        shown = asset.visuals.visuals
    yield _counted(What.VISUALS, [visual.body for visual in shown])
    yield _counted(What.COLORS, [visual.body for visual in shown if visual.rgba is not None])


def _faded(asset: Asset, target: Format) -> list[Loss]:
    """Mesh files of visuals whose own materials the target does not show, though it has the shapes."""
    if What.VISUALS not in target.holds or not isinstance(asset.visuals, VisualSurfaces):
        return []
    files = dict.fromkeys(visual.what for visual in asset.visuals.visuals if isinstance(visual.what, Path))
    faded = tuple(f.name for f in files if f.suffix.lower() not in target.shown_files and _has_materials(f))
    why = f"{target.title} gets the shapes alone"
    return [Loss(What.MESH_MATERIALS, faded, why, "shown without these")] if faded else []


def _has_materials(file: Path) -> bool:
    return any(path.suffix.lower() in _WITH_MATERIALS for path in (file, *companions(file).values()))


def _together(losses: Sequence[Loss]) -> list[Loss]:
    """Losses of like things for a like reason as one."""
    alike: dict[tuple[What, str, str | None], list[Loss]] = {}
    for loss in losses:
        alike.setdefault((loss.kind, loss.why, loss.instead), []).append(loss)
    return [
        Loss(what, tuple(n for one in each for n in one.names), why, instead, sum(one.unnamed for one in each))
        for (what, why, instead), each in alike.items()
    ]


def _counted(what: What, bodies: list[str | None]) -> Feature:
    """A feature of things without names, named by the bodies that have them."""
    names = tuple(dict.fromkeys(body for body in bodies if body))
    return Feature(what, names, len(bodies) - len(names))
