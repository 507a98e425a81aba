"""Which project a studio has open: one at a time, or none while its pages show the start page."""

import multiprocessing
from collections.abc import Callable
from contextlib import ExitStack, suppress
from dataclasses import replace
from pathlib import Path
from threading import Lock, RLock

from meshforge.batch import hold_lock
from meshforge.common import MeshForgeError, ProjectError
from meshforge.project import Project
from meshforge.store import ConflictError
from meshforge.studio.pages import PageConnection, PageHub
from meshforge.studio.session.session import Session, StudioOptions
from meshforge.studio.start.page import StartPage, state_folder
from meshforge.studio.wire.events import Start

EXIT_TIMEOUT = 3.0
"""Seconds that a worker process is waited for."""


class Host:
    """Opens and leaves projects. Without a folder in its options it begins with the start page."""

    def __init__(self, options: StudioOptions) -> None:
        self._options = options
        self._turn, self._lock = RLock(), Lock()  # one opening at a time; a moment's look at what is open
        self._session: Session | None = None
        self._stack = ExitStack()
        self._hub = PageHub()
        self.is_closing = False
        self._start = StartPage(state_folder())
        if options.folder is None:
            self._start.begin()

    @property
    def session(self) -> Session:
        """The open project. Raises ConflictError where none is open."""
        session = self._session
        if session is None:
            raise ConflictError("no project is open", remedy="Open one on the start page.")
        return session

    @property
    def start(self) -> StartPage:
        """The start page. Raises ConflictError while a project is open, or where the studio was started on one."""
        self._check_start()
        if self._session is not None:
            raise ConflictError("a project is open", remedy="Leave it first.")
        return self._start

    def open(self, folder: Path, *, tour: bool = False) -> None:
        """Open a project, and show it on all pages. tour: with the guided tour.

        Raises MeshForgeError: no project there, or a studio has it open already.
        """
        with self._turn:
            if self._session is not None:
                raise ConflictError("a project is open", remedy="Leave it first.")
            with ExitStack() as stack:
                _lock_studio(stack, Project.open(folder))
                session = Session(folder, replace(self._options, tour=tour or self._options.tour))
                stack.callback(_wait_for_processes)
                stack.callback(session.close)
                stack.callback(self._remember, session)
                session.start()
                self._stack = stack.pop_all()
            self._remember(session)
            with self._lock:
                self._session = session
                self._hub.close()
            self._start.rest()

    def create(self, make: Callable[[StartPage], Path], *, tour: bool = False) -> Session:
        """Make a project and open it. Raises MeshForgeError where that cannot be."""
        with self._turn:
            self.open(make(self.start), tour=tour)
            return self.session

    def _remember(self, session: Session) -> None:
        """Put a project first among the recent ones, with how far it is; a damaged one stays where it was."""
        project = session.project
        with suppress(MeshForgeError):
            self._start.recent.add(project.folder, project.name, len(project.assets()), session.describe_state())

    def leave(self) -> None:
        """Close the project, and show the start page. Raises ConflictError where the studio was started on one."""
        with self._turn:
            self._check_start()
            if self._session is None:
                return
            with self._lock:
                self._session = None
            self._stack.close()

    def _check_start(self) -> None:
        if self._options.folder is not None:
            raise ConflictError("this studio was started on one project", remedy="Start one without: meshforge studio")

    def join(self, page: PageConnection) -> PageHub:
        """Show a page what is open now, and from now on what changes; gives where it is to be taken off again."""
        with self._lock:
            if self._session is not None:
                self._session.pages.join(page)
                return self._session.hub
            self._hub.join(page, Start(start=self._start.view))
            return self._hub

    def close(self) -> None:
        """Close everything, worker processes too."""
        self.is_closing = True
        with self._turn:
            self._stack.close()
            self._hub.close()
            self._start.close()


def _wait_for_processes() -> None:
    """Wait for worker processes: one that is just starting would fail if its locks went with this process."""
    for process in multiprocessing.active_children():
        process.join(EXIT_TIMEOUT)


def _lock_studio(stack: ExitStack, project: Project) -> None:
    """Lock the project for this studio: two would each have half of its history."""
    try:
        stack.enter_context(hold_lock(project.layout.studio / "lock", str(project.folder), wait=0))
    except MeshForgeError as error:
        remedy = "Use the page that is open, or stop that studio first."
        raise ProjectError("the studio is open on this project already", where=error.where, remedy=remedy) from None
