"""One asset and its hulls, the headers of shape packets, and the results of checks."""

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from meshforge.geometry import Shape
from meshforge.rendering import LabelLook, look_of
from meshforge.studio.wire import Wire
from meshforge.studio.wire.program import ActionView

PrimitiveKind = Literal["box", "cylinder", "capsule", "sphere", "ellipsoid"]

CheckPart = Literal["engines", "physics", "clearance", "fit"]
"""The parts of a check, the quickest first; `engines` includes legality."""
FigureUnit = Literal["m", "m/s", "kg", "l", "%", "°", ""]


def _kind_of_primitive(shape: Shape) -> str | None:
    return shape.kind if shape.is_primitive else None


class HullView(Wire):
    """A hull, made of one of a mesh. vertices, faces: how many, of a round primitive those of its tessellation;
    primitive: its kind if it is one; source: who gave the label; look: whether it was given, null for no label; parent:
    the hull of the file that a new hull inherits from."""

    name: str
    body: str
    label: str | None = None
    confidence: float | None = None
    source: str | None = None
    look: Annotated[LabelLook | None, Field(validation_alias="annotation"), BeforeValidator(look_of)]
    volume: float = 0.0
    vertices: Annotated[int, BeforeValidator(len)]
    faces: Annotated[int, BeforeValidator(len)]
    primitive: Annotated[PrimitiveKind | None, Field(validation_alias="shape"), BeforeValidator(_kind_of_primitive)]
    parent: str | None = None


class NonConvexView(Wire):
    """A non-convex piece of collision geometry. reason: why it is no hull; surface: whether the packet has it."""

    name: str
    body: str
    reason: str
    surface: Annotated[bool, BeforeValidator(bool)] = False


class NearMiss(Wire):
    """Two hulls, by name, with a gap [m] between them of less than three times the contact distance."""

    a: str
    b: str
    gap: float


class StepView(Wire):
    """One step of a demonstration. select: names of hulls, [] for none, null where it is left open.

    error: why the step cannot be replayed; made, removed: names of hulls, where it can.
    """

    select: tuple[str, ...] | None
    action: ActionView
    error: str | None = None
    made: tuple[str, ...] = ()
    removed: tuple[str, ...] = ()


class ManualEditView(Wire):
    """An edit by hand that is replayed after the program."""

    select: tuple[str, ...]
    action: ActionView


class AssetView(Wire):
    """An asset as it is prepared, in the frame it comes in.

    upright: the 16 numbers (row by row) of canonical_T_incoming, null for the identity; unturned: why the orientation
    cannot turn it; y_up: whether, after the orientation, it turns Y up; version: of the steps, to be sent back with an
    edit of them; contacts: pairs of names of hulls.
    """

    asset: str
    bodies: tuple[str, ...]
    hulls: tuple[HullView, ...]
    non_convex: tuple[NonConvexView, ...] = ()
    has_visual: bool = False
    contacts: tuple[tuple[str, str], ...] = ()
    near_misses: tuple[NearMiss, ...] = ()
    upright: tuple[float, ...] | None = None
    unturned: str | None = None
    y_up: bool = False
    steps: tuple[StepView, ...] = ()
    version: str = ""
    manual_edits: tuple[ManualEditView, ...] = ()
    prepared: tuple[str, ...] = ()


class ShapeRow(Wire):
    """One shape of a packet, a hull, a non-convex piece or a visual surface; vertices, faces: how many."""

    name: str
    vertices: int
    faces: int


class ShapesHeader(Wire):
    """The header of a packet of the asset's own shapes: hulls first, then non-convex pieces; or the visual surfaces.

    A packet is: length of the header as uint32; the header as UTF-8 JSON, padded with spaces to a multiple of four;
    vertices of all rows as float32 (x, y, z) [m]; triangles of all rows as uint32 (three each, counted in their row).
    Little-endian, all in the frame that the asset comes in.
    """

    rows: tuple[ShapeRow, ...]


class TraceLine(Wire):
    """What one rule did. selected, made: names of hulls; note: what a user should know."""

    rule: int
    selected: tuple[str, ...]
    made: tuple[str, ...]
    note: str | None = None


class FindingView(Wire):
    """A finding of a check about a hull, or, without one, about the whole mesh."""

    severity: Literal["error", "warning", "note"]
    text: str
    hull: str | None = None


class EditHeader(Wire):
    """The header of a packet of an edited asset: all of its hulls, with the shapes of those that the asset has not.

    made, removed: names of hulls, compared with the asset as it comes; changed: of those that have another shape under
    the same name, as a format writes it that has no new names; trace: what each rule did; findings: of the
    check of legality; volume: the sum over hulls before and after [m^3].
    """

    rows: tuple[ShapeRow, ...]
    hulls: tuple[HullView, ...]
    made: tuple[str, ...]
    removed: tuple[str, ...]
    changed: tuple[str, ...] = ()
    note: str | None = None
    trace: tuple[TraceLine, ...] = ()
    findings: tuple[FindingView, ...] = ()
    flags: tuple[str, ...] = ()
    volume: tuple[float, float] = (0.0, 0.0)
    contacts: tuple[tuple[str, str], ...] = ()


class Fault(Wire):
    """A rule of a check that does not hold. engine: whose limit it is, or null; new: whether the edit caused it."""

    rule: str
    severity: Literal["error", "warning"]
    engine: str | None = None
    new: bool = True


class CheckFinding(Fault):
    """A fault with its text. hulls: those that it concerns, by their names in the output."""

    hulls: tuple[str, ...]
    text: str
    remedy: str


class Figure(Wire):
    """A figure before and after the edit; null where it is not known."""

    what: str
    unit: FigureUnit
    before: float | None
    after: float | None


class CheckResult(Wire):
    """The result of one part of a check. gone: how many findings about the asset the output no longer has; notes: what
    could not be measured, and why; cell: the resolution [m]; pictured: whether there are pictures of it."""

    part: CheckPart
    figures: tuple[Figure, ...] = ()
    findings: tuple[CheckFinding, ...] = ()
    gone: int = 0
    notes: tuple[str, ...] = ()
    cell: float | None = None
    pictured: bool = False


class CheckPicture(Wire):
    """A picture. text: what it shows; source: itself, as an address `data:…`."""

    text: str
    source: str
