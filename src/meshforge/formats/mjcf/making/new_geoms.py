"""The `<geom>` elements of an MJCF that is made: hulls, planes, visuals, opaque surfaces."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from meshforge.asset import Asset, Geom, Opaque, Surface, What
from meshforge.formats.body_tree import BodyTree
from meshforge.formats.losses import Loss
from meshforge.formats.mjcf.elements import Native, geom_attributes, mesh_geom_attributes, pose_attributes, tag
from meshforge.formats.mjcf.making.mesh_assets import MeshAssets
from meshforge.formats.mjcf.making.shown_whole import shown_whole
from meshforge.formats.visual_files import VisualFiles
from meshforge.formats.visuals import Rgba, visuals_of
from meshforge.formats.xml import shown
from meshforge.geometry import Pose

_FAR = 100.0  # sizes away from its body, beyond which a mesh is placed: MuJoCo keeps its vertices in single precision


class NewGeoms:
    """Makes elements for one asset; names: of hulls and planes their attributes; lost: what cannot be made of it."""

    def __init__(self, asset: Asset, stem: str, tree: BodyTree, names: dict[str, str]) -> None:
        self.tree, self.poses, self.names = tree, asset.body_poses, names
        self.shown = visuals_of(asset)
        self.meshes = MeshAssets(stem)
        self.files = VisualFiles(self.meshes.files, shown_whole)
        self.files.gather(self.shown)
        self.lost: list[Loss] = []

    def make_hull(self, geom: Geom) -> bytes:
        """The geom of a hull."""
        named = self._name_attribute(geom.name)
        class_ = {"class": "collision"} if self.shown else {}
        body_t_root = self.poses[geom.body].inverse()
        shape = geom.shape.move(body_t_root)
        if isinstance(shape, Native):
            return tag("geom", {**named, **class_, **geom_attributes(shape)})
        middle = shape.aabb.center
        place = Pose.of_translation(middle if np.linalg.norm(middle) > _FAR * shape.aabb.diagonal else np.zeros(3))
        mesh = self.meshes.add_hull(geom.name, shape.move(place.inverse()).tessellate())
        return tag("geom", {**named, **class_, **mesh_geom_attributes(mesh, place)})

    def _name_attribute(self, piece: str) -> dict[str, str]:
        return {"name": self.names[piece]} if self.names[piece] else {}

    def make_visuals(self, body: str) -> Iterator[bytes]:
        """The geoms that show what a body shows."""
        for own, visual in self.shown:
            if own != body or (seen := self.files.add_visual(body, visual, self.poses[body])) is None:
                continue
            if isinstance(seen.what, Native):
                yield _visual(geom_attributes(seen.what), seen.rgba)
            elif isinstance(seen.what, str):
                mesh = self.meshes.add_visual(seen.what, seen.scale)
                yield _visual(mesh_geom_attributes(mesh, seen.pose), seen.rgba)
            else:
                file = self.meshes.files.add(f"{body}-visual", "", seen.what.vertices, seen.what.faces)
                yield _visual(mesh_geom_attributes(self.meshes.add_visual(file, np.ones(3)), Pose.identity()), seen.rgba)

    def make_plane(self, piece: Opaque, plane: Pose) -> Iterator[bytes]:
        """An endless plane."""
        if not self.tree.is_static(piece.body):
            self.lost.append(Loss(What.PLANES, (piece.name,), "MuJoCo has planes on bodies that do not move only"))
            return
        said = pose_attributes(self.poses[piece.body].inverse() @ plane)
        yield tag("geom", {**self._name_attribute(piece.name), "type": "plane", "size": "0 0 1", **said})

    def make_surface(self, piece: Opaque, surface: Surface) -> Iterator[bytes]:
        """An opaque surface to look at, where its body shows nothing else."""
        why = "MuJoCo would collide with the convex hull"
        if any(body == piece.body for body, _ in self.shown):
            self.lost.append(Loss(What.OPAQUE, (piece.name,), f"{why}, and the body shows a visual already"))
            return
        seen = self.files.add_visual(piece.name, surface, self.poses[piece.body])
        assert seen is not None  # only files may be unreadable
        assert isinstance(seen.what, str)
        self.lost.append(Loss(What.OPAQUE, (piece.name,), why, "written as a surface that does not collide"))
        yield _visual(mesh_geom_attributes(self.meshes.add_visual(seen.what, seen.scale), seen.pose), None)

    def losses(self) -> tuple[Loss, ...]:
        """What is lost, visuals without a file that can be read included."""
        if not self.files.refused:
            return tuple(self.lost)
        refused = tuple(dict.fromkeys(self.files.refused))
        return (Loss(What.VISUALS, refused, "their files cannot be read"), *self.lost)


def _visual(attributes: dict[str, str], rgba: Rgba | None) -> bytes:
    color = {"rgba": shown(rgba)} if rgba else {}
    return tag("geom", {"class": "visual", **attributes, **color})
