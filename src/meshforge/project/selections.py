"""What a person selected on hulls that a preparation splits: carried to their parts, and brought back by undoing it."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from meshforge import store as files
from meshforge.batch import Preparation
from meshforge.common import join_names, write_atomically
from meshforge.store import Store

Line = dict[str, Any]
"""One step, edit by hand, answer or repair, as its file has it."""

SelectionKind = Literal["demonstration", "corrections", "answers"]
_BOM = "\ufeff"
_KINDS: dict[SelectionKind, tuple[str, ...]] = {
    "demonstration": ("steps",),
    "corrections": ("steps",),
    "answers": ("events",),
}


@dataclass(frozen=True, slots=True)
class Successors:
    """The names of the parts of each hull that is split; digests: those of the parts and of the hulls, by name."""

    parts: Mapping[str, tuple[str, ...]]
    digests: Mapping[str, str]

    @staticmethod
    def between(after: Preparation, old: Mapping[str, str], new: Mapping[str, str]) -> Successors:
        """Of the hulls that are no more after a preparation; old, new: digests of the hulls before and after it."""
        replaced = {r.what: tuple(r.made) for step in after.steps for r in step.replaced if r.kind == "hull"}

        def expand(name: str) -> tuple[str, ...]:
            if name in new or name not in replaced:
                return (name,) if name in new else ()
            return tuple(part for made in replaced[name] for part in expand(made))

        found = {name: expand(name) for name in old if name not in new}
        return Successors({name: parts for name, parts in found.items() if parts}, {**new, **old})

    def carry(self, names: Iterable[str]) -> list[str]:
        """Names with the parts of each split hull in its place."""
        return [part for name in names for part in self.parts.get(name, (name,))]

    def carry_back(self, names: Iterable[str]) -> list[str]:
        """Names with a hull in the place of its parts, where all of these are there."""
        left = list(names)
        for hull, parts in self.parts.items():
            if set(parts) <= set(left):
                left[left.index(parts[0])] = hull
                left = [name for name in left if name not in parts]
        return left


class SelectionChange(files.JsonFile):
    """One file before and after a step. lines: of each line that changed what it was, and what it became; looked:
    whether a person has looked at it since."""

    kind: SelectionKind
    before: str
    after: str
    lines: tuple[tuple[Line, tuple[Line, ...]], ...]
    looked: bool = False


def check_selections(store: Store, asset: str) -> None:
    """Raises ProjectError, naming the file, where a demonstration, edits by hand or the answers cannot be read."""
    store.steps(asset)
    store.corrections(asset)
    store.feedback()


def carry_selections(store: Store, asset: str, successors: Successors) -> tuple[SelectionChange, ...]:
    """What selections become where hulls are split: those that name one name its parts. None of these is written yet.

    Raises ProjectError where a file cannot be read.
    """
    check_selections(store, asset)
    store.migrate()
    found = []
    for kind in _KINDS:
        text = _read_text(_path(store, asset, kind)) or ""
        data, lines = _load(text, kind), list[tuple[Line, tuple[Line, ...]]]()
        for key in _KINDS[kind]:
            after = [(line, _carry_line(kind, asset, line, successors)) for line in data.get(key, ())]
            lines += [(line, now) for line, now in after if now != (line,)]
            data |= {key: [one for _, now in after for one in now]} if key in data else {}
        if lines:
            found.append(SelectionChange(kind=kind, before=text, after=_format(data, kind), lines=tuple(lines)))
    return tuple(found)


def apply_changes(store: Store, asset: str, changes: Iterable[SelectionChange]) -> None:
    """Write what selections become."""
    for change in changes:
        write_atomically(_path(store, asset, change.kind), change.after)


def restore_selections(store: Store, asset: str, changes: Sequence[SelectionChange], successors: Successors) -> None:
    """Bring back what selections were before hulls were split. What a person changed since stays; where it names all
    parts of a hull, it names the hull again. What is brought back already stays as it is."""
    for kind in _KINDS:
        path = _path(store, asset, kind)
        text = _read_text(path)
        if text is None:
            continue
        change = next((one for one in changes if one.kind == kind), None)
        if change and text in (change.after, change.before):
            now = change.before
        else:
            now = _restore_lines(asset, kind, text, change.lines if change else (), successors)
        if now != text:
            write_atomically(path, now)


def describe_change(
    store: Store, asset: str, change: SelectionChange, parts: Mapping[str, tuple[str, ...]]
) -> Iterator[str]:
    """A sentence for each line that is as it was carried. parts: of each hull that was split, by name.

    Raises ProjectError where a file cannot be read.
    """
    check_selections(store, asset)
    data = _load(_read_text(_path(store, asset, change.kind)) or "", change.kind)
    there = [line for key in _KINDS[change.kind] for line in data.get(key, ())]
    for line, now in change.lines:
        if all(one in there for one in now):
            for hull in (name for name in parts if name in _names_in(line)):
                fate = f"was split into {join_names(parts[hull])}"
                yield f"{hull}, {_describe_use(change.kind, line)}, {fate}: look whether all parts are meant"


def _describe_use(kind: SelectionKind, line: Line) -> str:
    if kind == "corrections":
        return "which is edited by hand"
    if kind == "demonstration":
        return f"which is demonstrated for rule {line['rule']}"
    return f"which an answer for rule {line['rule']} is about" if "rule" in line else "whose label was repaired"


def _read_text(path: Path) -> str | None:
    """A file's text, line ends as they are; None where there is no such file."""
    return path.read_bytes().decode("utf-8") if path.exists() else None


