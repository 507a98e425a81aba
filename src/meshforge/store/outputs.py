"""The outputs of a project as they lie there now: whether each is still what was written."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from pydantic import Field

from meshforge.batch import Stamp, read_stamp, value_digest
from meshforge.common import FileState, file_state, write_atomically
from meshforge.store.layout import JsonFile, Layout, read_derived
from meshforge.store.meshes import FileRecord, look_at_files


class _OutputsFile(JsonFile):
    """Files of outputs by their paths from their folder."""

    files: dict[str, FileRecord] = Field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class AssetOutput:
    """What was written of an asset.

    stamp: None where nothing was; is_whole: whether the files that geometry, masses or labels are read from are there
    as they were written.
    """

    stamp: Stamp | None
    is_whole: bool

    @property
    def digest(self) -> str | None:
        """The digest of those files, None where they are not whole."""
        return value_digest(self.stamp.essential) if self.stamp and self.is_whole else None


def find_outputs(layout: Layout, assets: Iterable[str], *, verify: bool = False) -> dict[str, AssetOutput]:
    """Return the outputs of assets, by id. verify: hash every file, also those that do not seem to have changed."""
    stamps = {asset: read_stamp(layout.edited, asset) for asset in assets}
    names = {name for stamp in stamps.values() if stamp for name in stamp.essential}
    known = _read_known(layout.outputs, file_state(layout.outputs))
    files = look_at_files(layout.edited, names, {} if verify else known)
    news = sum(known.get(name) is not file for name, file in files.items())
    if news * 100 > len(known):  # so that a family is not written anew for each asset of it
        write_atomically(layout.outputs, _OutputsFile(files={**known, **files}).model_dump_json())
    digests = {name: file.digest for name, file in files.items()}
    return {asset: AssetOutput(stamp, _is_whole(stamp, digests)) for asset, stamp in stamps.items()}


@lru_cache(maxsize=1)
def _read_known(path: Path, state: FileState | None) -> dict[str, FileRecord]:
    """What is known of files, as it was kept at that time; nothing where that is damaged."""
    return (read_derived(path, _OutputsFile) or _OutputsFile()).files


def _is_whole(stamp: Stamp | None, now: dict[str, str]) -> bool:
    return stamp is not None and stamp.status != "failed" and stamp.essential.items() <= now.items()
