"""What people selected on hulls that a preparation replaces: their steps, answers and edits by hand name the new hulls,
each line with what it named before until a person has confirmed it."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self, TypeVar

from meshforge import store as files
from meshforge.batch import Preparation
from meshforge.common import join_names
from meshforge.store import AnswerEvent, DemonstrationFile, Event, LabelFixEvent, ManualEditsFile, StepLine, Store
from meshforge.store.program import ManualEditLine

_FIX = "whose label was repaired"
Line = TypeVar("Line", StepLine, ManualEditLine, AnswerEvent, LabelFixEvent)


@dataclass(frozen=True, slots=True)
class HullMapping:
    """Which hulls take the place of others. parts: their names, by the name of the hull that is no more; digests: those
    of all hulls before and after, by name."""

    parts: Mapping[str, tuple[str, ...]]
    digests: Mapping[str, str]

    @classmethod
    def between(cls, preparation: Preparation, old: Mapping[str, str], new: Mapping[str, str]) -> Self:
        """Return of the hulls that are no more after a preparation; old, new: digests of the hulls before and after
        it."""
        replaced = {r.what: tuple(r.made) for step in preparation.steps for r in step.replaced if r.kind == "hull"}

        def expand(name: str) -> tuple[str, ...]:
            if name in new or name not in replaced:
                return (name,) if name in new else ()
            return tuple(part for made in replaced[name] for part in expand(made))

        found = {name: expand(name) for name in old if name not in new}
        return cls({name: parts for name, parts in found.items() if parts}, {**new, **old})

    def map_names(self, names: Iterable[str]) -> tuple[str, ...]:
        """Return names with the parts of each hull in its place, sorted."""
        return tuple(sorted(part for name in names for part in self.parts.get(name, (name,))))

    def list_writes(self, store: Store, asset: str) -> list[tuple[Path, bytes]]:
        """Return what to write to the files of which lines name other hulls. Raises ProjectError where one cannot be
        read."""
        layout, events = store.layout, files.load_events(store.layout)
        known = [one for one in store.feedback().answers_and_fixes.values() if one.asset == asset]
        after = tuple(one for event in events for one in (self._map_event(event) if event in known else (event,)))
        return [
            *_map_steps(layout.demonstration(asset), DemonstrationFile, self._map_step),
            *_map_steps(layout.manual_edits(asset), ManualEditsFile, self._map_edit),
            *([(layout.events, files.format_lines(after).encode())] if after != events else []),
        ]

    def _map_step(self, line: StepLine) -> StepLine:
        return self._map_line(line, line.select or (), {"select": line.select and self.map_names(line.select)})

    def _map_edit(self, line: ManualEditLine) -> ManualEditLine:
        meant = [name for name, value in line.hulls.items() if self.digests.get(name) == value]
        pairs = [(name, self.parts.get(name, (name,)) if name in meant else (name,)) for name in line.hulls]
        hulls = {part: line.hulls[name] if part == name else self.digests[part] for name, own in pairs for part in own}
        return self._map_line(line, meant, {"hulls": hulls})

    def _map_event(self, event: Event) -> tuple[Event, ...]:
        match event:
            case AnswerEvent():
                named = {*(event.select or ()), *(name for choice in event.refused for name in choice)}
                select = event.select and self.map_names(event.select)
                update = {"select": select, "refused": tuple(map(self.map_names, event.refused))}
                return (self._map_line(event, named, update),)
            case LabelFixEvent():
                parts = self.parts.get(event.hull, (event.hull,))
                return tuple(self._map_line(event, [event.hull], {"hull": part}) for part in parts)
            case _:
                return (event,)

    def _map_line(self, line: Line, named: Iterable[str], update: Mapping[str, object]) -> Line:
        """A line with other names; hulls of which it names the parts already stay what it named before."""
        gone = {name: self.parts[name] for name in named if name in self.parts}
        if not gone:
            return line
        before = {hull: self.map_names(parts) for hull, parts in line.replaced.items()}
        inner = {part for parts in line.replaced.values() for part in parts}
        replaced = before | {name: parts for name, parts in gone.items() if name not in inner}
        return line.model_copy(update={**update, "replaced": replaced})


def _map_steps(
    path: Path, kind: type[DemonstrationFile | ManualEditsFile], change: Callable[[Any], Any]
) -> Iterator[tuple[Path, bytes]]:
    file = files.read_json(path, kind)
    steps = tuple(map(change, file.steps)) if file else ()
    if file and steps != file.steps:
        yield path, files.json_text(file.model_copy(update={"steps": steps})).encode()


def describe_replaced(store: Store, asset: str) -> Iterator[str]:
    """Yield a sentence for each selection that names parts of a hull in its place and that no person has confirmed.

    Raises ProjectError where a file cannot be read.
    """
    for use, replaced in _list_uses(store, asset):
        for hull, parts in replaced.items():
            yield f"{hull}, {use}, was split into {join_names(parts)}: look whether all parts are meant"


def _list_uses(store: Store, asset: str) -> Iterator[tuple[str, Mapping[str, tuple[str, ...]]]]:
    if steps := files.read_json(store.layout.demonstration(asset), DemonstrationFile):
        yield from ((f"which is demonstrated for rule {line.rule}", line.replaced) for line in steps.steps)
    if edits := files.read_json(store.layout.manual_edits(asset), ManualEditsFile):
        yield from (("which is edited by hand", line.replaced) for line in edits.steps)
    for event in store.feedback().answers_and_fixes.values():
        if event.asset == asset:
            use = f"which an answer for rule {event.rule} is about" if isinstance(event, AnswerEvent) else _FIX
            yield use, event.replaced


def confirm_replaced(store: Store, asset: str) -> None:
    """Note that a person has seen what edits by hand and answers on an asset name in the place of hulls, under the lock
    that the caller holds."""
    path = store.layout.manual_edits(asset)
    edits = files.read_json(path, ManualEditsFile)
    if edits and any(line.replaced for line in edits.steps):
        lines = tuple(line.model_copy(update={"replaced": {}}) for line in edits.steps)
        files.write_json(path, edits.model_copy(update={"steps": lines}))

    def confirm(event: Event) -> Event:
        is_open = isinstance(event, AnswerEvent | LabelFixEvent) and event.asset == asset and event.replaced
        return event.model_copy(update={"replaced": {}}) if is_open else event

    store.change_events(lambda events: map(confirm, events))
