"""The prims of the bodies of a stage that is made: which of them move, where they are, and what stands between."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from meshforge.asset import Asset, Joint
from meshforge.formats.body_tree import BodyTree, free_name
from meshforge.formats.usd.document import BODY
from meshforge.geometry import Pose

_WORLDS = (BODY, "world")


@dataclass(frozen=True, slots=True)
class Links:
    """poses: root_T_link of each rigid body of the stage; joints: one for each pair; between: links that stand for no
    body, between several joints of one.
    """

    poses: Mapping[str, Pose]
    joints: tuple[Joint, ...]
    between: tuple[str, ...]

    @staticmethod
    def of(asset: Asset) -> Links:
        """The links of an asset; the body of what never moves is none, nor is the world of MuJoCo."""
        tree, weights = BodyTree.of(asset), {inertial.body for inertial in asset.mechanism.inertials}
        fixed = {root for root in tree.roots if root in _WORLDS and root not in weights}
        poses = {body.name: body.pose for body in asset.bodies if body.name not in fixed}
        taken, joints, between = set(asset.body_poses), list[Joint](), list[str]()
        for body in tree.order:
            own = tree.joints[body]
            parent = own[0].parent if own else ""
            for k, joint in enumerate(own):
                child = body if k == len(own) - 1 else free_name(f"{body}_link", taken)
                if child != body:
                    between.append(child)
                    poses[child] = asset.body_poses[body]
                joints.append(replace(joint, parent=parent, child=child))
                parent = child
        return Links(poses, tuple(joints), tuple(between))
