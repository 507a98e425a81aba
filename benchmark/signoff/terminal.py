"""The same person at a terminal: the commands `review --answers`, `demonstrate`, `label` and `review --forget`,
called in this process."""

from __future__ import annotations

import io
import json
import subprocess
import sys
from collections.abc import Iterable, Mapping
from contextlib import redirect_stderr, redirect_stdout
from typing import Any
from unittest.mock import patch

from benchmark.signoff.client import Client, FamilyStatus
from meshforge.cli.demonstrate import demonstrate
from meshforge.cli.label import label
from meshforge.cli.main import load_command
from meshforge.cli.review import review
from meshforge.cli.synthesize import synthesize
from meshforge.common import MeshForgeError
from meshforge.project import Project
from meshforge.signoff import ReviewQuestion, ReviewReply, question_of
from meshforge.synthesis import Answer, Step

_REFUSED = 2
"""The exit code of a command that did nothing."""
_PICTURES = "meshforge.cli.review.draw_question"  # nobody looks at them here, and they take half of the time
_PROCESSORS = "meshforge.batch.workers.count_processors"  # sessions run side by side; results are the same
_COMMANDS = {one.__name__: load_command(one.__name__) for one in (demonstrate, label, review, synthesize)}


class TerminalClient(Client):
    """By commands alone; what their outputs do not tell is not known."""

    name = "terminal"

    def __init__(self, project: Project) -> None:
        super().__init__(project)
        self._told: str | None = None
        self._refused = set[tuple[int, str]]()

    def review(self) -> FamilyStatus:
        try:
            told = self._told or self._call("review", "--json")
        finally:
            self._told, self.program = None, self.project.program()
        return _read_status(json.loads(told), self.project.assets())

    def reply(self, question: ReviewQuestion, reply: ReviewReply) -> None:
        if (question.rule, question.asset) in self._refused:
            reply = ReviewReply(question.id)
        file = self.project.folder.parent / "answers.json"
        file.write_text(json.dumps([{"id": reply.question, **reply.to_json()}]), encoding="utf-8")
        self._told = self._call("review", "--answers", str(file), "--json")

    def demonstrate(self, asset: str, steps: Iterable[Step]) -> None:
        self._call("demonstrate", asset, *map(_format_step, steps))

    def take_demonstration_back(self, asset: str) -> None:
        self._call("demonstrate", asset, "--clear")
        for answer in self.answers:
            if answer.asset == asset:
                self._call("review", "--forget", f"{answer.rule}:{asset}")

    def refuse_choices(self, answer: Answer) -> None:
        """Take the answer back; when the question is asked again, none of the choices is meant."""
        self._call("review", "--forget", f"{answer.rule}:{answer.asset}")
        self._refused.add((answer.rule, answer.asset))

    def set_labels(self, asset: str, labels: Mapping[str, str]) -> None:
        self._call("label", asset, *(f"{hull}={label}" for hull, label in labels.items()))
        self.take_labels()

    def take_labels(self) -> None:
        if any(mesh.labels for mesh in self.read_meshes().values()):
            self._call("label", "--with", "propagate")

    def _call(self, command: str, *words: str) -> str:
        """What a command prints. Raises MeshForgeError as the command does."""
        self._told, out = None, io.StringIO()
        alone = patch(_PROCESSORS, return_value=0)
        with redirect_stdout(out), redirect_stderr(io.StringIO()), patch(_PICTURES, return_value=[]), alone:
            _COMMANDS[command].main([str(self.project.folder), *words], command, standalone_mode=False)
        return out.getvalue()


class AnswersClient(TerminalClient):
    """By files of answers alone, once the edit was shown where the product asks for that."""

    name = "answers alone"
    shows_corrections = False


class WrongClient(AnswersClient):
    """The same, and of a wrong result no more is said than that it is wrong."""

    name = 'answers alone, "wrong" and no more'
    says_what_is_right = False


class ProcessClient(AnswersClient):
    """By files of answers alone, each command in a process of its own."""

    name = "answers alone, by processes"

    def _call(self, command: str, *words: str) -> str:
        self._told = None
        line = [sys.executable, "-m", "meshforge", command, str(self.project.folder), *words]
        done = subprocess.run(line, capture_output=True, text=True)
        if done.returncode == _REFUSED:
            said = done.stderr.strip().removeprefix("error: ")
            where, told, problem = said.partition(": ")
            raise MeshForgeError(problem or said, where=where if told else None)
        return done.stdout


def _format_step(step: Step) -> str:
    """One step as it is typed."""
    hulls = "open" if step.select is None else ",".join(sorted(step.select)) or "nothing"
    return f"{hulls} => {step.action}{f' as {step.label}' if step.label else ''}"


def _read_status(told: Mapping[str, Any], assets: Iterable[str]) -> FamilyStatus:
    """How the family stands by what the command printed."""
    held = {one["asset"]: float(one["probability"]) for one in told["needs_review"]}
    excluded = frozenset(told["excluded"])
    signed = [name for name in assets if name not in held and name not in excluded]
    assert len(signed) == told["signed_off"]
    question = question_of(told["question"]) if told["question"] else None
    return FamilyStatus(question, bool(signed) or any(held.values()), signed, list(held), excluded, held)
