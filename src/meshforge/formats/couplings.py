"""Couplings of joints on their way into another format: chains are followed to the joint that drives them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from meshforge.formats.base import Loss
from meshforge.symbolic import Coupling, FeatureKind, Joint


@dataclass(slots=True)
class CouplingPlan:
    """The coupling of each joint by its name, and what cannot be written."""

    by_joint: dict[str, Coupling] = field(default_factory=dict)
    lost: list[Loss] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def plan_couplings(joints: Sequence[Joint], title: str, *, polynomials: bool = False) -> CouplingPlan:
    """The couplings that a format gets; polynomials: whether it has those that are not linear."""
    plan = CouplingPlan()
    moving = {joint.name: joint for joint in joints if joint.kind in ("revolute", "prismatic") and joint.name}
    for joint in joints:
        if joint.coupling is None:
            continue
        found, way = joint.coupling, [joint.name]
        why = "" if moving.get(joint.name) is joint else "it neither turns nor slides, or has no name"
        while not why:
            driver = moving.get(found.joint)
            if driver is None:
                why = f"there is no joint {found.joint!r} that turns or slides"
            elif driver.name in way:
                why = f"{' -> '.join([*way, driver.name])} is a ring"
            elif not (found.is_linear or polynomials):
                why = f"it follows a polynomial, and {title} has linear couplings only"
            elif driver.coupling is None or not (found.is_linear and driver.coupling.is_linear):
                break
            else:
                (offset, factor), (before, inner) = found.coefficients, driver.coupling.coefficients
                found = Coupling(driver.coupling.joint, (offset + factor * before, factor * inner))
                way.append(driver.name)
        if why:
            plan.lost.append(Loss(FeatureKind.MIMICS, (joint.name,) if joint.name else (), why, unnamed=not joint.name))
            continue
        plan.by_joint[joint.name] = found
        if len(way) > 1:
            plan.notes.append(f"joint {way[0]!r} follows {found.joint!r} itself, no longer through {way[1]!r}")
    return plan
