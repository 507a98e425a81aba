"""One asset checked in every way that is asked for."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from meshforge.batch.mending import write_mended
from meshforge.checks import Finding, Fixed, check, engine_named, fix
from meshforge.errors import MeshForgeError
from meshforge.formats import load


@dataclass(frozen=True, slots=True)
class Wanted:
    """What is to be checked; out: the folder for mended assets, None where nothing is to be mended.

    tolerance: as of `fix` [m].
    """

    engine: str | None = None
    out: Path | None = None
    tolerance: float | None = None
    overwrite: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class Examination:
    """What was found of one asset; error: the whole message where it could not be read, or not be written.

    written: the file of the mended asset.
    """

    path: Path
    error: str | None = None
    findings: tuple[Finding, ...] = ()
    fixed: Fixed | None = None
    written: Path | None = None

    @property
    def failed(self) -> bool:
        return self.error is not None or any(f.severity == "error" for f in self.findings)

    def to_json(self) -> dict[str, Any]:
        """The examination as JSON-able data; lengths in metres."""
        rows = [
            {"rule": f.rule, "severity": f.severity, "hulls": list(f.hulls), "message": f.message, "remedy": f.remedy}
            for f in self.findings
        ]
        line: dict[str, Any] = {"asset": str(self.path), "error": self.error, "findings": rows}
        if self.fixed:
            line["fixed"] = _fixed(self.fixed, self.written)
        return line


def examine(path: Path, base: Path, labels: Path | None, wanted: Wanted) -> Examination:
    """The examination of an asset, which never raises for what is wrong with it; findings are those after mending.

    base: the common folder of the assets. Raises UsageError for an engine that is not known.
    """
    engine = engine_named(wanted.engine) if wanted.engine else None
    fixed, written = None, None
    try:
        mesh = load(path, labels=labels)
        if wanted.out and engine:
            fixed = fix(mesh, engine, wanted.tolerance)
            mesh = fixed.mesh
            written = write_mended(mesh, base, wanted.out, overwrite=wanted.overwrite)
        return Examination(path, None, check(mesh, wanted.engine), fixed, written)
    except MeshForgeError as problem:
        return Examination(path, problem.message)


def _fixed(fixed: Fixed, written: Path | None) -> dict[str, Any]:
    changes = [
        {
            "hull": change.hull,
            "made": change.made,
            "rules": list(change.rules),
            "error": change.error,
            "vertices": {"before": change.vertices[0], "after": change.vertices[1]},
            "polygons": {"before": change.polygons[0], "after": change.polygons[1]},
        }
        for change in fixed.changes
    ]
    return {"out": str(written), "changes": changes, "left": list(fixed.left)}
