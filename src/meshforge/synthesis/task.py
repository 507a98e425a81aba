"""All that a program is to be learned from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from meshforge.language import EXTREMITY, Program, Template
from meshforge.synthesis.agreement import Agreed
from meshforge.synthesis.asking import Answer
from meshforge.synthesis.batch import Batch
from meshforge.synthesis.correction import Correction
from meshforge.synthesis.demonstration import Demonstration
from meshforge.synthesis.options import Options


@dataclass(frozen=True, slots=True)
class Task:
    """Demonstrations, the batch they stand for, and what a person said since.

    frame: the program without its rules; rejected: corrections of labels that a person refused;
    confirmed: those that were made, as a person said that they are right;
    follow: a program of which is to be told why it is not what was learned.
    """

    rules: tuple[Agreed, ...]
    demos: tuple[Demonstration, ...]
    batch: Batch
    frame: Program
    templates: Mapping[str, Template]
    answers: tuple[Answer, ...]
    rejected: frozenset[Correction]
    options: Options
    follow: Program | None = None
    confirmed: tuple[Correction, ...] = ()

    @property
    def extremity(self) -> float:
        """The threshold of `Geo`."""
        return EXTREMITY if self.frame.extremity is None else self.frame.extremity
