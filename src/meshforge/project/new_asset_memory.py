"""What became of new assets, kept beside their preparations, so that a run that goes on does not prepare them again."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from pydantic import BaseModel, ConfigDict, ValidationError

from meshforge import batch
from meshforge.common import file_digest, write_atomically
from meshforge.project.new_asset_result import NewAssetResult
from meshforge.project.preparation_plan import PreparationPlan
from meshforge.store import Layout


class _ResultRecord(BaseModel):
    """basis: a digest of all that it was made from but the files; files: the digest of each file of the asset;
    preparation, labels: digests of what lies beside it, None for nothing."""

    model_config = ConfigDict(frozen=True)

    basis: str
    files: dict[str, str]
    preparation: str | None
    labels: str | None
    result: NewAssetResult


@dataclass(frozen=True, slots=True)
class NewAssetFolder:
    """Where an asset is prepared that is not of a project. id: of the asset; path: its file."""

    folder: Path
    id: str
    path: Path

    @property
    def preparation(self) -> Path:
        return Layout(self.folder).preparation(self.id)

    @property
    def labels(self) -> Path:
        return Layout(self.folder).labels(self.id)

    @property
    def _kept(self) -> Path:
        return self.folder / "results" / f"{self.id}.json"

    def read(self, basis: str) -> NewAssetResult | None:
        """What became of the asset; None where it, what it was prepared from or what was made of it is another now."""
        try:
            kept = _ResultRecord.model_validate_json(self._kept.read_bytes())
            same = kept.basis == basis and (kept.preparation, kept.labels) == self._digest()
            return kept.result if same and batch.has_same_files(kept.files, self.path, self.path.parent) else None
        except (OSError, ValidationError):
            return None

    def write(self, basis: str, files: dict[str, str], result: NewAssetResult) -> None:
        """Keep what became of the asset, when its preparation and its labels are written."""
        preparation, labels = self._digest()
        kept = _ResultRecord(basis=basis, files=files, preparation=preparation, labels=labels, result=result)
        write_atomically(self._kept, kept.model_dump_json(indent=1))

    def forget(self) -> None:
        """Keep nothing of the asset, before it is prepared anew."""
        self._kept.unlink(missing_ok=True)

    def _digest(self) -> tuple[str | None, str | None]:
        labels = file_digest(self.labels) if self.labels.exists() else None
        return batch.record_digest(self.preparation), labels


def digest_basis(
    plan: PreparationPlan, labels: Path | None, preparation: Path | None, rest: Sequence[str | bool | float | None]
) -> str:
    """A digest of all that a new asset is prepared from but its files. labels, preparation: what it has of these
    before, None for nothing; rest: what is the same for all."""
    own = file_digest(labels) if labels and labels.exists() else None
    before = batch.record_digest(preparation) if preparation else None
    return batch.text_digest(json.dumps([asdict(plan), own, before, rest, batch.software_version()]))
