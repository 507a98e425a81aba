"""One rule on one mesh in the canonical frame, and the way into that frame and back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from meshforge.geometry import Pose
from meshforge.language.actions.edit import Template
from meshforge.language.apply import ActionResult, apply_action
from meshforge.language.orient import orient_mesh
from meshforge.language.print import Rule
from meshforge.language.syntax import EXTREMITY, Orient, select_mask
from meshforge.symbolic import Hull, SymbolicMesh, bits_of


@dataclass(frozen=True, slots=True)
class RuleTrace:
    """What one rule did on a mesh; rule: its number from 1; selected, made: names of hulls.

    sources: for each made hull, the names of the hulls it was made from; note: what a user should know.
    """

    rule: int
    selected: tuple[str, ...]
    made: tuple[str, ...] = ()
    note: str | None = None
    sources: tuple[tuple[str, ...], ...] = ()

    def to_json(self) -> dict[str, Any]:
        """The trace as JSON-able data: rule, selected, made, note, and sources by made name."""
        return {
            "rule": self.rule,
            "selected": list(self.selected),
            "made": list(self.made),
            "note": self.note,
            "sources": {name: list(names) for name, names in zip(self.made, self.sources, strict=True)},
        }


def to_canonical_frame(
    mesh: SymbolicMesh, orient: Orient | None, contact: float | None = None
) -> tuple[SymbolicMesh, Pose]:
    """The mesh as the first rule sees it: oriented, with L fixed; and the pose oriented_T_incoming.

    contact: the program's epsilon, None keeps the mesh's.
    """
    oriented, pose = orient_mesh(mesh, orient)
    staged = replace(oriented, epsilon=mesh.epsilon if contact is None else contact, scale=oriented.diagonal)
    if "graph" in oriented.__dict__ and staged.contact_distance == oriented.contact_distance:
        staged.__dict__["graph"] = oriented.graph  # the same shapes and reach, so not measured again
    return staged, pose


def from_canonical_frame(incoming: SymbolicMesh, staged: SymbolicMesh, pose: Pose) -> SymbolicMesh:
    """An edited mesh back in the frame it came in; pose: oriented_T_incoming. The inverse of `to_canonical_frame`."""
    back = pose.inverse()
    turned = not np.array_equal(pose.rotation, np.eye(3))
    hulls = tuple(_restore_hull(incoming, hull, back if turned else None) for hull in staged.hulls)
    same = incoming.scale is None and len(hulls) == len(incoming.hulls)
    if same and all(a is b for a, b in zip(hulls, incoming.hulls, strict=True)):
        return incoming
    return replace(incoming, hulls=hulls, scale=None)


def apply_rule(
    mesh: SymbolicMesh,
    rule: Rule,
    templates: Mapping[str, Template] | None = None,
    extremity: float | None = None,
    used: frozenset[str] = frozenset(),
) -> tuple[tuple[str, ...], ActionResult]:
    """Names of the hulls that a rule selects in a staged mesh, and what its action makes of them."""
    mask = select_mask(rule.extractor, mesh, EXTREMITY if extremity is None else extremity)
    selected = tuple(mesh.hulls[index].name for index in sorted(bits_of(mask)))
    return selected, apply_action(mesh, mask, rule.action, templates, rule.label, used)


def _restore_hull(incoming: SymbolicMesh, hull: Hull, back: Pose | None) -> Hull:
    """A hull in the incoming frame: the original where it was kept, relabelled where the program did so."""
    if hull.name in incoming.index:
        original = incoming.hull_of(hull.name)
        return original if original.annotation == hull.annotation else original.with_label(hull.annotation)
    return hull.move(back) if back else hull
