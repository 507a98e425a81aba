"""The symbolic hull, a convex shape with a name, a body and a label; and the label, with its confidence and source."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from typing import Any, Literal, get_args

from meshforge.common import UsageError, import_extra
from meshforge.geometry import Aabb, Floats, Ints, Pose, Shape

# fmt: off
LabelSource = Literal[
    "vlm", "like", "propagated", "rebuild", "name", "file", "user", "repair", "edit", "plugin", "step", "class",
]
# fmt: on
LABEL_SOURCES: tuple[str, ...] = get_args(LabelSource)
HUMAN_SOURCES = frozenset({"user", "repair"})
INFERRED_SOURCES = frozenset({"propagated", "class"})
"""Sources of labels that follow from those of other hulls."""
GIVEN_SOURCES = HUMAN_SOURCES | {"file"}
"""Sources of labels that are not guessed: a person, or a file that somebody made."""
CLASS_SOURCES = frozenset({"step", "class"})
"""Sources of classes, which stand where a hull has no label: the steps that took it, and those that took its likes."""
CERTAIN_SOURCES = HUMAN_SOURCES | {"step"}
"""Sources of labels that follow from what a person said or showed of this hull."""
NO_PART = "no part"
"""The name of the label which says that a hull is none of the parts; it is in no vocabulary and no program."""
_LETTERS = "abcdefghijklmnopqrstuvwxyz"


def name_class(rules: Collection[int]) -> str:
    """Return the made name of the hulls that rules of some numbers take: `part_a` for rule 1, `part_ac` for 1 and 3."""
    if not rules:
        return NO_PART
    if max(rules) > len(_LETTERS):
        return f"part_{'_'.join(map(str, sorted(rules)))}"
    return f"part_{''.join(_LETTERS[rule - 1] for rule in sorted(rules))}"


def is_class_name(label: str) -> bool:
    """Return whether a label is one that `name_class` makes."""
    word = label.removeprefix("part_")
    if label == NO_PART or word == label:
        return label == NO_PART
    if all(part.isdecimal() for part in word.split("_")):
        return True
    return set(word) <= set(_LETTERS) and list(word) == sorted(set(word)) and bool(word)


def refuse_class_names(labels: Iterable[str]) -> None:
    """Raise UsageError for a label that `name_class` makes."""
    if made := next(filter(is_class_name, labels), None):
        remedy = "Choose another name."
        raise UsageError(f"{made!r} is a name that MeshForge gives to hulls that steps take", remedy=remedy)


@dataclass(frozen=True, slots=True)
class Label:
    """A label with confidence in 0..1 and source; given: the label that an inferred one replaced, None without one."""

    name: str
    confidence: float = 1.0
    source: LabelSource = "user"
    given: "Label | None" = None

    @staticmethod
    def of(value: "Label | str") -> "Label":
        """Return a label as it is; one that is given by its name is a person's, and sure."""
        return value if isinstance(value, Label) else Label(value)

    @property
    def names(self) -> tuple[str, ...]:
        """Its own, and that of the label that it replaced."""
        return (self.name, *(self.given.names if self.given else ()))

    def rename(self, old: str, new: str) -> "Label":
        """Return the same where a label has another name; a class that gets one is a label of a person, or inferred."""
        if self.name == old and self.source in CLASS_SOURCES:
            return Label(new) if self.source == "step" else Label(new, self.confidence, "propagated")
        given = self.given.rename(old, new) if self.given else None
        return replace(self, name=new if self.name == old else self.name, given=given)


@dataclass(frozen=True, eq=False, slots=True)
class Hull:
    """One node of the symbolic mesh (paper, definition of the symbolic collision mesh).

    shape: in the mesh's frame; parent: see `Geom`, None for a hull of the file; keeps_name: whether it alone took the
    place of its parent alone, whose name it gets in a file.
    """

    name: str
    body: str
    shape: Shape
    annotation: Label | None = None
    parent: str | None = None
    keeps_name: bool = False

    def __repr__(self) -> str:
        kind = type(self.primitive).__name__.lower() if self.primitive else f"{len(self.vertices)} vertices"
        label = f", label {self.label}" if self.label else ""
        return f"<Hull {self.name!r}: {kind}, body {self.body}{label}>"

    @property
    def label(self) -> str | None:
        """Its label, None also where it is known to be none of the parts."""
        return self.annotation.name if self.annotation and self.annotation.name != NO_PART else None

    @property
    def confidence(self) -> float | None:
        return self.annotation.confidence if self.annotation else None

    @property
    def source(self) -> str | None:
        return self.annotation.source if self.annotation else None

    @property
    def vertices(self) -> Floats:
        """Vertices (n, 3) [m]; of a primitive, those of its tessellation."""
        return self.shape.vertices

    @property
    def faces(self) -> Ints:
        """Outward triangles (m, 3); of a primitive, those of its tessellation."""
        return self.shape.faces

    @property
    def aabb(self) -> Aabb:
        return self.shape.aabb

    @property
    def volume(self) -> float:
        return self.shape.volume

    @property
    def primitive(self) -> Shape | None:
        """The native primitive, or None for a polytope."""
        return self.shape if self.shape.is_primitive else None

    def to_trimesh(self) -> Any:
        """Return a `trimesh.Trimesh` of the vertices and faces; `.metadata` has name, body and label.

        Raises MeshForgeError where trimesh is not installed.
        """
        trimesh = import_extra("trimesh", "trimesh", "to_trimesh()")
        metadata = {"name": self.name, "body": self.body, "label": self.label}
        return trimesh.Trimesh(self.vertices.copy(), self.faces.copy(), process=False, metadata=metadata)

    def with_label(self, annotation: Label | None) -> "Hull":
        return replace(self, annotation=annotation)

    def move(self, pose: Pose) -> "Hull":
        return replace(self, shape=self.shape.move(pose))
