"""What is known of a family: meshes, demonstrations, answers, and what people said of results."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from meshforge.language import Program, Template
from meshforge.signoff.question import ExclusionReason, Selections
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Answer, Demonstration


@dataclass(frozen=True, slots=True)
class ReviewState:
    """All that is known of a family.

    meshes: of the family, by name, with the labels that they have; frame: the program without its rules; templates: by
    the paths that actions name; demos: of some of the meshes, by name; by_hand: whether a person wrote the program;
    answers: to questions of learning; meant: what each rule is to select by what a person said of results, by asset;
    failed: what it did select on results that they called wrong; accepted, corrected: assets whose result they accepted
    as it is now, or said what it is to be; wrong: those of which they only said that it is wrong; edited: those with
    edits by hand after the program; excluded: those that are given up; snoozed: ids of questions that are not asked
    again.
    """

    meshes: Mapping[str, SymbolicMesh]
    frame: Program
    templates: Mapping[str, Template] = field(default_factory=dict)
    demos: Mapping[str, Demonstration] = field(default_factory=dict)
    by_hand: bool = False
    answers: tuple[Answer, ...] = ()
    meant: Mapping[str, Selections] = field(default_factory=dict)
    accepted: frozenset[str] = frozenset()
    corrected: frozenset[str] = frozenset()
    failed: Mapping[str, Selections] = field(default_factory=dict)
    wrong: frozenset[str] = frozenset()
    edited: frozenset[str] = frozenset()
    excluded: Mapping[str, ExclusionReason] = field(default_factory=dict)
    snoozed: frozenset[str] = frozenset()

    @property
    def reviewed_assets(self) -> frozenset[str]:
        """The assets of which a person saw what the edit makes of them, or said what it is to make."""
        return frozenset((*self.demos, *self.accepted, *self.corrected))
