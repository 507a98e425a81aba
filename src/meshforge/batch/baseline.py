"""What checks found before, by the digests of all that decided it: checked is what changed, only new errors fail."""

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ValidationError

from meshforge.batch.check import CheckOutcome, CheckTask
from meshforge.batch.jobs import AssetJob
from meshforge.batch.provenance import content_digest, find_version, has_same_files, software_version, value_digest
from meshforge.checks import CHECKS, VALIDATORS, Examination, Finding
from meshforge.common import UsageError, plain_path, relative_name, to_text, write_atomically

_PACKAGES = ("mujoco", "pybullet", *(name for names in VALIDATORS.values() for name in names))
_REMEDY = "Write one: meshforge check ASSETS... --baseline FILE --update-baseline"


class BaselineEntry(BaseModel):
    """What was found of one asset. files: the digest of each of its files, by its path from the folder of the baseline;
    None where it is to be checked again in any case; settings: the digest of what was asked for, and of versions."""

    files: dict[str, str] | None
    settings: str
    findings: tuple[Finding, ...]


class _BaselineFile(BaseModel):
    version: Literal[1] = 1
    assets: dict[str, BaselineEntry] = {}


@dataclass(frozen=True, eq=False, slots=True)
class Baseline:
    """A file of what was found. folder: from which the paths of its assets count, so that it can be kept with them."""

    path: Path
    entries: Mapping[str, BaselineEntry]

    @staticmethod
    def read(path: Path, *, new: bool = False) -> "Baseline":
        """Return what a file has; with `new`, one of nothing where there is none. Raises UsageError where there is
        none, or it is no baseline."""
        try:
            return Baseline(path, _BaselineFile.model_validate_json(path.read_bytes()).assets)
        except FileNotFoundError:
            if new:
                return Baseline(path, {})
            raise UsageError("there is no such baseline", where=str(path), remedy=_REMEDY) from None
        except ValidationError:
            remedy = "Bring back the file as it was; or delete it, and write it anew with --update-baseline."
            raise UsageError("it is no baseline of `meshforge check`", where=str(path), remedy=remedy) from None

    @property
    def folder(self) -> Path:
        return plain_path(self.path).parent

    def find_unchanged(self, jobs: Iterable[AssetJob], task: CheckTask) -> dict[str, CheckOutcome]:
        """Return what was found of those assets, by id, of which every file, what is asked and all versions are as they
        were. With a mesh to compare with (`against`) there are none."""
        found = {}
        for job in jobs if task.against is None else ():
            entry = self.entries.get(self._key(job))
            if entry is None or not entry.files:
                continue
            with suppress(OSError):  # what cannot be read is checked, which says so
                is_as_asked = entry.settings == _digest_settings(job, task)
                if is_as_asked and has_same_files(entry.files, job.path, self.folder):
                    kept = Examination(entry.findings)
                    found[job.id] = CheckOutcome(job.path, None, kept, digests=entry.files, is_unchanged=True)
        return found

    def compare(self, job: AssetJob, outcome: CheckOutcome) -> CheckOutcome:
        """Return an outcome with the findings that are known: of the same rule and at most the same severity, on no
        other hulls; where no hull is named, with the same message."""
        entry = self.entries.get(self._key(job))
        known = entry.findings if entry else ()
        found = (one for one in outcome.findings if _is_among(one.relate_to(self.folder), known))
        return replace(outcome, accepted=frozenset(found))

    def write(self, done: Iterable[tuple[AssetJob, CheckOutcome]], task: CheckTask) -> None:
        """Write the file with the outcomes of a whole run; other assets stay in it as long as they are there."""
        entries = {name: entry for name, entry in self.entries.items() if (self.folder / name).exists()}
        for job, outcome in done:
            files = None if outcome.digests is None else dict(outcome.digests)
            findings = tuple(one.relate_to(self.folder) for one in outcome.findings)
            settings = _digest_settings(job, task) if files else ""
            entries[self._key(job)] = BaselineEntry(files=files, settings=settings, findings=findings)
        text = _BaselineFile(assets=dict(sorted(entries.items()))).model_dump_json(indent=1)
        write_atomically(self.path, text + "\n")

    def _key(self, job: AssetJob) -> str:
        return to_text(relative_name(plain_path(job.path), self.folder))


def _digest_settings(job: AssetJob, task: CheckTask) -> str:
    measures = task.measures
    plugins = software_version(CHECKS.plugin(name) for name in measures.names)
    labels = content_digest(job.labels) if job.labels else None
    return value_digest([measures.names, measures.cell, labels, plugins, *map(find_version, _PACKAGES)])


def _is_among(found: Finding, known: Iterable[Finding]) -> bool:
    return any(
        (one.rule, one.check) == (found.rule, found.check)
        and (one.severity == "error" or found.severity == "warning")
        and (set(found.hulls) <= set(one.hulls) if found.hulls else found.message == one.message and not one.hulls)
        for one in known
    )