def _load(text: str, kind: SelectionKind) -> Line:
    text = text.removeprefix(_BOM)
    if kind == "answers":
        return {"events": [json.loads(line) for line in text.split("\n") if line.strip()]}
    found: Line = json.loads(text or "{}")
    return found


def _path(store: Store, asset: str, kind: SelectionKind) -> Path:
    layout = store.layout
    one_asset = {"demonstration": layout.demonstration, "corrections": layout.corrections}
    return one_asset[kind](asset) if kind in one_asset else layout.events


def _format(data: Line, kind: SelectionKind) -> str:
    if kind == "answers":
        return "".join(f"{json.dumps(line, ensure_ascii=False, separators=(',', ':'))}\n" for line in data["events"])
    return json.dumps(data, ensure_ascii=False, indent=2) + "\n"


def _names_in(line: Line) -> set[str]:
    refused = [name for choice in line.get("refused", ()) for name in choice]
    own = [line["hull"]] if "hull" in line else []
    return {*(line.get("select") or ()), *refused, *line.get("hulls", ()), *own}


def _carry_line(kind: SelectionKind, asset: str, line: Line, successors: Successors) -> tuple[Line, ...]:
    """A line with parts in the place of their hull; a repair is one of each part then."""
    if not _names_in(line) & successors.parts.keys() or (kind == "answers" and line.get("asset") != asset):
        return (line,)
    if "hull" in line:
        names = successors.parts[line["hull"]]
        return tuple({**line, "hull": name} for name in names)
    if "hulls" in line:
        known = successors.digests
        meant = {name: value for name, value in line["hulls"].items() if known.get(name) == value}
        pairs = [(name, successors.parts.get(name, (name,)) if name in meant else (name,)) for name in line["hulls"]]
        hulls = {part: line["hulls"][name] if part == name else known[part] for name, parts in pairs for part in parts}
        return ({**line, "hulls": hulls},)
    return (_with_names(line, lambda names: sorted(successors.carry(names))),)


def _with_names(line: Line, change: Any) -> Line:
    now = {**line}
    if line.get("select") is not None:
        now["select"] = change(line["select"])
    if line.get("refused"):
        now["refused"] = [change(choice) for choice in line["refused"]]
    return now


def _restore_lines(
    asset: str, kind: SelectionKind, text: str, changed: Iterable[tuple[Line, tuple[Line, ...]]], successors: Successors
) -> str:
    data = _load(text, kind)
    for key in _KINDS[kind]:
        lines = list(data.get(key, ()))
        for before, after in changed:
            if all(one in lines for one in after):
                lines[lines.index(after[0])] = before
                lines = [one for one in lines if one not in after]
        lines = [_carry_line_back(kind, asset, line, successors) for line in lines]
        data |= {key: lines} if key in data else {}
    return text if data == _load(text, kind) else _format(data, kind)


def _carry_line_back(kind: SelectionKind, asset: str, line: Line, successors: Successors) -> Line:
    if kind == "answers" and line.get("asset") != asset:
        return line
    if "hulls" in line:
        names = successors.carry_back(line["hulls"])
        return {**line, "hulls": {name: line["hulls"].get(name) or successors.digests[name] for name in names}}
    return _with_names(line, lambda names: sorted(successors.carry_back(names)))
