"""The question whether assets are turned first, on the asset of a family that shows best what that does."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from meshforge.common import MeshForgeError
from meshforge.geometry import Floats
from meshforge.label_model.describe import find_up, rotation_to_z, up_in_file
from meshforge.language import Orient, find_rotation
from meshforge.signoff.assessment import ReviewState
from meshforge.signoff.question import NO, YES, YES_OR_NO, ReviewChoice, ReviewQuestion, identify
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import OrientationSuggestion

_SEEN = 5.0  # degrees by which an asset must turn, to be seen
_NEAR = 10.0  # degrees by which an asset may still lean where landmarks set it upright


def ask_orientation(
    suggested: OrientationSuggestion | None, state: ReviewState, gain: float
) -> Iterator[ReviewQuestion]:
    """Ask whether all assets are to be turned as is suggested, where it is worth asking."""
    asset = find_turned_asset(state, suggested) if suggested else None
    if suggested and asset:
        text = f"Should {asset} stand like this?"
        yes = ReviewChoice(YES, "yes, turn all assets like this", orient=suggested.orient)
        choices = (ReviewChoice(NO, "no, all stay as they are"), yes)
        yield identify(ReviewQuestion("orientation", text, YES_OR_NO, gain, asset, choices=choices))


def find_turned_asset(state: ReviewState, suggested: OrientationSuggestion) -> str | None:
    """Return the asset to ask about: one that turns neither least nor most, of those whose selections change if there
    are any.

    None where some asset that has labels cannot be turned, or none turns so that it is seen. Beside a program only what
    is set upright counts, and None also where as many assets lean once they are turned.
    """
    turned, leaning = dict[str, float](), 0
    for name, mesh in state.meshes.items():
        if name in state.excluded or not any(hull.label for hull in mesh.hulls):
            continue
        try:
            before, after = (_show_upright(mesh, orient) for orient in (state.frame.orient, suggested.orient))
        except MeshForgeError:
            return None
        turn = _to_degrees(float(np.sum(before * after) - 1) / 2)
        is_tilted = suggested.before and _angle(before[2], after[2]) > _SEEN
        upright = find_up(mesh, after[2]) if is_tilted else after[2]
        if _angle(upright, after[2]) > _NEAR:
            leaning += 1
        elif (_angle(upright, before[2]) if suggested.before else turn) > _SEEN:
            turned[name] = turn
    names = sorted([name for name in suggested.differs_on if name in turned] or turned, key=turned.__getitem__)
    return names[len(names) // 2] if len(turned) > leaning else None


def _show_upright(mesh: SymbolicMesh, orient: Orient | None) -> Floats:
    """The rotation (3, 3) that shows a mesh: by an orientation, then so that Z points up. Raises ProgramError."""
    turn = find_rotation(mesh, orient) if orient else np.eye(3)
    return turn if orient and orient.names_z else rotation_to_z(up_in_file(mesh)) @ turn


def _angle(a: Floats, b: Floats) -> float:
    return _to_degrees(float(a @ b))


def _to_degrees(cosine: float) -> float:
    return float(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))
