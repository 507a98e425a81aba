"""What a model is told and how it is asked, besides the pictures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from meshforge.errors import UsageError
from meshforge.perception.vlm.modes import MODES, Mode, ModeName

_UNKNOWN = ("unknown", "cannot tell", "?")


@dataclass(frozen=True, slots=True)
class Manner:
    """vocabulary: the labels; descriptions: a line on some of them, by label; about: a line on what the meshes are.

    names: tells the names of assets and hulls, too; repeats: how often each question is asked; room: tokens for an
    answer besides those it needs, more of which a model wants that thinks first; size: of pictures [px], None as of the
    mode. Raises UsageError for what cannot be.
    """

    vocabulary: tuple[str, ...]
    mode: ModeName = "balanced"
    descriptions: Mapping[str, str] = field(default_factory=dict)
    about: str = ""
    names: bool = False
    repeats: int = 1
    room: int = 1000
    size: int | None = None

    def __post_init__(self) -> None:
        if not self.vocabulary:
            raise UsageError("the vocabulary is empty", remedy="Say first what hulls can be: --vocabulary a,b,c.")
        odd = next((label for label in self.descriptions if label not in self.vocabulary), None)
        if odd is not None:
            raise UsageError(f"the label {odd!r} is described, but is not in the vocabulary")

    @property
    def how(self) -> Mode:
        how = MODES[self.mode]
        return how if self.size is None else replace(how, size=self.size)

    @property
    def unknown(self) -> str:
        """What a model says of a hull that it does not know."""
        return next(word for word in _UNKNOWN if word not in self.vocabulary)

    def words(self, repeat: int = 0) -> Sequence[str]:
        """The labels; in repeats they are told in another order, since the order must not matter."""
        turn = repeat % len(self.vocabulary)
        return (*self.vocabulary[turn:], *self.vocabulary[:turn])
