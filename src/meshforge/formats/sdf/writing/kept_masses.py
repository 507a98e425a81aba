"""The masses of edited links that Gazebo computes of their collisions, told as they were before the edit."""

from __future__ import annotations

from meshforge.asset import Asset
from meshforge.errors import AssetError
from meshforge.formats.element_plan import Plan
from meshforge.formats.sdf.document import SdfDocument
from meshforge.formats.sdf.making.moving import inertial_lines
from meshforge.formats.xml import Splice, indent, newline


def kept_masses(asset: Asset, document: SdfDocument, plan: Plan) -> list[Splice]:
    """The edits that make computed masses of the links that are edited explicit.

    Raises AssetError for a link of which a collision is no hull, so that its mass is not known.
    """
    edited = {slot.body for _, slots in plan.places for slot in slots if not slot.is_untouched}
    edited |= {one.link for one, (_, slots) in zip(plan.authored, plan.places, strict=True) if not slots}
    edited |= plan.ends.keys()
    known = {inertial.body: inertial for inertial in asset.mechanism.inertials}
    edits = []
    for body in sorted(edited & set(document.computed)):
        element = plan.links[body].first("inertial")
        assert element is not None  # it says that the mass is computed
        if body not in known:
            raise AssetError(
                f"Gazebo computes the mass of link {body!r} of collisions that are not all hulls: it is not known here",
                where=str(asset.path),
                remedy="Leave it to the new collisions (--mass recompute), or tell it in the file.",
            )
        lead = indent(plan.maker.data, element.start) or b""
        lines = inertial_lines(known[body], asset.body_poses[body])
        edits.append(Splice(element.start, element.end, (newline(plan.maker.data) + lead).join(lines)))
    return edits
