"""Putting drafts in place: one asset after the other, each file by a rename, and no file of anyone else's harmed."""

from __future__ import annotations

import errno
from collections.abc import Iterable, Mapping
from pathlib import Path

from meshforge.batch.digests import file_digest
from meshforge.batch.draft import Draft
from meshforge.batch.edit import Worked
from meshforge.batch.folder import STATE
from meshforge.batch.outcome import Edited, Failed, Outcome, Unchanged
from meshforge.batch.stamp import Inputs, Stamp, all_stamps, read_stamp
from meshforge.errors import MeshForgeError

_HOPELESS = {errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EIO}
"""What is wrong with the disk, not with a file."""


class Ledger:
    """Which asset wrote which file of an output folder.

    Assets may share files (two robots, one folder of meshes) as long as they agree on the contents.
    """

    def __init__(self, out: Path, pending: Iterable[str]) -> None:
        """Take stock of what earlier runs wrote; pending: the assets of this run, whose old files bind nobody."""
        self._out = out
        self._pending = set(pending)
        self._files: dict[str, dict[str, str]] = {}  # digests by file name, of each asset
        self._writers: dict[str, dict[str, None]] = {}  # the assets that wrote each file
        for draft in (out / STATE).rglob("*.tmp"):  # of a killed run; the caller holds the lock, so nobody writes it
            draft.unlink()
        for stamp in all_stamps(out):
            self._record(stamp.asset, stamp.outputs)

    def settle(self, worked: Worked) -> Outcome:
        """Put the files of one asset in place, or away where it failed; its final outcome.

        Raises MeshForgeError where nothing can be written any more: a full disk fails all assets alike.
        """
        asset = worked.outcome.asset
        self._pending.discard(asset)
        try:
            outcome = self._settled(worked)
            if isinstance(outcome, Failed):
                self._withdraw(asset)
                Stamp.of_failure(outcome, worked.inputs).write(self._out)
        except OSError as error:
            raise MeshForgeError(
                f"nothing can be written here any more: {error.strerror}",
                where=str(self._out),
                remedy="What is in place stays. Mend that, then run the same command again: it goes on where it was.",
            ) from error
        return outcome

    def _settled(self, worked: Worked) -> Outcome:
        outcome, draft = worked.outcome, worked.draft
        if isinstance(outcome, Failed):
            return outcome
        stamp = read_stamp(self._out, outcome.asset)
        outputs = draft.files if draft else stamp.outputs if stamp else {}
        problem = self._clash(outcome.asset, outputs) or self._in_the_way(outputs)
        if problem:
            return Failed(outcome.asset, problem, outcome.seconds)
        if draft and worked.inputs and isinstance(outcome, Edited | Unchanged):
            try:
                self._put(outcome, draft, worked.inputs)
            except OSError as error:
                if error.errno in _HOPELESS:
                    raise
                return Failed(outcome.asset, f"{error.filename or self._out}: {error.strerror}", outcome.seconds)
        return outcome

    def _clash(self, asset: str, outputs: Mapping[str, str]) -> str | None:
        for name, digest in outputs.items():
            for other in self._writers.get(name, {}):
                if other != asset and other not in self._pending and self._files[other][name] != digest:
                    return (
                        f"{self._out / name}: {other} has written this file with other contents\n"
                        "  The two assets share a file that their edits change differently; write them to two folders."
                    )
        return None

    def _in_the_way(self, outputs: Mapping[str, str]) -> str | None:
        for name, digest in outputs.items():
            target = self._out / name
            if (
                name not in self._writers
                and target.exists()
                and not (target.is_file() and file_digest(target) == digest)
            ):
                return f"{target}: this is there, and no earlier run wrote it\n  Move it away, or choose another --out."
        return None

    def _put(self, outcome: Edited | Unchanged, draft: Draft, inputs: Inputs) -> None:
        """Announce the files, rename them into place, the main one last, then vouch for them.

        Killed in between, the announcement tells the next run that these files are ours and not to be trusted.
        """
        announced = {**self._files.get(outcome.asset, {}), **draft.files}
        self._record(outcome.asset, announced)
        Stamp(asset=outcome.asset, status="writing", outputs=announced).write(self._out)
        for name in sorted(draft.files, key=lambda name: (name == draft.main, name)):
            (self._out / name).parent.mkdir(parents=True, exist_ok=True)
            (draft.folder / name).replace(self._out / name)
        self._forget(outcome.asset, [name for name in announced if name not in draft.files])
        Stamp.of(outcome, inputs, draft).write(self._out)

    def _withdraw(self, asset: str) -> None:
        self._forget(asset, list(self._files.get(asset, {})))

    def _forget(self, asset: str, names: Iterable[str]) -> None:
        """Remove files that were written for this asset and for nobody else, unless someone changed them since."""
        for name in names:
            digest = self._files[asset].pop(name)
            del self._writers[name][asset]
            path = self._out / name
            if not self._writers[name] and path.is_file() and file_digest(path) == digest:
                path.unlink()
                _prune(path.parent, self._out)

    def _record(self, asset: str, outputs: Mapping[str, str]) -> None:
        self._files[asset] = dict(outputs)
        for name in outputs:
            self._writers.setdefault(name, {})[asset] = None


def _prune(folder: Path, root: Path) -> None:
    """Remove folders that have become empty, up to the root."""
    while folder != root and not any(folder.iterdir()):
        folder.rmdir()
        folder = folder.parent
