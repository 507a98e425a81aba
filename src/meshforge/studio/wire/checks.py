"""What is measured of an output, beside the same of the asset that it was made from."""

from __future__ import annotations

from typing import Literal

from meshforge.studio.wire.base import Wire

Part = Literal["engines", "physics", "clearance", "fit"]
"""What is measured at a time, what is quickest first; `engines` holds legality, too."""
Unit = Literal["m", "m/s", "kg", "l", "%", "°", ""]


class Fault(Wire):
    """A rule that does not hold. engine: whose limit it is, null for none; new: whether that came with the edit."""

    rule: str
    severity: Literal["error", "warning"]
    engine: str | None = None
    new: bool = True


class CheckFinding(Fault):
    """The same with the hulls that it concerns, by the names they have in the output."""

    hulls: tuple[str, ...]
    text: str
    remedy: str


class Figure(Wire):
    """A figure before and after the edit; null where it cannot be told."""

    what: str
    unit: Unit
    before: float | None
    after: float | None


class Checked(Wire):
    """What was measured. gone: how many findings about the asset are none of the output any more; notes: what could
    not be told, and why; cell: what is smaller is not seen [m]; pictured: whether pictures can be drawn of it."""

    part: Part
    figures: tuple[Figure, ...] = ()
    findings: tuple[CheckFinding, ...] = ()
    gone: int = 0
    notes: tuple[str, ...] = ()
    cell: float | None = None
    pictured: bool = False


class CheckPicture(Wire):
    """A picture that is drawn: the name that its address takes, and what it shows."""

    name: str
    text: str


class EngineView(Wire):
    """An engine whose limits are known; title: as its makers write it."""

    name: str
    title: str
