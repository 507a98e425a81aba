"""Learning with a person at the terminal: one card after the other, learning again after each answer."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from meshforge.cli.cards import change, question_card, repair_card
from meshforge.cli.lessons import Lessons
from meshforge.cli.mending import doubtful_hulls, labels_card, mended
from meshforge.cli.question_pictures import QuestionPictures

if TYPE_CHECKING:
    from meshforge.symbolic import SymbolicMesh
    from meshforge.synthesis import Ambiguous, NeedsRepair, NoProgram, Outcome, Question

Ask = Callable[[str], str]
"""Shows a prompt and gives the line that is typed; raises EOFError or KeyboardInterrupt when a person has enough."""


class Conversation:
    """Asks until the program is found, or the person stops; whatever is said is kept at once."""

    def __init__(self, lessons: Lessons, ask: Ask, say: Callable[[str], None]) -> None:
        self._session, self._ask, self._say = lessons, ask, say
        self._pictures = QuestionPictures(lessons)
        self._last_question: Question | None = None

    def run(self) -> Outcome:
        """The outcome of the last lesson."""
        try:
            return self._run()
        finally:
            self._pictures.clear()

    def _run(self) -> Outcome:
        outcome = self._learn()
        if outcome.program and outcome.question:
            self._say(str(outcome.program))
        while self._respond(outcome):
            before, outcome = outcome, self._learn()
            self._report_changes(before, outcome)
        return outcome

    def _learn(self) -> Outcome:
        from meshforge.cli.output import working

        with working("learning; Ctrl-C stops"):
            return self._session.learn()

    def _respond(self, outcome: Outcome) -> bool:
        """Ask what there is to ask; whether something was said, so that it is worth learning again."""
        from meshforge.synthesis import Ambiguous, NeedsRepair, NoProgram

        try:
            match outcome:
                case Ambiguous() if outcome.question == self._last_question:
                    self._say("The question stays the same after your answer, so it is left open.")
                    return False
                case Ambiguous():
                    return self._ask_question(outcome)
                case NeedsRepair():
                    return self._ask_repair(outcome)
                case NoProgram():
                    return self._offer_undo(outcome)
                case _:
                    return False
        except (EOFError, KeyboardInterrupt):
            self._say("\nstopped; what you said so far is kept")
            return False

    def _ask_question(self, outcome: Ambiguous) -> bool:
        from meshforge.cli.output import working

        question = outcome.question
        with working("drawing"):
            pictures = self._pictures.of_question(question, outcome.program)
        self._say(question_card(question, outcome.program, pictures))
        numbers = [str(number) for number in range(1, len(question.choices) + 1)]
        word = self._ask_one_of((*numbers, "n", "s"), f"{', '.join(numbers)}, n for neither, s to stop asking: ")
        if word == "s":
            return False
        self._last_question = question
        self._session.answer(question.answer_with(None if word == "n" else int(word) - 1))
        if word == "n":
            self._fix_labels(question)
        return True

    def _fix_labels(self, question: Question) -> None:
        """Neither choice is right: perhaps since a label is wrong, which the person may set right."""
        mesh = self._session.meshes()[question.asset]
        hulls = [name for name in doubtful_hulls(question) if name in mesh.index]
        if not hulls:
            return
        self._say(f"Then a label may be wrong. The choices differ on:\n{labels_card(hulls, mesh)}")
        labels = self._ask_labels("HULL=LABEL to mend one (more with commas), Enter to leave them: ", mesh)
        if labels:
            self._session.project.set_labels(question.asset, labels)
            self._session.project.take_back(question.id)  # with other labels there are other choices

    def _ask_labels(self, prompt: str, mesh: SymbolicMesh) -> dict[str, str]:
        from meshforge.errors import UsageError

        while True:
            try:
                return mended(self._ask(prompt), mesh, self._session.project.vocabulary)
            except UsageError as error:
                self._say(error.message)

    def _ask_repair(self, outcome: NeedsRepair) -> bool:
        repair, project = outcome.repairs[0], self._session.project
        self._say(repair_card(repair, self._pictures.of_repair(repair)))
        word = self._ask_one_of(("y", "n", "s"), "Mend it? y, n, s to stop asking: ")
        if word == "y":
            project.confirm(repair.correction)
            self._say(f"mended: {change(repair)}")
        elif word == "n":
            project.reject(repair.correction)
        self._last_question = None
        return word != "s"

    def _offer_undo(self, outcome: NoProgram) -> bool:
        """An answer after which no program is left can be taken back at once."""
        if not self._last_question or self._last_question.id not in self._session.project.answers().ids:
            return False
        self._say(f"With your answer about {self._last_question.asset} there is no program: {outcome.why}")
        if self._ask_one_of(("y", "n"), "Take it back? y, n: ") == "n":
            return False
        self._session.project.take_back(self._last_question.id)
        self._last_question = None
        return True

    def _ask_one_of(self, words: tuple[str, ...], prompt: str) -> str:
        """One of some words, asked for until it is typed."""
        while (word := self._ask(prompt).strip().lower()) not in words:
            self._say(f"Type one of: {', '.join(words)}.")
        return word

    def _report_changes(self, before: Outcome, after: Outcome) -> None:
        """What the last answer did to the program."""
        from meshforge.language import explain

        self._say("")
        if not before.program or not after.program:
            if after.question:
                self._say(str(after.program))
            return
        old = [str(rule) for rule in before.rules]
        fresh = [(k, rule) for k, rule in enumerate(after.rules, 1) if str(rule) not in old[k - 1 : k]]
        for number, rule in fresh:
            self._say(f"Rule {number} is now: {rule}\n  {explain(rule)}\n")
        if not fresh:
            self._say("The program stays as it is.\n")
