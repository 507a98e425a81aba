"""One asset and its hulls, the headers of packets of shapes, and what checks measure of an output."""

from __future__ import annotations

from typing import Literal

from meshforge.studio.wire import Wire

PrimitiveKind = Literal["box", "cylinder", "capsule", "sphere", "ellipsoid"]

CheckPart = Literal["engines", "physics", "clearance", "fit"]
"""What is measured at a time, what is quickest first; `engines` holds legality, too."""
FigureUnit = Literal["m", "m/s", "kg", "l", "%", "°", ""]


class HullView(Wire):
    """A hull. vertices, faces: how many; primitive: its kind where it is one; source: who gave the label;
    parent: the hull of the file that a made hull inherits from."""

    name: str
    body: str
    label: str | None = None
    confidence: float | None = None
    source: str | None = None
    volume: float = 0.0
    vertices: int = 0
    faces: int = 0
    primitive: PrimitiveKind | None = None
    parent: str | None = None


class OpaqueView(Wire):
    """Collision geometry that is no hull, and why; `surface`: whether the packet has triangles of it."""

    name: str
    body: str
    reason: str
    surface: bool = False


class NearMiss(Wire):
    """Two hulls, by name, that are apart, yet by less than three times the contact distance; gap [m]."""

    a: str
    b: str
    gap: float


class StepView(Wire):
    """What the asset says about a rule. select: names, [] for nothing here, null for open.

    action: in the language's own text, with `as LABEL` where what is made gets one; error: why it cannot be replayed.
    made, removed: names of hulls, where it can.
    """

    rule: int
    select: tuple[str, ...] | None
    action: str
    error: str | None = None
    made: tuple[str, ...] = ()
    removed: tuple[str, ...] = ()


class CorrectionView(Wire):
    """An edit by hand that is replayed after the program."""

    select: tuple[str, ...]
    action: str


class AssetView(Wire):
    """An asset as it is prepared, in the frame it comes in.

    upright: the 16 numbers (row by row) of canonical_T_incoming, null where nothing turns it; unturned: why it cannot
    be turned though an orientation is set. version: of steps, to be given back with an edit of them.
    contacts: pairs of names. diagonal, contact_distance: [m].
    """

    asset: str
    path: str
    format: str
    up: Literal["y", "z"]
    bodies: tuple[str, ...]
    hulls: tuple[HullView, ...]
    opaque: tuple[OpaqueView, ...] = ()
    has_visual: bool = False
    contacts: tuple[tuple[str, str], ...] = ()
    near_misses: tuple[NearMiss, ...] = ()
    diagonal: float = 0.0
    contact_distance: float = 0.0
    upright: tuple[float, ...] | None = None
    unturned: str | None = None
    steps: tuple[StepView, ...] = ()
    version: str = ""
    corrections: tuple[CorrectionView, ...] = ()
    prepared: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


class ShapeRow(Wire):
    """One shape of a packet: how many vertices and triangles it has; opacity pieces and visuals have such rows, too."""

    name: str
    vertices: int
    faces: int
    rgba: tuple[float, float, float, float] | None = None


class ShapesHeader(Wire):
    """What a packet of the asset's own shapes holds: hulls first, then opaque pieces (or the visual surfaces).

    A packet is: length of the header as uint32; the header as UTF-8 JSON, padded with spaces to a multiple of four;
    vertices of all rows as float32 (x, y, z) [m]; triangles of all rows as uint32 (three each, counted in their row).
    Little-endian, all in the frame that the asset comes in.
    """

    rows: tuple[ShapeRow, ...]


class TraceLine(Wire):
    """What one rule did: names selected and made; note: what a user should know."""

    rule: int
    selected: tuple[str, ...]
    made: tuple[str, ...]
    note: str | None = None


class FindingView(Wire):
    """Something that a check has to say about a hull, or, without one, about the mesh."""

    severity: Literal["error", "warning", "note"]
    text: str
    hull: str | None = None


class EditedHeader(Wire):
    """What a packet of an edited asset holds: all hulls there are then, with shapes of those that the asset has not.

    made, removed: names, against the asset as it comes; trace: rule by rule; findings: of the check of legality.
    volume: the sum over hulls before and after [m^3].
    """

    rows: tuple[ShapeRow, ...]
    hulls: tuple[HullView, ...]
    made: tuple[str, ...]
    removed: tuple[str, ...]
    note: str | None = None
    trace: tuple[TraceLine, ...] = ()
    findings: tuple[FindingView, ...] = ()
    flags: tuple[str, ...] = ()
    volume: tuple[float, float] = (0.0, 0.0)
    contacts: tuple[tuple[str, str], ...] = ()


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
    unit: FigureUnit
    before: float | None
    after: float | None


class Checked(Wire):
    """What was measured. gone: how many findings about the asset are none of the output any more; notes: what could
    not be told, and why; cell: what is smaller is not seen [m]; pictured: whether pictures can be drawn of it."""

    part: CheckPart
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
