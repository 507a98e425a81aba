"""Outputs: drafts, written aside and read back, then put in place one asset after the other, each file by a rename,
and no file of anyone else's harmed."""

import errno
import os
import secrets
import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from meshforge.batch import provenance
from meshforge.batch.discovery import STATE
from meshforge.batch.jobs import ApplyOptions, ApplyTask, AssetJob
from meshforge.batch.outcome import AssetOutcome, Failed
from meshforge.common import DISK_ERRORS, AssetError, MeshForgeError, file_digest, join_names
from meshforge.formats import SaveResult, labels_beside, notes_after, output_path_of, part_meshes, read, save
from meshforge.symbolic import Asset, SymbolicMesh, write_labels

DRAFT_FILES, DRAFT_STAMP = "files", "stamp.json"
"""What there is in the folder of a draft."""


@dataclass(frozen=True, slots=True)
class WorkerResult:
    """What a worker made of one asset.

    draft: its new files with their stamp, None where there are none to put in place; inputs: of a failed asset, as far
    as they are known; disk: what is wrong with it, where nothing can be written any more.
    """

    outcome: AssetOutcome
    inputs: provenance.OutputInputs | None = None
    draft: provenance.OutputDraft | None = None
    disk: str | None = None


def find_disk_problem(error: BaseException | None) -> str | None:
    """Return what is wrong with the disk where that is behind an error, else None."""
    while error and not (isinstance(error, OSError) and error.errno in DISK_ERRORS):
        error = error.__cause__
    return error.strerror if isinstance(error, OSError) else None


def drafts_folder(out: Path) -> Path:
    """Return the folder for outputs that are not in place yet, on the disk of these, so that they can be renamed."""
    return out / STATE / "drafts"


def plan_draft(task: ApplyTask, job: AssetJob, asset: Asset, draft_folder: Path | None) -> provenance.OutputDraft:
    """Return where the output of an asset would be; aside: a folder that goes, where it is not to be kept."""
    attempt = secrets.token_hex(8)  # two nodes may be at it, when one that was given up for dead lives on
    folder = (draft_folder or drafts_folder(task.out)) / f"{provenance.text_digest(job.id)}-{attempt}" / DRAFT_FILES
    to = task.options.to
    if to is None:
        return provenance.OutputDraft(folder, output_path_of(asset, job.base, folder).relative_to(folder).as_posix())
    stem = job.id if job.path.is_dir() else job.id.removesuffix(job.path.suffix)
    return provenance.OutputDraft(folder, f"{stem}{to}")


def write_draft(
    plan: provenance.OutputDraft, mesh: SymbolicMesh, vocabulary: tuple[str, ...], options: ApplyOptions
) -> provenance.OutputDraft:
    """Return the output, with the labels of the edited mesh beside it, by the names that it reads back with.

    Raises AssetError where the format cannot hold the mesh, or what was written reads back as other hulls.
    """
    main = plan.folder / plan.main
    mesh = part_meshes(mesh, main) if options.one_file_a_hull else mesh
    saved = save(
        mesh,
        main,
        mass=options.mass,
        link=options.link,
        names=options.names,
        collision=options.collision,
        urdf_capsules=options.urdf_capsules,
    )
    remedy = "Make a hull of each: meshforge prepare PROJECT --decompose hull, or convert --concave hull."
    saved.report.refuse_lost_collision(str(mesh.asset.path if mesh.asset else main), remedy)
    back = read(main)
    written = mesh.as_written(saved.names, back)
    order = _check_hulls(back, written, saved.hulled)
    if written.labels:
        write_labels(labels_beside(main), written, vocabulary)
    files = sorted(path for path in plan.folder.rglob("*") if path.is_file())
    digests = {path.relative_to(plan.folder).as_posix(): file_digest(path) for path in files}
    labels = tuple(written.hull_of(name).label if name in written.index else None for name in order)
    read_notes = (
        (*notes_after(mesh.asset, back, saved.hulled), *_note_non_convex(mesh.asset, saved)) if mesh.asset else ()
    )
    here = tuple(note.replace(f"{plan.folder}{os.sep}", "") for note in read_notes)
    return provenance.OutputDraft(plan.folder, plan.main, digests, saved.notes, labels, here)


