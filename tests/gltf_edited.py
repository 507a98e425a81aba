"""A glTF scene that is edited, saved and read again."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from meshforge.formats import SaveResult, read, save
from meshforge.geometry import convex_hull, is_same_shape
from meshforge.symbolic import Asset, Geom
from tests.gltf_files import SceneFile, Tree, tree_of
from tests.gltf_validation import errors
from tests.soups import Soup, box, together


class Edited:
    """A scene read, edited and read again."""

    def __init__(self, scene: SceneFile, folder: Path, suffix: str = ".glb", out: str | None = None) -> None:
        self.source = scene.write(folder / f"a{suffix}")
        self.out = folder / "out" / (out or self.source.name)
        self.before = read(self.source)
        self.saved: SaveResult

    def edit(self, gone: Iterable[str] = (), made: Iterable[Geom] = ()) -> Asset:
        """The asset read back after some hulls are gone and others made."""
        gone = set(gone)
        assert gone <= {geom.name for geom in self.before.geoms}
        kept = [geom for geom in self.before.geoms if geom.name not in gone]
        self.saved = save(self.before.with_geoms([*kept, *made]), self.out, collision="replace")
        after = read(self.out)
        told = {self.saved.names.get(geom.name, geom.name): geom for geom in kept}
        for geom in after.geoms:
            if geom.name in told:
                assert is_same_shape(geom.shape, told[geom.name].shape, 1e-9)
                assert geom.body == told[geom.name].body
        assert told.keys() <= {geom.name for geom in after.geoms}
        assert sorted(o.reason for o in after.non_convex) == sorted(o.reason for o in self.before.non_convex)
        now, then = errors([self.out, self.source])
        assert now <= then
        return after

    @property
    def trees(self) -> tuple[Tree, Tree]:
        return tree_of(self.source.read_bytes()), tree_of(self.out.read_bytes())


def names(asset: Asset) -> list[str]:
    return [geom.name for geom in asset.geoms]


def brick(low: tuple[float, float, float], name: str, parent: str | None, body: str = "body") -> Geom:
    return Geom(name, body, convex_hull(box(low)[0]), parent)


def three_legs() -> Soup:
    return together(box(), box((2, 0, 0)), box((4, 0, 0)))
