"""Programs from demonstrations: steps, replay, the search for extractors, and what it comes to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.common.exports import export_lazily

if TYPE_CHECKING:
    from meshforge.synthesis.asset_selection import choose_first_demonstration
    from meshforge.synthesis.demonstration import Demonstration, Example, Step, strip_each
    from meshforge.synthesis.learn import synthesize
    from meshforge.synthesis.options import LAYERS, Layers, Options
    from meshforge.synthesis.orientation.suggest import OrientationSuggestion
    from meshforge.synthesis.outcome import (
        Ambiguous,
        Found,
        LearningOutcome,
        Nearest,
        NeedsRepair,
        NoProgram,
        Reading,
        TimedOut,
        outcome_to_json,
    )
    from meshforge.synthesis.questions import Answer, Choice, Hint, LabelCorrection, Question, Repair
    from meshforge.synthesis.readings.rank import BELIEVABLE
    from meshforge.synthesis.slips import Slip, find_slip
    from meshforge.synthesis.task import advance, begin_replay, memoize
else:
    __getattr__ = export_lazily(__name__)

__all__ = [
    "BELIEVABLE",
    "LAYERS",
    "Ambiguous",
    "Answer",
    "Choice",
    "Demonstration",
    "Example",
    "Found",
    "Hint",
    "LabelCorrection",
    "Layers",
    "LearningOutcome",
    "Nearest",
    "NeedsRepair",
    "NoProgram",
    "Options",
    "OrientationSuggestion",
    "Question",
    "Reading",
    "Repair",
    "Slip",
    "Step",
    "TimedOut",
    "advance",
    "begin_replay",
    "choose_first_demonstration",
    "find_slip",
    "memoize",
    "outcome_to_json",
    "strip_each",
    "synthesize",
]