def _note_non_convex(asset: Asset, saved: SaveResult) -> tuple[str, ...]:
    """What the program cannot have seen, but for what the file says more of."""
    pieces = [piece for piece in asset.non_convex if saved.names.get(piece.name, piece.name) not in saved.hulled]
    names = join_names([piece.name for piece in pieces])
    return (f"no convex hulls, so left as they are: {names} ({pieces[0].reason})",) if pieces else ()


def _check_hulls(written: Asset, mesh: SymbolicMesh, hulled: tuple[str, ...]) -> list[str]:
    """The names that the file reads back as; labels are keyed by them, so these must be those of the mesh.

    hulled: of the hulls that the engine makes of non-convex pieces, which are there, too.
    """
    back = [geom.name for geom in written.geoms]
    wanted = [*(hull.name for hull in mesh.hulls), *hulled]
    if sorted(back) != sorted(wanted):
        differing = ", ".join(sorted(set(back) ^ set(wanted))[:5])
        remedy = "This is a fault of MeshForge; nothing was written. Please report the asset."
        raise AssetError(f"the edited file reads back with other hulls than it should have: {differing}", remedy=remedy)
    return back


class OutputFolder:
    """Which asset wrote which file of an output folder.

    Assets may share files (two robots, one folder of meshes) as long as they agree on the contents.
    """

    def __init__(self, out: Path, pending: Iterable[str]) -> None:
        """Take stock of what earlier runs wrote, and finish what a killed one was at.

        pending: the assets of this run, whose old files bind nobody. Raises MeshForgeError as `settle` does.
        """
        self._out = out
        self._placing = out / STATE / "placing"  # the one draft whose files are on their way
        self._pending = set(pending)
        self._files: dict[str, dict[str, str]] = {}  # digests by file name, of each asset
        self._writers: dict[str, dict[str, None]] = {}  # the assets that wrote each file
        with self._io_errors_end_run():
            for draft in (out / STATE).rglob("*.tmp"):  # of a killed run; the caller holds the lock: nobody writes it
                draft.unlink()
            for stamp in provenance.read_stamps(out):
                self._record(stamp.asset, stamp.outputs)
            if self._placing.exists():
                self._finish_interrupted()

    def commit(self, worked: WorkerResult) -> AssetOutcome:
        """Put the files of one asset in place, or away where it failed; its final outcome.

        Raises MeshForgeError where nothing can be written any more: a full disk fails all assets alike.
        """
        asset = worked.outcome.asset
        self._pending.discard(asset)
        if worked.disk:
            raise self._end_of_run(worked.disk)
        with self._io_errors_end_run():
            outcome = self._commit_draft(worked)
            if isinstance(outcome, Failed):
                self._remove_outputs(asset, list(self._files.get(asset, {})))
                stamp = provenance.Stamp(asset=asset, status="failed", inputs=worked.inputs, error=outcome.error)
                stamp.write(provenance.stamp_path(self._out, asset))
        return outcome

    @contextmanager
    def _io_errors_end_run(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise self._end_of_run(error.strerror) from error

    def _end_of_run(self, why: str | None) -> MeshForgeError:
        remedy = "What is in place stays. Fix that, then run the same command again: it goes on where it was."
        return MeshForgeError(f"nothing can be written here any more: {why}", where=str(self._out), remedy=remedy)

    def _commit_draft(self, worked: WorkerResult) -> AssetOutcome:
        outcome, draft = worked.outcome, worked.draft
        if isinstance(outcome, Failed):
            return outcome
        outputs = draft.files if draft else self._files.get(outcome.asset, {})
        problem = self._find_conflict(outcome.asset, outputs) or self._find_obstacle(outputs)
        if problem:
            return Failed(outcome.asset, problem, outcome.seconds)
        if draft:
            try:
                self._place_draft(outcome.asset, draft)
            except OSError as error:
                if error.errno in (*DISK_ERRORS, errno.EIO):
                    raise
                shutil.rmtree(self._placing, ignore_errors=True)
                return Failed(outcome.asset, f"{error.filename or self._out}: {error.strerror}", outcome.seconds)
        return outcome

    def _find_conflict(self, asset: str, outputs: Mapping[str, str]) -> str | None:
        for name, digest in outputs.items():
            bound = (other for other in self._writers.get(name, {}) if other != asset and other not in self._pending)
            other = next(bound, None)  # the others agree with it
            if other is not None and self._files[other][name] != digest:
                return (
                    f"{self._out / name}: {other} has written this file with other contents\n"
                    "  The two assets share a file that their edits change differently; write them to two folders."
                )
        return None

    def _find_obstacle(self, outputs: Mapping[str, str]) -> str | None:
        for name, digest in outputs.items():
            target = self._out / name
            if (
                name not in self._writers
                and target.exists()
                and not (target.is_file() and file_digest(target) == digest)
            ):
                return f"{target}: this is there, and no earlier run wrote it\n  Move it away, or choose another --out."
        return None

    def _place_draft(self, asset: str, draft: provenance.OutputDraft) -> None:
        """Put the files of a draft in place.

        First the draft becomes the one that is on its way, by one rename. Killed after that, the next run finds it,
        with the stamp that says what it is, and goes on: nothing else has to be written down.
        """
        self._record(asset, {**self._files.get(asset, {}), **draft.files})
        draft.root.replace(self._placing)
        self._rename_into_place(asset, draft.files, draft.main)

    def _finish_interrupted(self) -> None:
        """Put the files in place that a killed run had not."""
        stamp = provenance.read_stamp_file(self._placing / DRAFT_STAMP)  # not there any more: everything was in place
        if stamp and not self._find_obstacle(stamp.outputs):
            self._record(stamp.asset, {**self._files.get(stamp.asset, {}), **stamp.outputs})
            self._rename_into_place(stamp.asset, stamp.outputs, stamp.out)
        else:
            shutil.rmtree(self._placing)

    def _rename_into_place(self, asset: str, files: Mapping[str, str], main: str) -> None:
        """Rename the files into place, the main one last, put away those of before, and vouch for all.

        A file that is not there has been put in place before, or is missed when its digest is asked for.
        """
        for name in sorted(files, key=lambda name: (name == main, name)):
            source, target = self._placing / DRAFT_FILES / name, self._out / name
            target.parent.mkdir(parents=True, exist_ok=True)
            if source.exists():
                source.replace(target)
        self._remove_outputs(asset, [name for name in self._files[asset] if name not in files])
        stamp = provenance.stamp_path(self._out, asset)
        stamp.parent.mkdir(parents=True, exist_ok=True)
        (self._placing / DRAFT_STAMP).replace(stamp)
        shutil.rmtree(self._placing)

    def _remove_outputs(self, asset: str, names: Iterable[str]) -> None:
        """Remove files that were written for this asset and for nobody else, unless someone changed them since."""
        for name in names:
            digest = self._files[asset].pop(name)
            del self._writers[name][asset]
            path = self._out / name
            if not self._writers[name] and path.is_file() and file_digest(path) == digest:
                path.unlink()
                _remove_empty_folders(path.parent, self._out)

    def _record(self, asset: str, outputs: Mapping[str, str]) -> None:
        self._files[asset] = dict(outputs)
        for name in outputs:
            self._writers.setdefault(name, {})[asset] = None


def _remove_empty_folders(folder: Path, root: Path) -> None:
    while folder != root and not any(folder.iterdir()):
        folder.rmdir()
        folder = folder.parent
