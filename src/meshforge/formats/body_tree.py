"""The bodies of an asset as a tree, for formats that write them one within or after another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from meshforge.asset import Asset, Joint, unique_names


@dataclass(frozen=True, slots=True)
class BodyTree:
    """Who hangs on whom.

    order: all bodies, each after its parent, else in the order of the asset; joints: those that lead to each body, the
    one nearest to its parent first; none for a root.
    """

    order: tuple[str, ...]
    joints: Mapping[str, Sequence[Joint]]

    @staticmethod
    def of(asset: Asset) -> BodyTree:
        """The tree of an asset's joints, their names made unique; each body that no joint leads to is a root."""
        joints: dict[str, list[Joint]] = {body.name: [] for body in asset.bodies}
        below: dict[str, list[str]] = {body.name: [] for body in asset.bodies}
        names = iter(unique_names(joint.name for joint in asset.mechanism.joints if joint.name))
        for joint in asset.mechanism.joints:
            if not joints[joint.child]:
                below[joint.parent].append(joint.child)
            joints[joint.child].append(replace(joint, name=next(names)) if joint.name else joint)
        waiting = [name for name in reversed(joints) if not joints[name]]
        order: list[str] = []
        while waiting:
            order.append(waiting.pop())
            waiting.extend(reversed(below[order[-1]]))
        return BodyTree(tuple(order), joints)

    def parent(self, body: str) -> str | None:
        """The body that a body hangs on, None for a root."""
        joints = self.joints[body]
        return joints[0].parent if joints else None

    def is_static(self, body: str) -> bool:
        """Whether nothing between a body and its root can move."""
        at: str | None = body
        while at is not None:
            if any(joint.kind != "fixed" for joint in self.joints[at]):
                return False
            at = self.parent(at)
        return True

    @property
    def joint_names(self) -> set[str]:
        return {joint.name for joints in self.joints.values() for joint in joints if joint.name}

    @property
    def roots(self) -> list[str]:
        return [name for name in self.order if not self.joints[name]]


def free_name(wanted: str, taken: set[str]) -> str:
    """A name that is not taken: the wanted one, or with a number behind it; it is taken from then on."""
    name, number = wanted, 2
    while name in taken:
        name, number = f"{wanted}_{number}", number + 1
    taken.add(name)
    return name
