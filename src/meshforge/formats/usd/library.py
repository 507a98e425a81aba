"""OpenUSD, the library: imported at use, one user at a time, its complaints collected instead of printed."""

from __future__ import annotations

import re
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from meshforge.errors import AssetError

_LOCK = threading.RLock()
"""Layers are shared in a process: while one asset is edited in memory, nobody may read it."""
_STAGE = re.compile(r"\s*\((?:instantiating|recomposing) stage on stage .*\)\s*$", re.S)
_DAMAGE = (ValueError, LookupError, TypeError, AttributeError, OverflowError, MemoryError)
_REMEDY = "Mend the file, or export it anew."
_INSIDE = re.compile(r"\bpxrInternal\w*::|@anon:0x[0-9a-f]+:[^@]*@,?")  # the library's names for parts of its own
_LONGEST = 300  # characters of a complaint in a message


def need_usd(where: str) -> None:
    """Raise AssetError where a package is not installed."""
    try:
        import lz4.block  # noqa: F401 (these fail here, with the remedy, rather than later)
        import pxr.Usd  # noqa: F401
    except ImportError as error:
        problem = f"USD files need the packages usd-core and lz4, and {error.name} is not installed"
        raise AssetError(problem, where=where, remedy="Install it: pip install 'meshforge[usd]'.") from error


@contextmanager
def usd(where: str) -> Iterator[list[str]]:
    """The library, for one asset alone; the list gets what it complains about in between.

    Raises AssetError at `where`, with its first complaint, where it gives up.
    """
    need_usd(where)
    from pxr import Tf, UsdUtils

    told: list[str] = []
    with _LOCK:
        delegate = UsdUtils.CoalescingDiagnosticDelegate()
        try:
            with np.errstate(over="ignore", invalid="ignore"):  # numbers beyond all bounds are found and told
                yield told
        except Tf.ErrorException as error:
            problem = f"USD cannot read it: {_first(error.args, where)}"
            raise AssetError(problem, where=where, remedy=_REMEDY) from None
        except _DAMAGE as error:  # names that are no text, values of types that their schema does not know
            problem = f"this USD file is damaged: {shortened(str(error), where)}"
            raise AssetError(problem, where=where, remedy=_REMEDY) from error
        finally:
            said = [shortened(_words(item), where) for item in delegate.TakeUncoalescedDiagnostics()]
            told += dict.fromkeys(said)
            del delegate


def shortened(text: str, where: str) -> str:
    """A complaint in one line, of a long one the beginning; files are told from the folder of the asset."""
    line = " ".join(_INSIDE.sub("", _STAGE.sub("", text)).replace(f"{Path(where).absolute().parent}/", "").split())
    return line if len(line) <= _LONGEST else f"{line[:_LONGEST]} ..."


def _first(errors: tuple[object, ...], where: str) -> str:
    """The commentary of the first of the library's errors."""
    said = [_words(error) for error in errors]
    return shortened(next((text for text in said if text), "it gives no reason"), where)


def _words(complaint: object) -> str:
    """The text of a complaint; of one that repeats damaged text, that it does."""
    try:
        return str(getattr(complaint, "commentary", ""))
    except UnicodeDecodeError:
        return "it has names that are no text"
