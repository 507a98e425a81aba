"""Programs from demonstrations: steps, replay, the search for extractors, and what it comes to."""

from meshforge.synthesis.asking import Answer, Choice, Hint, Question, Repair
from meshforge.synthesis.correction import Correction
from meshforge.synthesis.demonstration import Demonstration, Step
from meshforge.synthesis.gather import consolidated
from meshforge.synthesis.learn import synthesize
from meshforge.synthesis.options import LAYERS, Layers, Options, Shortcuts
from meshforge.synthesis.outcome import Ambiguous, Found, Nearest, NeedsRepair, NoProgram, Outcome, Reading, TimedOut
from meshforge.synthesis.search import Tried
from meshforge.synthesis.telling import most_telling
from meshforge.synthesis.wire import outcome_json

__all__ = [
    "LAYERS",
    "Ambiguous",
    "Answer",
    "Choice",
    "Correction",
    "Demonstration",
    "Found",
    "Hint",
    "Layers",
    "Nearest",
    "NeedsRepair",
    "NoProgram",
    "Options",
    "Outcome",
    "Question",
    "Reading",
    "Repair",
    "Shortcuts",
    "Step",
    "TimedOut",
    "Tried",
    "consolidated",
    "most_telling",
    "outcome_json",
    "synthesize",
]
