"""Messages to people: words for them, and the one family of errors a user meets, each of which says what went wrong,
where, and what to do about it.
"""

import difflib
import errno
import os
import re
from collections.abc import Collection, Iterable, Sequence
from functools import partial
from typing import Any, ClassVar, Self

_UNSAFE = re.compile(
    r"[\x00-\x1f\x7f-\x9f\u00ad\u061c\u180e\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb\ufffe\uffff"
    r"\ud800-\udfff\U000e0000-\U000e007f]"
)  # control characters, those that reorder or hide text, and bytes of file names that are not UTF-8


def escape_name(text: str) -> str:
    """Return a name in one line that a terminal only shows: what would control it becomes `\x1b` or `\u202e`."""
    return _UNSAFE.sub(_escape, text)


def escape_text(text: str) -> str:
    """Return it as `escape_name`, for text of several lines: line ends and tabs stay."""
    return _UNSAFE.sub(lambda found: found[0] if found[0] in "\n\t" else _escape(found), text)


def _escape(found: re.Match[str]) -> str:
    byte = ord(found[0]) - 0xDC00  # by which Python holds a byte that is not UTF-8
    return f"\\x{byte:02x}" if 0x80 <= byte <= 0xFF else found[0].encode("unicode_escape").decode("ascii")


def is_text(name: str) -> bool:
    """Return whether a name can be written to a file: whether it holds no byte that is not UTF-8."""
    return not any("\ud800" <= letter <= "\udfff" for letter in name)


def to_text(name: str) -> str:
    """Return a name in which bytes that are not UTF-8 stand as `\xff`, so that it can be written to a file."""
    return name if is_text(name) else os.fsencode(name).decode("utf-8", "backslashreplace")


def pluralize(number: int, one: str, many: str | None = None) -> str:
    """Return `1 hull`, `2 hulls`, `2 bodies`."""
    return f"{number:,} {one if number == 1 else many or one + 's'}"


def join_and(names: Sequence[str]) -> str:
    """Return all names in a row: `a`, `a and b`, `a, b and c`."""
    return escape_name(" and ".join(part for part in (", ".join(names[:-1]), *names[-1:]) if part))


def join_names(names: Sequence[str], most: int = 5) -> str:
    """Return names in a row, of many the first ones: `a, b, c, d, e and 7 more`."""
    more = len(names) - most
    return escape_name(", ".join(names) if more <= 0 else f"{', '.join(names[:most])} and {more} more")


def nearest_name(name: str, available: Iterable[str]) -> str | None:
    """Return the available name most like `name`, or None where nothing is alike."""
    found = difflib.get_close_matches(name, sorted(available), n=1, cutoff=0.5)
    return found[0] if found else None


def format_share(share: float) -> str:
    """Return a probability in whole percent, rounded down, so that none below a limit looks as if it were at it."""
    return f"{int(share * 100 + 1e-9)}%"


def suggest_name(name: str, available: Iterable[str], otherwise: str | None = None) -> str | None:
    """Return the remedy for a name that is not available: the nearest one that is; `otherwise` where none is."""
    like = nearest_name(name, available)
    return f"Did you mean {like!r}?" if like else otherwise


def suggest_match(name: str, available: Iterable[str]) -> str:
    """Return the end of a sentence on a name that is not available: the nearest one that is, or nothing."""
    like = nearest_name(name, available)
    return f"; did you mean {like!r}?" if like else ""


def suggest_among(name: str, available: Collection[str], listing: str = "The vocabulary is") -> str:
    """Return the remedy for a name that is not available: the nearest one that is, and all of them."""
    return f"{suggest_name(name, available, '')} {listing} {', '.join(available) or 'empty'}.".lstrip()


