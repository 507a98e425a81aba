"""VLM Agent: a model writes the program in the language, from the demonstrations that MeshForge learned from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from benchmark.baselines import prompts
from benchmark.baselines.refinement import Trial, find_code
from benchmark.baselines.replay import Replay
from benchmark.tasks import Task
from meshforge import language
from meshforge.common import MeshForgeError, ProgramError
from meshforge.geometry import digest
from meshforge.labels.vlm.question import Message
from meshforge.language import Program, RunResult, from_canonical_frame, show, to_canonical_frame
from meshforge.symbolic import SymbolicMesh

NAME = "VLM Agent"
_ROOT = Path(__file__).resolve().parents[2]
_END = "## From Python"
_TASK = """\
You write programs that edit collision meshes: sets of convex hulls, each with a label. Somebody shows on a few meshes
of a family what is to be done; you write the one program that does this on every mesh of the family, also on those
that you are not shown, which have other numbers of hulls, other shapes, and some parts more or fewer. Names of hulls
mean nothing on other meshes: say by labels, contact and direction which hulls are meant.

Below are the language of programs, as its users read about it, and its grammar. Then come the demonstrations: of each
mesh the hulls with label, box and contacts, pictures, and the steps, in order. Each step is one rule of the program.

Answer with the program in one block of code, and nothing else in that block.

# The language

{language}

# Its grammar

```lark
{grammar}
```"""
_OPENING = """\
# The task

These header lines are settled; boxes, contacts and directions are told in the frame that they make:

{header}

Templates that the rules may use:
{templates}
"""
_CLOSING = "Write the program."
_AGAIN = "Answer with the whole program again."
_LONG = 2000  # characters of a complaint


@dataclass(frozen=True, eq=False)
class Agent:
    """The model's work on one task and some demonstrations."""

    task: Task
    shown: Sequence[Replay]

    @property
    def opening(self) -> tuple[Message, ...]:
        """What the model is told first."""
        frame = self.task.program
        header = str(replace(frame, rules=()))
        begun = _OPENING.format(header=header.strip(), templates=prompts.templates(self.task.templates))
        shown = prompts.describe_demonstrations(self.shown, frame)
        return instructions(), Message("user", (begun, *shown, _CLOSING))

    def try_answer(self, answer: str) -> Trial:
        """An answer on the demonstrations."""
        text = find_code(answer)
        if not text:
            return Trial(None, 0, (f"There is no program in your answer. {_CLOSING}",))
        try:
            program = self.read(text)
        except MeshForgeError as error:
            return Trial(None, 0, (f"The program does not parse:\n{error.message[:_LONG]}\n{_AGAIN}",))
        faults = [fault for one in self.shown for fault in self._faults(program, one)]
        said = "\n".join(("The program does not do what was shown.", *faults, _AGAIN)) if faults else ""
        return Trial(str(program), len(faults), (said,) if faults else ())

    def read(self, text: str) -> Program:
        """The program in a text, with the header that is settled. Raises ProgramError."""
        frame, program = self.task.program, Program.parse(text)
        if not program.rules:
            raise ProgramError("it has no rule", where="program")
        settled = {name: getattr(frame, name) for name in ("labels", "orient", "contact", "extremity")}
        return replace(program, **settled)

    def _faults(self, program: Program, one: Replay) -> list[str]:
        """What a program does otherwise than was shown on a mesh."""
        try:
            result = program.run(one.demo.mesh, self.task.templates)
        except MeshForgeError as error:
            return [f"{one.name}: it fails: {error.sentence}"]
        wanted = [(step.action, step.label) for step in one.demo.steps]
        if [(rule.action, rule.label) for rule in program.rules] == wanted:
            return list(_astray(program, result, one))
        if _hulls(result.mesh) == _hulls(self._expect(one)):
            return []
        told = ", then ".join(f"{step.action}{f' as {step.label}' if step.label else ''}" for step in one.demo.steps)
        return [f"{one.name}: other hulls are left than were shown. The steps were: {told}; each is a rule."]

    def _expect(self, one: Replay) -> SymbolicMesh:
        """What was shown, in the frame that the mesh came in."""
        frame = self.task.program
        return from_canonical_frame(
            one.demo.mesh, one.after, to_canonical_frame(one.demo.mesh, frame.orient, frame.contact)[1]
        )


@cache
def instructions() -> Message:
    """What the task is, with the language as the project itself documents it."""
    about = (_ROOT / "docs" / "language.md").read_text("utf-8").partition(_END)[0]
    grammar = Path(language.__file__).with_name("grammar.lark").read_text("utf-8")
    return Message("system", (_TASK.format(language=about.strip(), grammar=grammar.strip()),))


def _astray(program: Program, result: RunResult, one: Replay) -> list[str]:
    """The first rule that selects other hulls than were shown, since those after it meet another mesh."""
    for step, line, rule in zip(one.demo.steps, result.trace, program.rules, strict=True):
        wanted, done, mesh = step.select or frozenset(), frozenset(line.selected), one.stages[step.rule - 1]
        if wanted == done:
            continue
        wrong = [
            f"{what} {prompts.list_hulls([hull for hull in mesh.hulls if hull.name in names])}"
            for what, names in (("selects, but should not:", done - wanted), ("should select, too:", wanted - done))
            if names
        ]
        return [f"{one.name}, rule {step.rule}, {show(rule.extractor)}: {'; '.join(wrong)}."]
    return []


def _hulls(mesh: SymbolicMesh) -> list[tuple[str, str]]:
    return sorted((hull.label or "", digest(hull.shape)) for hull in mesh.hulls)
