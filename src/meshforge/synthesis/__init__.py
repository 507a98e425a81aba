"""Programs from demonstrations: steps, replay, the search for extractors, and what it comes to."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(
    __name__,
    {
        "asset_selection": "choose_first_demonstration",
        "demonstration": "Answer Demonstration Example LabelFix OpenRule Repair Step strip_each",
        "learn": "synthesize",
        "options": "LAYERS Layers Options",
        "orientation.suggest": "OrientationSuggestion",
        "outcome": (
            "Ambiguous CandidateProgram Found LearningOutcome Nearest NeedsRepair NoProgram TimedOut outcome_to_json"
        ),
        "diagnosis": "LikelyMistake find_mistake",
        "task": "begin_replay memoize",
    },
)
