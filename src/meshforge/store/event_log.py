"""Reads and writes the events and sign-offs of a project; one of before there were events is read from its four files,
which the first write replaces: they stay beside as `*.old`."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from meshforge.common import ProjectError, first_validation_error, write_atomically
from meshforge.store.events import (
    AnswerEvent,
    Event,
    ExclusionEvent,
    LabelFixEvent,
    SnoozeEvent,
    VerdictEvent,
    format_lines,
)
from meshforge.store.feedback import Feedback, read_events, read_feedback
from meshforge.store.layout import Layout
from meshforge.store.sign_off import SignOff, parse_sign_offs

Line = TypeVar("Line")
_BY_HAND = "Correct the file by hand, or remove it."
_SET_ASIDE = "set aside"  # the note of verdicts by which assets were given up


def load_events(layout: Layout) -> tuple[Event, ...]:
    """All events, in order. Raises ProjectError, naming file and line, where they cannot be read."""
    text = _read_text(layout.events)
    return tuple(_migrate(layout)) if text is None else read_events(text, str(layout.events))


def load_feedback(layout: Layout) -> Feedback:
    """What all events come to. Raises ProjectError as `load_events` does."""
    text = _read_text(layout.events)
    return Feedback.of(_migrate(layout)) if text is None else read_feedback(text, str(layout.events))


def save_events(layout: Layout, events: Iterable[Event]) -> None:
    """Write all events, under the lock that the caller holds; files of before there were events stay as `*.old`."""
    before = [path for path in layout.files_before_events if path.exists()]
    if before:  # first, since the old ones count no more once there are events
        save_sign_offs(layout, load_sign_offs(layout))
    write_atomically(layout.events, format_lines(events))
    for path in before:
        path.replace(path.with_name(f"{path.name}.old"))


def load_sign_offs(layout: Layout) -> dict[str, SignOff]:
    """Which assets are signed off. Raises ProjectError, naming file and line, where they cannot be read."""
    text = _read_text(layout.sign_offs)
    if text is not None:
        return parse_sign_offs(text, str(layout.sign_offs))
    if layout.events.exists():
        return {}
    return dict(_read_from(layout.files_before_events[2], _migrate_sign_offs))


def save_sign_offs(layout: Layout, signed: Mapping[str, SignOff]) -> None:
    """Write the sign-offs, under the lock that the caller holds."""
    write_atomically(layout.sign_offs, format_lines(one for _, one in sorted(signed.items())))


def _read_text(path: Path) -> str | None:
    try:
        return path.read_text("utf-8-sig")
    except FileNotFoundError:
        return None
    except (OSError, UnicodeDecodeError) as error:
        raise ProjectError("cannot be read", where=str(path), remedy=_BY_HAND) from error


def _migrate(layout: Layout) -> Iterator[Event]:
    """What the files of before there were events say."""
    readers: tuple[Callable[[Mapping[str, Any]], Iterator[Event]], ...] = (
        _migrate_answers,
        _migrate_verdicts,
        _migrate_exclusions,
        _migrate_snoozes,
    )
    for path, read in zip(layout.files_before_events, readers, strict=True):
        yield from _read_from(path, read)


def _read_from(path: Path, read: Callable[[Mapping[str, Any]], Iterator[Line]]) -> Iterator[Line]:
    """What a file of before there were events says. Raises ProjectError, naming it, where it is not what it was."""
    try:
        yield from read(_read_old(path))
    except ValidationError as error:
        raise ProjectError(first_validation_error(error), where=str(path), remedy=_BY_HAND) from error
    except (KeyError, TypeError, AttributeError) as error:
        raise _invalid(path, error) from error


def _read_old(path: Path) -> Mapping[str, Any]:
    text = _read_text(path)
    try:
        kept = json.loads(text) if text else {}
    except (ValueError, RecursionError) as error:
        raise _invalid(path, error) from error
    if not isinstance(kept, dict):
        raise _invalid(path, TypeError("it is no object"))
    return kept


def _invalid(path: Path, error: Exception) -> ProjectError:
    return ProjectError(f"cannot be read: {error}", where=str(path), remedy=_BY_HAND)


def _migrate_answers(kept: Mapping[str, Any]) -> Iterator[Event]:
    yield from (AnswerEvent(**_without_id(line)) for line in kept.get("answers", ()))
    yield from (LabelFixEvent(**_without_id(line), accepted=True) for line in kept.get("confirmed", ()))
    yield from (LabelFixEvent(**_without_id(line), accepted=False) for line in kept.get("rejected", ()))


def _without_id(line: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in line.items() if name != "id"}


def _migrate_verdicts(kept: Mapping[str, Any]) -> Iterator[Event]:
    for asset, line in kept.get("assets", {}).items():
        is_given_up = line["verdict"] == "flagged" and line.get("note") == _SET_ASIDE
        verdict = "accepted" if line["verdict"] == "accepted" else "wrong"
        yield VerdictEvent(**{**line, "asset": asset, "verdict": verdict})
        if is_given_up:
            yield ExclusionEvent(asset=asset, reason="not solved")


def _migrate_sign_offs(kept: Mapping[str, Any]) -> Iterator[tuple[str, SignOff]]:
    yield from ((asset, SignOff(**{**line, "asset": asset})) for asset, line in kept.get("assets", {}).items())


def _migrate_exclusions(kept: Mapping[str, Any]) -> Iterator[Event]:
    yield from (ExclusionEvent(asset=asset, reason="not solved") for asset in kept.get("aside", ()))


def _migrate_snoozes(kept: Mapping[str, Any]) -> Iterator[Event]:
    yield from (SnoozeEvent(question=question) for question in kept.get("questions", ()))
