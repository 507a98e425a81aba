"""Steps shown on hulls that a preparation replaces: they name the new hulls, each with what it named before until the
asset is demonstrated again."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from meshforge.batch import Preparation
from meshforge.common import join_names
from meshforge.store import DemonstrationFile, StepLine, Store, json_text, read_json


@dataclass(frozen=True, slots=True)
class HullMapping:
    """Which hulls take the place of others. parts: their names, by the name of the hull that is no more."""

    parts: Mapping[str, tuple[str, ...]]

    @classmethod
    def between(cls, preparation: Preparation, old: Iterable[str], new: Iterable[str]) -> Self:
        """Return those of the hulls that are no more after a preparation. old, new: names of hulls before and after."""
        replaced = {r.what: tuple(r.made) for step in preparation.steps for r in step.replaced if r.kind == "hull"}
        there = set(new)

        def expand(name: str) -> tuple[str, ...]:
            if name in there or name not in replaced:
                return (name,) if name in there else ()
            return tuple(part for made in replaced[name] for part in expand(made))

        found = {name: expand(name) for name in old if name not in there}
        return cls({name: parts for name, parts in found.items() if parts})

    def map_names(self, names: Iterable[str]) -> tuple[str, ...]:
        """Return names with the parts of each hull in its place, sorted."""
        return tuple(sorted(part for name in names for part in self.parts.get(name, (name,))))

    def list_writes(self, store: Store, asset: str) -> list[tuple[Path, bytes]]:
        """Return what to write where steps name other hulls. Raises ProjectError where they cannot be read."""
        path = store.layout.demonstration(asset)
        file = read_json(path, DemonstrationFile)
        if file is None:
            return []
        steps = tuple(map(self._map_step, file.steps))
        content = json_text(file.model_copy(update={"steps": steps})).encode()
        return [(path, content)] if steps != file.steps else []

    def _map_step(self, line: StepLine) -> StepLine:
        """A step with other names; hulls of which it names the parts already stay what it named before."""
        gone = {name: self.parts[name] for name in line.select or () if name in self.parts}
        if not gone:
            return line
        before = {hull: self.map_names(parts) for hull, parts in line.replaced.items()}
        inner = {part for parts in line.replaced.values() for part in parts}
        replaced = before | {name: parts for name, parts in gone.items() if name not in inner}
        return line.model_copy(update={"select": self.map_names(line.select or ()), "replaced": replaced})


def describe_replaced(store: Store, asset: str) -> Iterator[str]:
    """Yield a sentence for each step that names parts of a hull in its place, as no person has shown it since.

    Raises ProjectError where the steps cannot be read.
    """
    file = read_json(store.layout.demonstration(asset), DemonstrationFile)
    for line in file.steps if file else ():
        for hull, parts in line.replaced.items():
            split = f"was split into {join_names(parts)}: look whether all parts are meant"
            yield f"{hull}, which is demonstrated for rule {line.rule}, {split}"
