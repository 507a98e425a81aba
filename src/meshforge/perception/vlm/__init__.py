"""Asking a vision-language model behind any OpenAI-compatible address: a client for any question, and a labeller."""

from meshforge.perception.vlm.client import Client
from meshforge.perception.vlm.endpoint import OPENAI, Endpoint
from meshforge.perception.vlm.faults import AskingError, EndError, RefusedError
from meshforge.perception.vlm.features import Features
from meshforge.perception.vlm.labeller import Labeller, Pending, Said
from meshforge.perception.vlm.looks import Look, looks
from meshforge.perception.vlm.manner import Manner
from meshforge.perception.vlm.modes import MODES, Mode, ModeName
from meshforge.perception.vlm.page import write_page
from meshforge.perception.vlm.purse import Bill, estimate
from meshforge.perception.vlm.question import Message, Question
from meshforge.perception.vlm.reply import Reply, Usage

__all__ = [
    "MODES",
    "OPENAI",
    "AskingError",
    "Bill",
    "Client",
    "EndError",
    "Endpoint",
    "Features",
    "Labeller",
    "Look",
    "Manner",
    "Message",
    "Mode",
    "ModeName",
    "Pending",
    "Question",
    "RefusedError",
    "Reply",
    "Said",
    "Usage",
    "estimate",
    "looks",
    "write_page",
]
