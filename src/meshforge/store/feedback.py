"""What all that people said of a family comes to: a fold over its events, which are read and written here."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Self, assert_never

from meshforge.common import write_atomically
from meshforge.store import events as kinds
from meshforge.store.events import Event, format_lines, parse_events, read_lines
from meshforge.store.layout import Layout


@dataclass(frozen=True, eq=False)
class Feedback:
    """answers, fixes: by id, in the order of their ids; verdicts: of each asset, in order, those since the last that
    was taken back; exclusions: by asset; snoozed: ids of questions; replied: the last reply to each.
    """

    answers: Mapping[str, kinds.AnswerEvent] = field(default_factory=dict)
    fixes: Mapping[str, kinds.LabelFixEvent] = field(default_factory=dict)
    verdicts: Mapping[str, tuple[kinds.VerdictEvent, ...]] = field(default_factory=dict)
    exclusions: Mapping[str, kinds.ExclusionEvent] = field(default_factory=dict)
    snoozed: tuple[str, ...] = ()
    replied: Mapping[str, Event] = field(default_factory=dict)

    @property
    def answers_and_fixes(self) -> Mapping[str, kinds.AnswerEvent | kinds.LabelFixEvent]:
        """The answers and fixes, which can be withdrawn by their ids."""
        return {**self.answers, **self.fixes}

    def verdict_on(self, asset: str) -> kinds.VerdictEvent | None:
        """Return the last verdict on an asset."""
        every = self.verdicts.get(asset, ())
        return every[-1] if every else None

    @classmethod
    def of(cls, events: Iterable[Event]) -> Self:
        """Return what events come to; of several on one thing the last counts."""
        answers, fixes = dict[str, kinds.AnswerEvent](), dict[str, kinds.LabelFixEvent]()
        verdicts, exclusions = dict[str, tuple[kinds.VerdictEvent, ...]](), dict[str, kinds.ExclusionEvent]()
        snoozed, replied = dict[str, None](), dict[str, Event]()
        for event in events:
            match event:
                case kinds.AnswerEvent():
                    answers[event.id] = event
                case kinds.LabelFixEvent():
                    fixes[event.id] = event
                case kinds.WithdrawalEvent():
                    answers.pop(event.id, None)
                    fixes.pop(event.id, None)
                case kinds.VerdictEvent():
                    verdicts[event.asset] = (*verdicts.get(event.asset, ()), event) if event.verdict else ()
                case kinds.ExclusionEvent():
                    exclusions[event.asset] = event
                case kinds.SnoozeEvent():
                    snoozed = {**snoozed, event.question: None} if event.question else {}
                case kinds.LabelsEvent() | kinds.ReplyEvent():
                    pass
                case _:
                    assert_never(event)
            replied |= {event.question: event} if event.question else {}
        return cls(
            {one.id: one for one in sorted(answers.values(), key=lambda one: (one.rule, one.asset))},
            dict(sorted(fixes.items())),
            dict(sorted((asset, some) for asset, some in verdicts.items() if some)),
            dict(sorted((asset, one) for asset, one in exclusions.items() if one.reason)),
            tuple(snoozed),
            replied,
        )


def load_events(layout: Layout) -> tuple[Event, ...]:
    """Read all events, in order. Raises ProjectError, naming file and line, where they cannot be read."""
    return _read_events(read_lines(layout.events), str(layout.events))


def load_feedback(layout: Layout) -> Feedback:
    """Return what all events come to. Raises ProjectError as `load_events` does."""
    return _read_feedback(read_lines(layout.events), str(layout.events))


def save_events(layout: Layout, events: Iterable[Event]) -> None:
    """Write all events, under the lock that the caller holds."""
    write_atomically(layout.events, format_lines(events))


@lru_cache(maxsize=4)
def _read_events(text: str, where: str) -> tuple[Event, ...]:
    return parse_events(text, where)


@lru_cache(maxsize=4)
def _read_feedback(text: str, where: str) -> Feedback:
    return Feedback.of(_read_events(text, where))
