"""Programs from demonstrations: steps, replay, the search for extractors, and what it comes to."""

from __future__ import annotations

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "asset_selection": "choose_first_demonstration",
        "demonstration": "Demonstration Example Step strip_each",
        "learn": "synthesize",
        "options": "LAYERS Layers Options",
        "orientation.suggest": "OrientationSuggestion",
        "outcome": "Ambiguous Found LearningOutcome Nearest NeedsRepair NoProgram Reading TimedOut outcome_to_json",
        "questions": "Answer Hint LabelCorrection OpenRule Repair",
        "readings.rank": "BELIEVABLE",
        "slips": "Slip find_slip",
        "task": "begin_replay memoize",
    },
)
