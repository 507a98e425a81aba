"""The server's side of the process that learns."""

from __future__ import annotations

from concurrent.futures import Future
from pathlib import Path

from meshforge.studio.learner import work
from meshforge.studio.learner.bell import Bell
from meshforge.studio.learner.line import Line
from meshforge.studio.wire.lesson import Generalised, LessonView, Reach
from meshforge.studio.workers import Workers


class Learner:
    """Learns a project's program in a process of its own, which starts with the first call.

    One thing is done at a time, lessons first. What is asked for ends what was asked for before of its kind, a lesson
    the reach of the one before, too; of what has not begun then, and of a reach that is ended, the result is
    Superseded. Where the process dies, the result is a MeshForgeError, and the next call has a new one.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._workers = Workers(1)
        self._line = Line(self._workers)
        self._bell = Bell()

    def learn(self, number: int, take: bool) -> Future[LessonView]:
        """Learn now. take: what is found becomes the project's program even if a person wrote the present one.

        A lesson that is interrupted has the status `timeout`; what goes wrong is told in its error.
        """
        self.interrupt()
        return self._line.put("lesson", work.learn, self._folder, self._bell.make_token("lesson"), number, take)

    def reach(self, number: int, program: str) -> Future[tuple[Reach, ...]]:
        """What a program does on every asset that `work.reach` looks at; number: of the lesson that it comes from.

        Raises ProgramError for a text that is no program, or a template that is not there.
        """
        self._bell.cancel("reach")
        return self._line.put("reach", work.reach, self._folder, self._bell.make_token("reach"), program)

    def generalise(self, extractor: str, rule: int, program: str | None) -> Future[Generalised]:
        """What an extractor selects on the same assets as a rule of that number meets them, after those of a program.

        Raises ProgramError for a text that is no extractor.
        """
        self._bell.cancel("generalise")
        ticket = self._bell.make_token("generalise")
        return self._line.put("generalise", work.generalise, self._folder, ticket, extractor, rule, program)

    def interrupt(self) -> None:
        """End the lesson that is learned, and the reach that is worked out, soon."""
        self._bell.cancel("lesson", "reach")

    def close(self) -> None:
        """Stop the process."""
        self._line.close()
        self._workers.close()
        self._bell.close()