class MeshForgeError(Exception):
    """What went wrong, where, and the remedy, in one message.

    where: the file, hull, or `file:line:column` it is about; remedy: what the user can do. Both are optional.
    Instances pickle, so that they can come back from worker processes whole.
    """

    exit_code: ClassVar[int] = 2

    def __init__(self, problem: str, *, where: str | None = None, remedy: str | None = None) -> None:
        self.problem = problem
        self.where = where
        self.remedy = remedy
        super().__init__(self.message)

    @property
    def message(self) -> str:
        """The full text: `where: problem. remedy`."""
        return f"{self._head}\n  {self.remedy}" if self.remedy else self._head

    @property
    def sentence(self) -> str:
        """The full text in one line: `where: problem. remedy`."""
        head = " ".join(self._head.split())
        return f"{head.rstrip('.')}. {self.remedy}" if self.remedy else head

    @property
    def _head(self) -> str:
        return f"{escape_name(self.where)}: {self.problem}" if self.where else self.problem

    def at(self, where: str) -> Self:
        """Return the error, about `where` when it did not say yet what it is about."""
        return self if self.where else type(self)(self.problem, where=where, remedy=self.remedy)

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(type(self), where=self.where, remedy=self.remedy), (self.problem,)

    def __str__(self) -> str:
        return self.message


def explain_refusal(error: OSError, where: str | None = None) -> MeshForgeError | None:
    """Return what the system refused, with the remedy, about `where` unless it says; None for a fault of ours."""
    name, why = error.filename, error.strerror
    if not isinstance(name, str | None) or not isinstance(why, str) or not (name or error.errno == errno.ENOSPC):
        return None
    remedy = next((text for codes, text in _REMEDIES.items() if error.errno in codes), None)
    return MeshForgeError(why, where=name or where or "while writing", remedy=remedy)


_REMEDIES = {
    (errno.ENOSPC, errno.EDQUOT): "Make room, then do the same again.",
    (
        errno.EACCES,
        errno.EPERM,
        errno.EROFS,
    ): "Change the permissions of the file or its folder, then do the same again.",
}


def describe_error(error: Exception, where: str | None = None, fault: str = "please report it") -> str:
    """Return the message of whatever went wrong, about `where` unless it says; fault: what to do about ours."""
    match error:
        case MeshForgeError():
            return (error.at(where) if where else error).message
        case MemoryError():
            what = "there is not enough memory for"
            return f"{escape_name(where)}: {what} it" if where else f"{what} this"
        case UnicodeEncodeError(object=text, start=start) if not is_text(text):
            near = escape_name(text[max(start - 40, 0) : start + 40])
            return f"{where or 'in a file'}: a name is not UTF-8: {near}\n  Rename the file or folder."
        case OSError() if refusal := explain_refusal(error, where):
            return refusal.message
        case _:
            head = f"{escape_name(where)}: " if where else ""
            return f"{head}{type(error).__name__}: {error}\n  This is a fault of MeshForge; {fault}."


class HullNotFoundError(MeshForgeError, KeyError):
    """A name that no hull of a mesh has."""


class AssetError(MeshForgeError):
    """A file that cannot be read or written as an asset."""


class MissingFilesError(AssetError):
    """An asset that refers to files that are not there. missing: the references, as written."""

    def __init__(
        self, problem: str, *, missing: Iterable[str] = (), where: str | None = None, remedy: str | None = None
    ) -> None:
        self.missing = tuple(missing)
        super().__init__(problem, where=where, remedy=remedy)

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(type(self), missing=self.missing, where=self.where, remedy=self.remedy), (self.problem,)


class CollisionLossError(AssetError):
    """A format that cannot hold what collides in an asset."""

    exit_code = 1


class GeometryError(MeshForgeError):
    """A shape that cannot be: no extent, not finite, not convex."""


class ProgramError(MeshForgeError):
    """A program text that does not parse, or a program that cannot run on an asset."""


class DemonstrationError(MeshForgeError):
    """Demonstrations that contradict each other, or that name what is not there."""


class ProjectError(MeshForgeError):
    """A project folder, or a file in it, that is not as it should be."""


class UsageError(MeshForgeError):
    """Arguments that do not fit together."""


class PluginError(MeshForgeError):
    """What a plug-in of another package does wrong, or that it cannot be loaded."""


class StoppedError(MeshForgeError):
    """Work that was stopped by whoever asked for it."""
