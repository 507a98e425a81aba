"""The links of a new URDF or SDF, with what an asset of another format has on each: collisions, visuals and a mass."""

from abc import ABC, abstractmethod
from types import UnionType

import numpy as np

from meshforge.formats import base, conversion, element_edits, kinematic_tree, mesh_output, xml
from meshforge.formats.visuals import unreadable_visuals, visuals_of
from meshforge.geometry import Pose
from meshforge.symbolic import Asset, FeatureKind, Inertial, JointKind, NonConvexPiece, Rgba, Surface


class LinkCreator(ABC):
    """Collects what the links of a new file hold; native: the shapes that the format has of its own, kinds: its joints.

    links: what each link of the chain is called in the file; outputs: its collisions; shown: its visuals.
    """

    native: UnionType
    title: str
    kinds: tuple[JointKind, ...]
    has_world: bool = False
    visual_suffixes: tuple[str, ...]
    lead: bytes

    def __init__(self, asset: Asset, maker: element_edits.ElementMaker) -> None:
        self.asset, self.maker = asset, maker
        self.visuals = mesh_output.VisualFiles(
            maker.files, lambda mesh: mesh.suffix.lower() in self.visual_suffixes, self.native
        )
        self.inertials = {inertial.body: inertial for inertial in asset.mechanism.inertials}
        self.lost: list[base.Loss] = []
        visuals = visuals_of(asset)
        self.visuals.gather(visuals)
        used = {g.body for g in asset.geoms} | {o.body for o in asset.non_convex} | {body for body, _ in visuals}
        bare = {body.name for body in asset.bodies} - used - set(self.inertials)
        self.chain = kinematic_tree.KinematicChain(asset, bare, self.kinds, self.has_world)
        self.couplings = conversion.plan_couplings(asset.mechanism.joints, self.title)
        self.links = self.name_links(bare)
        self.outputs = self._build_outputs()
        self.shown = {link: self._build_visuals(link) for link in self.links}

    def name_links(self, bare: set[str]) -> dict[str, str]:
        """Return the name of each link in the file; bare: bodies that have nothing."""
        return {link: link for link in self.chain.frames}

    @abstractmethod
    def refuse_surface(self, surface: Surface) -> str:
        """Return why a non-convex piece of such a surface is not written, empty where it is."""

    def build_plane(self, piece: NonConvexPiece, link_t_plane: Pose) -> list[element_edits.OutputElement]:
        """Return the collision of an endless plane; none where the format has none."""
        return []

    @abstractmethod
    def color_lines(self, rgba: Rgba) -> list[bytes]:
        """Return the lines of the colour of a visual."""

    def visual_lines(self, visual: mesh_output.LinkVisual, **attributes: str) -> list[bytes]:
        """Return the lines of a `<visual>`."""
        if isinstance(visual.what, str):
            scale = None if np.array_equal(visual.scale, np.ones(3)) else visual.scale
            pose, kind = visual.pose, self.maker.mesh_lines(visual.what, scale)
        else:
            native = self.maker.native_lines(visual.what)
            assert native is not None  # a file is made for every shape that is not native
            pose, kind = native
        color = self.color_lines(visual.rgba) if visual.rgba else []
        return xml.nest("visual", *self.maker.geometry_lines(pose, kind), *color, **attributes)

    def inertial_of(self, link: str) -> tuple[Inertial | None, Pose]:
        """Return the mass of a link, and the frame of the link as the mass has it."""
        body = next((body for body, own in self.chain.of_body.items() if own == link), None)
        if body:
            return self.inertials.get(body), self.chain.frames[link]
        return kinematic_tree.LIGHT_INERTIAL if link in self.chain.light else None, Pose.identity()

    @property
    def weightless(self) -> list[str]:
        """The links without a mass."""
        return [link for link in self.links if link not in self.inertials and link not in self.chain.light]

    def collect_losses(self) -> tuple[base.Loss, ...]:
        """Return what the file does not hold."""
        return (*self.chain.lost, *self.couplings.lost, *self.lost, *unreadable_visuals(self.visuals.refused))

    def _build_outputs(self) -> dict[str, list[element_edits.OutputElement]]:
        outputs: dict[str, list[element_edits.OutputElement]] = {link: [] for link in self.links}
        for geom in self.asset.geoms:
            link = self.chain.of_body[geom.body]
            outputs[link].append(self.maker.make_element(geom, self.chain.frames[link], None, self.lead))
        for piece in self.asset.non_convex:
            link, surface = self.chain.of_body[piece.body], piece.surface
            if piece.plane is not None:
                outputs[link] += self.build_plane(piece, self.chain.frames[link].inverse() @ piece.plane)
            elif surface is not None and (why := self.refuse_surface(surface)):
                self.lost.append(base.Loss(FeatureKind.NON_CONVEX, (piece.name,), why))
            elif surface is not None:
                outputs[link].append(self.maker.make_surface(piece, self.chain.frames[link], surface, self.lead))
        return outputs

    def _build_visuals(self, link: str) -> list[mesh_output.LinkVisual]:
        own = [(body, visual) for body, visual in visuals_of(self.asset) if self.chain.of_body[body] == link]
        placed = (self.visuals.add_visual(body, visual, self.chain.frames[link]) for body, visual in own)
        return [visual for visual in placed if visual is not None]
