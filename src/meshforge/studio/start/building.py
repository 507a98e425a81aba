"""Builds the folder of a new project beside the place it will have: after a kill or an error there is either the whole
project or nothing of it.
"""

import shutil
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from secrets import token_hex

from meshforge.batch import hold_lock
from meshforge.common import MeshForgeError, ProjectError, UsageError
from meshforge.store.layout import JsonFile, read_derived, write_json
from meshforge.studio.start.folders import is_project

_SUFFIX = ".new-project"


class _Journal(JsonFile):
    """What is being built. draft: the folder; parents: folders made for it, the innermost first."""

    draft: str
    parents: tuple[str, ...] = ()


def check_place(folder: Path) -> None:
    """Raise UsageError where no new project can be made: something is there already, or it cannot be written."""
    try:
        if is_project(folder):
            raise UsageError(
                "there is a project here already", where=str(folder), remedy="Open it, or name another folder."
            )
        if folder.is_symlink() or (folder.exists() and not folder.is_dir()):
            raise UsageError("there is a file or a link of this name", where=str(folder), remedy="Name another folder.")
        if other := next(folder.iterdir(), None) if folder.exists() else None:
            problem = f"this folder holds something already: {other.name}"
            raise UsageError(problem, where=str(folder), remedy="Name a new folder, or an empty one.")
        above = next(parent for parent in folder.parents if parent.exists())
    except OSError as error:
        raise _describe_refusal(folder, error) from None
    if not above.is_dir():
        raise UsageError("this is a file", where=str(above), remedy="Name a folder that lies in no file.")


@contextmanager
def build_project(folder: Path, state: Path) -> Iterator[Path]:
    """Open a new folder to fill; then it takes the place of `folder`, or goes where an error came up.

    state: the user's state folder, which knows what is being built, so that the next studio removes it after a kill.
    Raises UsageError where no project can be made there, ProjectError while another studio makes one.
    """
    check_place(folder)
    with _hold_journal(state) as journal:
        remove_remains(journal)
        parents = tuple(parent for parent in folder.parents if not parent.exists())
        draft = folder.parent / f".{folder.name[:80]}.{token_hex(4)}{_SUFFIX}"
        made = _Journal(draft=str(draft), parents=tuple(map(str, parents)))
        try:
            write_json(journal, made)
            draft.mkdir(parents=True)
            yield draft
            if folder.exists():
                folder.rmdir()  # it is empty
            draft.rename(folder)
        except OSError as error:
            remove_remains(journal)
            raise _describe_refusal(folder, error) from None
        except BaseException:
            remove_remains(journal)
            raise
        journal.unlink(missing_ok=True)


def clean_up(state: Path) -> None:
    """Remove what a killed studio left half-built. Never raises."""
    with suppress(OSError, MeshForgeError), _hold_journal(state) as journal:
        remove_remains(journal)


@contextmanager
def _hold_journal(state: Path) -> Iterator[Path]:
    """The journal, which one studio at a time may use."""
    with ExitStack() as stack:
        try:
            stack.enter_context(hold_lock(state / "building.lock", str(state), wait=2.0))
        except MeshForgeError as error:
            if "another meshforge" not in error.problem:
                raise
            remedy = "Wait until it is done, then try again."
            raise ProjectError("another studio is making a project now", remedy=remedy) from None
        yield state / "building.json"


def remove_remains(journal: Path) -> None:
    """Remove what a journal says was being built, and the journal."""
    found = read_derived(journal, _Journal)
    draft = Path(found.draft) if found else None
    if draft and draft.name.endswith(_SUFFIX) and draft.name.startswith(".") and not draft.is_symlink():
        shutil.rmtree(draft, ignore_errors=True)
    for parent in found.parents if found else ():
        with suppress(OSError):  # something else is in it by now
            Path(parent).rmdir()
    journal.unlink(missing_ok=True)


def _describe_refusal(folder: Path, error: OSError) -> UsageError:
    remedy = "Name a folder that you may write, on a disk with room."
    return UsageError(f"the project cannot be written here: {error.strerror}", where=str(folder), remedy=remedy)
