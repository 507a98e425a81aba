"""Learning with a person at the terminal: one card after the other, learning again after each answer."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from meshforge.cli.console import show_status
from meshforge.cli.synthesize_session import LearningSession, QuestionPictures
from meshforge.cli.synthesize_text import describe_change, format_question, format_repair
from meshforge.common import UsageError, suggest_aside
from meshforge.language import explain
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Ambiguous, LearningOutcome, NeedsRepair, NoProgram, Question

AskPerson = Callable[[str], str]
"""Shows a prompt and gives the line that is typed; raises EOFError or KeyboardInterrupt when a person has enough."""

_MAX_LISTED = 20  # hulls that are listed


class Conversation:
    """Asks until the program is found, or the person stops; whatever is said is kept at once."""

    def __init__(self, session: LearningSession, ask: AskPerson, say: Callable[[str], None]) -> None:
        self._session, self._ask, self._say = session, ask, say
        self._pictures = QuestionPictures(session)
        self._last_question: Question | None = None

    def run(self) -> LearningOutcome:
        """Ask and learn; the outcome of the last time."""
        try:
            return self._run()
        finally:
            self._pictures.clear()

    def _run(self) -> LearningOutcome:
        outcome = self._learn()
        if outcome.program and outcome.question:
            self._say(str(outcome.program))
        while self._respond(outcome):
            before, outcome = outcome, self._learn()
            self._report_changes(before, outcome)
        return outcome

    def _learn(self) -> LearningOutcome:
        with show_status("learning; Ctrl-C stops"):
            return self._session.learn()

    def _respond(self, outcome: LearningOutcome) -> bool:
        """Ask what there is to ask; whether something was said, so that it is worth learning again."""
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
        question = outcome.question
        with show_status("drawing"):
            pictures = self._pictures.of_question(question, outcome.program)
        self._say(format_question(question, outcome.program, pictures))
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
        self._say(f"Then a label may be wrong. The choices differ on:\n{format_labels(hulls, mesh)}")
        labels = self._ask_labels("HULL=LABEL to correct one (more with commas), Enter to leave them: ", mesh)
        if labels:
            self._session.project.set_labels(question.asset, labels)
            self._session.project.take_back(question.id)  # with other labels there are other choices

    def _ask_labels(self, prompt: str, mesh: SymbolicMesh) -> dict[str, str]:
        while True:
            try:
                return parse_labels(self._ask(prompt), mesh, self._session.project.vocabulary)
            except UsageError as error:
                self._say(error.message)

    def _ask_repair(self, outcome: NeedsRepair) -> bool:
        repair, project = outcome.repairs[0], self._session.project
        self._say(format_repair(repair, self._pictures.of_repair(repair)))
        word = self._ask_one_of(("y", "n", "s"), "Repair it? y, n, s to stop asking: ")
        if word == "y":
            project.confirm(repair.correction)
            self._say(f"repaired: {describe_change(repair)}")
        elif word == "n":
            project.reject(repair.correction)
        self._last_question = None
        return word != "s"

    def _offer_undo(self, outcome: NoProgram) -> bool:
        """An answer after which no program is left can be taken back at once."""
        if not self._last_question or self._last_question.id not in self._session.project.feedback().said:
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

    def _report_changes(self, before: LearningOutcome, after: LearningOutcome) -> None:
        """What the last answer did to the program."""
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


def doubtful_hulls(question: Question) -> tuple[str, ...]:
    """The hulls that some choices select and others do not, in order of name."""
    sets = [frozenset(choice.select) for choice in question.choices]
    return tuple(sorted(frozenset.union(*sets) - frozenset.intersection(*sets)))


def format_labels(hulls: Sequence[str], mesh: SymbolicMesh) -> str:
    """The labels that some hulls have; of many the first ones."""
    rows = [f"  {name}  {mesh.hull_of(name).label or 'no label'}" for name in hulls if name in mesh.index]
    more = len(rows) - _MAX_LISTED
    return "\n".join([*rows[:_MAX_LISTED], f"  and {more} more"] if more > 1 else rows)


def parse_labels(text: str, mesh: SymbolicMesh, vocabulary: Sequence[str]) -> dict[str, str]:
    """The labels that a line of HULL=LABEL, with commas between, gives. Raises UsageError for what cannot be."""
    given: dict[str, str] = {}
    for part in (part.strip() for part in text.split(",") if part.strip()):
        hull, equals, label = (word.strip() for word in part.rpartition("="))
        if not equals:
            raise UsageError(f"{part!r} is not of the form HULL=LABEL")
        for name, known, what in ((hull, mesh.index, "hull"), (label, vocabulary, "label")):
            if name not in known:
                raise UsageError(f"there is no {what} {name!r}{suggest_aside(name, known)}")
        given[hull] = label
    return given
