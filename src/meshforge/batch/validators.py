"""Other validators asked about the file of an asset, each in a process of its own: simcheck, and for USD NVIDIA's
SimReady. What they find are findings in their own words."""

import json
import subprocess
import sys
from ast import literal_eval
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from meshforge.batch.provenance import find_version
from meshforge.checks import VALIDATORS, CheckFindings, Measure
from meshforge.common import MeshForgeError, join_names, pluralize, quote_path
from meshforge.engines import Finding
from meshforge.formats import format_of, save
from meshforge.symbolic import SymbolicMesh

_SECONDS = 120.0
_OWN_FORMATS = ("urdf", "mjcf", "obj", "stl", "ply")  # that simcheck reads
_PROFILE = "Robotics-Prop"
_SIMREADY = "from simready.validate._cli import main; main()"
_SHOWN = 2  # of the messages of one requirement


@dataclass(frozen=True, eq=False, slots=True)
class SecondOpinion(Measure):
    """What another validator says of an asset: a sentence, and its report as it is."""

    summary: str
    report: Mapping[str, Any]

    @property
    def description(self) -> str:
        return self.summary

    def to_json(self) -> dict[str, Any]:
        return dict(self.report)


def ask_validator(name: str, path: Path | None, mesh: SymbolicMesh) -> CheckFindings:
    """Return what another validator finds in a file; simcheck, of a format that it does not read, in what
    `meshforge convert` writes of it as MJCF. One that is not there, fails, or takes too long is a warning.

    name: of `VALIDATORS`; path: of the file as it is now, None for a mesh that no file is of.
    """
    if not all(map(find_version, VALIDATORS[name])):
        where = ", in Python 3.11 or 3.12" if name == "simready" else ""
        return _not_tried(name, "it is not installed", f"Install it{where}: pip install 'meshforge[referees]'")
    form = format_of(path).name if path else ""
    with TemporaryDirectory(prefix="meshforge-") as folder:
        try:
            if name == "simready":
                if path is None or form != "usd":
                    given = quote_path(path) if path else "FILE"
                    return _not_tried(name, "it reads USD only", f"Write it as USD: meshforge convert {given} OUT.usda")
                return _ask_simready(path.absolute(), Path(folder))
            own = path is not None and form in _OWN_FORMATS
            file = path.absolute() if path and own else save(mesh, Path(folder) / "asset.xml").path
            return _ask_simcheck(file, Path(folder), "" if own else " of what `meshforge convert` makes of it")
        except MeshForgeError as error:
            return _not_tried(name, f"it cannot be made an MJCF: {error.message}")
        except subprocess.TimeoutExpired:
            return _not_tried(name, f"it took longer than {_SECONDS:g} s")
        except _NoReportError as error:
            return _not_tried(name, f"it gave no report: {error}")


class _NoReportError(Exception):
    """Its message has the validator's last words."""


def _not_tried(name: str, why: str, remedy: str = "") -> CheckFindings:
    message = f"not tried in {name}: {why}"
    return CheckFindings((Finding(f"{name}-untried", "warning", (), message, remedy),))


def _run(folder: Path, report: Path, *arguments: str) -> Any:
    """The JSON that a module writes to a file, run in a folder. Raises _NoReportError, TimeoutExpired."""
    command = [sys.executable, "-P", *arguments]
    done = subprocess.run(
        command,
        cwd=folder,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        errors="replace",
        timeout=_SECONDS,
    )
    try:
        return json.loads(report.read_bytes())
    except (OSError, ValueError):
        words = [line.strip() for line in (done.stdout + done.stderr).splitlines() if line.strip()]
        raise _NoReportError(words[-1] if words else f"exit code {done.returncode}") from None


def _ask_simcheck(file: Path, folder: Path, subject: str) -> CheckFindings:
    out = folder / "report.json"
    found = _run(folder, out, "-m", "simcheck", "check", str(file), "--no-config", "--json", str(out), "-q")
    report = found[0] if isinstance(found, list) else found
    title = f"simcheck {report['simcheck_version']}"
    findings = [_cite_simcheck(title, file.parent, one) for check in report["results"] for one in check["findings"]]
    if left := report["stats"].get("incomplete"):
        findings += _not_tried("simcheck", f"it did not come to an end: {left}").findings
    counts = ", ".join(pluralize(report["counts"][kind], kind) for kind in ("error", "warning"))
    skipped = sum(check["status"] == "skip" for check in report["results"])
    asked = join_names([f"{engine} {version}" for engine, version in report["engine_versions"].items()])
    tried = f"{len(report['results']) - skipped} checks tried with {asked or 'no engine'}, {skipped} skipped"
    summary = f"{report['simcheck_version']}{subject}: {report['verdict']}, {counts}; {tried}"
    return CheckFindings(tuple(filter(None, findings)), {"simcheck": SecondOpinion(summary, report)})


def _cite_simcheck(title: str, folder: Path, row: Mapping[str, Any]) -> Finding | None:
    """A finding of simcheck; None for a remark."""
    if row["severity"] not in ("error", "warning"):
        return None
    check, engine = row["check"], f" ({row['engine']})" if row["engine"] else ""
    message = f"{title}, {check}{engine}: {row['message'].replace(f'{folder}/', '')}"
    return Finding("simcheck", row["severity"], (), message, f"python -m simcheck explain {check}")


def _ask_simready(file: Path, folder: Path) -> CheckFindings:
    out = folder / "report.json"
    found = _run(folder, out, "-c", _SIMREADY, str(file), "--profile", _PROFILE, "--output", str(out))
    report = found[str(file)]
    title = f"simready-validate {report['simready_validate_version']}, {report['profile_id']}"
    features = dict(sorted(report["features_summary"].items()))
    groups = {
        "passed": [name for name, row in features.items() if row["passed"]],
        "failed": [name for name, row in features.items() if not row["passed"] and row["blocking_failure"]],
        "optional and not met": [n for n, row in features.items() if not row["passed"] and not row["blocking_failure"]],
    }
    verdicts = "; ".join(f"{what}: {', '.join(names)}" for what, names in groups.items() if names)
    summary = f"{report['profile_id']} {report['profile_version']}: {verdicts}"
    findings = tuple(_cite_simready(title, file.parent, features))
    return CheckFindings(findings, {"simready": SecondOpinion(summary, report)})


def _cite_simready(title: str, folder: Path, features: Mapping[str, Mapping[str, Any]]) -> Iterator[Finding]:
    """A finding for each requirement that a feature cannot do without."""
    failing: dict[str, list[str]] = {}
    words: dict[str, list[str]] = {}
    for name, row in features.items():
        for requirement in literal_eval(row.get("failing requirements", "[]")):
            failing.setdefault(requirement, []).append(name)
        words |= json.loads(row.get("requirement_messages", "{}"))
    for requirement, names in sorted(failing.items()):
        texts = [text.strip().replace(f"{folder}/", "") for text in words.get(requirement, ())]
        shown = [*dict.fromkeys(texts)][:_SHOWN]
        more = f" (said {len(texts)} times)" if len(texts) > len(shown) else ""
        message = f"{title}: {requirement} of {', '.join(names)}: {'; '.join(shown)}{more}"
        yield Finding("simready", "error", (), message, "")
