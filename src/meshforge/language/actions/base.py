"""The base of all actions."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, get_args

from meshforge.language.actions.edit import GroupEdit, HullGroup
from meshforge.language.arguments import ArgumentType, MissingOperation, Operation
from meshforge.symbolic import SymbolicMesh, split_by_body

Axis = Literal["all", "X", "Y", "Z"]
AXES: tuple[Axis, ...] = get_args(Axis)
ActionIcon = Literal["delete", "replace", "add", "merge", "scale", "shrink", "shapes"]


class Action(Operation, ABC):
    """One editing action."""

    __slots__ = ()
    by_body: ClassVar[bool] = False
    """Whether it acts on each body's hulls separately, since what it makes is one part."""
    key: ClassVar[str] = ""
    """The key that begins it in the studio, as `M` or `Shift+A`; without one it is begun by its button alone."""
    icon: ClassVar[ActionIcon] = "shapes"
    """Its picture in the studio."""

    def groups(self, mesh: SymbolicMesh, mask: int) -> list[int]:
        """Return the parts of a selection that are edited one by one, as bit sets."""
        return split_by_body(mesh, mask) if self.by_body else [mask] if mask else []

    def note_on(self, mesh: SymbolicMesh, mask: int) -> str | None:
        """Return what a user should know of acting on a selection, besides the notes on its parts."""
        return None

    @abstractmethod
    def edit(self, group: HullGroup) -> GroupEdit:
        """Return what becomes of one group of at least one hull. Raises ProgramError for a missing template."""

    @property
    def makes_hulls(self) -> bool:
        """Whether `as LABEL` may follow."""
        return True

    @property
    def templates(self) -> tuple[str, ...]:
        """The template files it names."""
        return ()

    @property
    def depends_on_frame(self) -> bool:
        """Whether it would do something else if the mesh were turned first, and back afterwards."""
        return False

    @classmethod
    def title(cls) -> str:
        """Return what it does to a selection, as a command in the studio."""
        return f"{cls.__name__} the selection"

    def phrase(self, whose: str) -> str:
        """Return what is done, in words after "is" or "are": `merged into one convex hull`; whose: "its" or "their"."""
        return f"edited by {self}"


@dataclass(frozen=True, slots=True)
class MissingAction(MissingOperation, Action):
    """An action that cannot be loaded here."""

    def edit(self, group: HullGroup) -> GroupEdit:
        self.fail()


@dataclass(frozen=True, slots=True)
class ActionArgument(ArgumentType):
    """An action inside another; the parser reads it, since it has arguments of its own."""

    usage = "action"
    wants = "an action"

    def fits(self, value: Any) -> bool:
        return isinstance(value, Action)
