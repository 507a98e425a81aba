"""Looks at a mesh: which hulls are asked about together, in which pictures."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from meshforge.perception.vlm.evidence import clearness
from meshforge.perception.vlm.manner import Manner
from meshforge.perception.vlm.prompt import form, instructions, request
from meshforge.perception.vlm.question import Message, Question
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from meshforge.views import Shot

_ENTRY = 30  # tokens of an answer for each hull, at most
_SAID = 15  # and about as many as it takes


@dataclass(frozen=True, slots=True)
class Look:
    """A question about some hulls. hulls: by the number they have in it; weights: how well each is seen, in 0..1."""

    question: Question
    hulls: Mapping[int, str]
    weights: Mapping[str, float]
    repeat: int

    @property
    def expected(self) -> int:
        """About how many tokens the answer has."""
        return _SAID * (len(self.hulls) + 1)

    def show_examples(self, examples: tuple[Message, ...]) -> Look:
        """The same question with messages that show labelled assets before its own pictures."""
        instructions, *pictures = self.question.messages
        return replace(self, question=replace(self.question, messages=(instructions, *examples, *pictures)))


def looks(
    mesh: SymbolicMesh,
    wanted: Collection[str],
    manner: Manner,
    name: str = "",
) -> Iterator[Look]:
    """The questions about a mesh. Groups in which no hull is wanted are passed over.

    The groups do not depend on what is wanted, so that answers can be found again when some hulls have a label by then.
    name: that of the asset, told where the manner says so.
    """
    from meshforge.views import shots

    how = manner.how
    names = [hull.name for hull in mesh.hulls]
    for group in _groups(names, how.hulls):
        if set(group).isdisjoint(wanted):
            continue
        taken = shots(mesh, hulls=group, most=how.pictures, size=how.size)
        parts = min(how.questions, len(taken))
        for part in range(parts):
            yield from _asked(mesh, taken[part::parts], group, manner, name if manner.names else "")


def _asked(
    mesh: SymbolicMesh,
    shots: tuple[Shot, ...],
    group: Collection[str],
    manner: Manner,
    name: str,
) -> Iterator[Look]:
    """One question about what some pictures show, in all its repeats."""
    shown = frozenset[str]().union(*(shot.numbered for shot in shots))
    numbers = {hull: mesh.index[hull] for hull in group if hull in shown}
    if not numbers:
        return
    pictures = request(shots, manner.how.plain, numbers, name)
    pixels = {hull: sum(shot.visible_pixels[hull] for shot in shots if hull in shot.numbered) for hull in numbers}
    weights = {hull: clearness(count, manner.how.size) for hull, count in pixels.items()}
    limit = manner.room + _ENTRY * len(numbers)
    for repeat in range(manner.repeats):
        messages = instructions(manner, up_of(mesh), repeat), pictures
        question = Question(messages, form(manner, repeat), limit, repeat=repeat)
        yield Look(question, {number: hull for hull, number in numbers.items()}, weights, repeat)


def _groups(names: list[str], most: int) -> Iterator[list[str]]:
    """Names in their order, in as few groups as can be, of about one size."""
    count = -(-len(names) // most)
    for k in range(count):
        yield names[k * len(names) // count : (k + 1) * len(names) // count]


def up_of(mesh: SymbolicMesh) -> str:
    """The axis that points up in pictures of a mesh, as `+Z`."""
    from meshforge.views.subject import up_axis

    return f"+{up_axis(mesh, None)}"
