"""The assets of a project as the language sees them, prepared and labelled; their labels files; and what they hold,
kept on disk, so that a status need not read hundreds of files again.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Generator, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from time import monotonic
from typing import Literal

from pydantic import BaseModel, ConfigDict, ValidationError

from meshforge import batch, formats, geometry, symbolic
from meshforge.common import FileState, describe_error, file_digest, file_state, relative_name, write_atomically
from meshforge.store.layout import Layout

_OFTEN = 20.0  # seconds of reading after which what was read is kept, so that a kill does not lose more
_SHARE = 20  # and as many times as long as keeping it took


class FileRecord(BaseModel):
    """A file and the digest that it had in a state."""

    model_config = ConfigDict(frozen=True)

    state: FileState
    digest: str


def look_at_files(folder: Path, names: Iterable[str], known: Mapping[str, FileRecord]) -> dict[str, FileRecord]:
    """Return files by their paths from a folder as they are now, without those that cannot be read. known: as they
    were; one that is in the same state is not hashed again."""
    found = dict[str, FileRecord]()
    for name in names:
        state, old = file_state(folder / name), known.get(name)
        if old and old.state == state:
            found[name] = old
        elif state:
            with suppress(OSError):
                found[name] = FileRecord(state=state, digest=file_digest(folder / name))
    return found


class AssetFacts(BaseModel):
    """What one asset holds. hulls: the digest of each by its name; files: all of it by their paths from the base.

    bodies, mentions: the name of the body of each hull, in order, and what else its file calls it; sources: how many
    pieces and bodies have no hulls but could be decomposed; preparation: the digest of what was done to the asset
    before; prepared: that in words; replaced: what each hull that was split has become.
    error: why the asset cannot be read.
    """

    model_config = ConfigDict(frozen=True)

    hulls: dict[str, str] = {}
    bodies: tuple[str, ...] = ()
    mentions: tuple[symbolic.Mentions, ...] = ()
    sources: int = 0
    preparation: str | None = None
    prepared: tuple[str, ...] = ()
    replaced: dict[str, tuple[str, ...]] = {}
    files: dict[str, FileRecord] = {}
    error: str | None = None

    @property
    def digests(self) -> dict[str, str]:
        """The digest of each file by its path from the base."""
        return {name: file.digest for name, file in self.files.items()}


class _AssetIndexFile(BaseModel):
    """form: counts the forms that this file had, as facts were added."""

    form: Literal[4]
    software: str
    assets: dict[str, AssetFacts]


def iterate_asset_index(
    found: batch.AssetSet,
    layout: Layout,
    only: Collection[str] | None = None,
    *,
    execution: batch.ExecutionOptions | None = None,
    progress: Callable[[], None] | None = None,
    verify: bool = False,
) -> Generator[tuple[str, AssetFacts], None, None]:
    """Yield the ids of all assets in order, or of some, with their facts, as soon as these are known.

    Those whose files changed since are read; what was read is kept now and then, and at the end. layout: where the
    project keeps preparations, and these facts; progress: called for each that had to be read; verify: hash every file.
    """
    known = _FactsMemory(layout.asset_index, found)
    wanted = found.choose(only).items()
    work = {key: _AssetPaths(path, found.base_of(path), layout.preparation(key)) for key, path in wanted}
    fresh = {key for key, own in work.items() if key in known.facts and known.confirm(key, own, verify)}
    todo = tuple(own for key, own in work.items() if key not in fresh)
    results = batch.execute(_read_facts, todo, replace(execution or batch.ExecutionOptions(), progress=progress))
    try:
        for key, own in work.items():
            if key not in fresh:
                result = next(results)
                known.add(
                    key,
                    AssetFacts(error=f"{own.path}: {result.why}")
                    if isinstance(result, batch.WorkerFailure)
                    else result,
                )
            yield key, known.facts[key]
    finally:  # also when the caller stops early
        results.close()
        known.keep()


class _FactsMemory:
    """What is known of assets, in memory and in a file; found: those that there are."""

    def __init__(self, file: Path, found: batch.AssetSet) -> None:
        self._file, self._ids = file, found.ids
        self._software = batch.software_version(map(formats.plugin_of_suffix, found.suffixes))
        kept = _read_memory(file, self._software)
        self.facts = {key: kept[key] for key in self._ids if key in kept}
        self._has_news = len(self.facts) < len(kept)
        self._kept_at, self._pause = monotonic(), _OFTEN

    def confirm(self, key: str, work: _AssetPaths, verify: bool) -> bool:
        """Whether the files and the preparation of an asset hold what they did."""
        facts = self.facts[key]
        try:
            main = {relative_name(file, work.base) for file in batch.source_files(work.path)}
        except OSError:
            return False
        files = look_at_files(work.base, facts.files, {} if verify else facts.files)
        now = facts if files == facts.files else facts.model_copy(update={"files": files})
        same = main <= files.keys() and now.digests == facts.digests
        if same and now is not facts:  # touched, or copied
            self.add(key, now)
        return same and batch.record_digest(work.preparation) == facts.preparation

    def add(self, key: str, facts: AssetFacts) -> None:
        self.facts[key] = facts
        self._has_news = True
        if monotonic() - self._kept_at > self._pause:
            self.keep()

    def keep(self) -> None:
        """Write what is new, and next time only after so long that this takes a small share of the time."""
        if not self._has_news:
            return
        began = monotonic()
        every = {key: self.facts[key] for key in self._ids if key in self.facts and not self.facts[key].error}
        with suppress(OSError):  # on a full disk all is read again, and what a command has to write says so
            write_atomically(
                self._file, _AssetIndexFile(form=4, software=self._software, assets=every).model_dump_json()
            )
        self._has_news, self._kept_at = False, monotonic()
        self._pause = max(_OFTEN, (self._kept_at - began) * _SHARE)


def geometry_digest(hulls: Mapping[str, str]) -> str:
    """Return one digest of all hulls of an asset; hulls: the digest of each by its name, in order."""
    return batch.text_digest("\n".join(f"{name} {known}" for name, known in hulls.items()))


def _read_memory(memory: Path, software: str) -> Mapping[str, AssetFacts]:
    try:
        kept = _parse_memory(memory, file_state(memory))
    except (OSError, ValidationError):
        return {}
    return kept.assets if kept.software == software else {}


@lru_cache(maxsize=1)
def _parse_memory(memory: Path, state: FileState | None) -> _AssetIndexFile:
    """The file as it was at that time: the studio looks at the same one for each portion of a large family."""
    return _AssetIndexFile.model_validate_json(memory.read_bytes())


@dataclass(frozen=True, slots=True)
class _AssetPaths:
    """An asset, the folder that names of its files count from, and that of its preparation."""

    path: Path
    base: Path
    preparation: Path


def _read_facts(work: _AssetPaths) -> AssetFacts:
    path, base = work.path, work.base
    try:
        source = formats.read(path)
        names = sorted(relative_name(file, base) for file in {*batch.source_files(path), *source.files})
        preparation = batch.read_preparation(work.preparation) or batch.Preparation()
        asset = batch.apply_preparation(source, preparation)
        entries = [entry for step in preparation.steps for entry in step.replaced]
        return AssetFacts(
            hulls={geom.name: geometry.digest(geom.shape) for geom in asset.geoms},
            bodies=tuple(geom.body for geom in asset.geoms),
            mentions=tuple(geom.mentions for geom in asset.geoms),
            sources=sum(not source.is_hopeless for source in batch.find_sources(asset)),
            preparation=batch.record_digest(work.preparation),
            prepared=tuple(map(str, preparation.steps)),
            replaced={entry.what: tuple(entry.made) for entry in entries if entry.kind == "hull"},
            files=look_at_files(base, names, {}),
        )
    except Exception as error:  # one asset never hides the others
        return AssetFacts(error=describe_error(error, str(path)))


@dataclass(frozen=True, slots=True)
class AssetFiles:
    """What one asset is read from, in this process or another.

    classes: what stands where a hull has no label; contact: the threshold, None for the language's own; up: the axis
    that points up in pictures where the format does not say, None for Z.
    """

    path: Path
    preparation: Path
    labels: Path
    classes: Path
    contact: float | None
    up: Literal["y", "z"] | None = None

    def read_mesh(self) -> symbolic.SymbolicMesh:
        """Return the asset as it is prepared, with its labels. Raises AssetError where it cannot be read."""
        mesh = self.to_mesh(batch.read_prepared(self.path, self.preparation))
        return symbolic.transfer_labels(self.read_labels(), mesh).mesh

    def to_mesh(self, source: symbolic.Asset) -> symbolic.SymbolicMesh:
        """Return the asset that was read as the project sees it, without labels."""
        known = formats.format_named(source.format)
        mesh = symbolic.SymbolicMesh.of(source).with_view_up(None if known and known.up else self.up)
        return mesh if self.contact is None else replace(mesh, epsilon=self.contact)

    def read_labels(self) -> symbolic.LabelFile:
        """Return its labels, and the classes of hulls without one. Raises AssetError where they cannot be read."""
        return read_labels_file(self.labels).fill(symbolic.read_classes(self.classes))


def read_labels_file(path: Path) -> symbolic.LabelFile:
    """Return the labels of an asset as they are kept; empty where there are none."""
    return symbolic.read_labels(path) if path.exists() else symbolic.LabelFile()


def hull_digests(mesh: symbolic.SymbolicMesh) -> dict[str, str]:
    """Return the digests of all hulls of a mesh by name, in order."""
    return {hull.name: geometry.digest(hull.shape) for hull in mesh.hulls}
