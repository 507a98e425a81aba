"""What an asset was held against where an engine was named: our table of its limits alone, or the engine itself."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Any, Literal

from meshforge.checks.base import Measure
from meshforge.common import join_names, pluralize
from meshforge.engines import Finding, find_engine

Given = Literal["file", "conversion"]
"""The file itself, or what `meshforge convert` makes of it for the engine."""


@dataclass(frozen=True, slots=True)
class EngineLoad(Measure):
    """What an engine says of an asset, besides our table of its limits.

    engine, file: names; asked: the program and version that was run, None where none was; given: what it was given;
    refusal, warnings: in its own words; joined: each collision mesh of which it makes one hull, with the hulls that are
    read of it; untried: why an engine that can be asked was not, empty for one that cannot;
    remedy: for a refusal, or for one that was not tried.
    """

    engine: str
    file: str = ""
    asked: str | None = None
    given: Given | None = None
    refusal: str | None = None
    warnings: tuple[str, ...] = ()
    joined: tuple[tuple[str, tuple[str, ...]], ...] = ()
    untried: str = ""
    remedy: str = ""

    @property
    def description(self) -> str:
        """What was asked, in a sentence; empty where findings say all."""
        title = find_engine(self.engine).title
        if self.refusal or self.untried:
            return ""
        return (
            f"{self.asked} takes {self._subject}"
            if self.asked
            else f"by the limits of {title}, which was not asked itself"
        )

    @property
    def findings(self) -> Iterator[Finding]:
        """What the engine said against the asset, or that it was not asked though it can be."""
        if self.untried:
            message = f"not tried in {find_engine(self.engine).title}: {self.untried}"
            yield Finding(f"{self.engine}-untried", "warning", (), message, self.remedy)
        if self.refusal:
            message = f"{self.asked} refuses {self._subject}: {self.refusal}"
            yield Finding(f"{self.engine}-refused", "error", (), message, self.remedy or "Fix what the message names.")
        if self.joined:
            names = join_names([f"{element} ({pluralize(len(of), 'hull')} here)" for element, of in self.joined])
            message = f"{self.asked} makes one hull of all of a collision mesh, which closes what is between: {names}"
            remedy = "meshforge convert to an MJCF writes a geom for each hull."
            yield Finding(f"{self.engine}-joins", "warning", tuple(chain(*dict(self.joined).values())), message, remedy)
        for warning in self.warnings:
            yield Finding(f"{self.engine}-warned", "warning", (), f"{self.asked} warns: {warning}", "")

    def to_json(self) -> dict[str, Any]:
        """Return the trial as JSON-able data; `against` is `engine` where the engine itself was asked, else
        `limits`."""
        return {
            "name": self.engine,
            "against": "engine" if self.asked else "limits",
            "asked": self.asked,
            "given": self.given,
            "refused": self.refusal,
            "warnings": list(self.warnings),
            "untried": self.untried or None,
        }

    @property
    def _subject(self) -> str:
        return self.file if self.given == "file" else f"what `meshforge convert` makes of {self.file}"
