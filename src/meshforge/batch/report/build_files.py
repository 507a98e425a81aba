"""Findings as builds read them: SARIF 2.1.0 for code scanning, and JUnit XML, a test case for each asset and check."""

import json
import os
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from urllib.parse import quote
from xml.etree import ElementTree

from meshforge.batch.check import CheckOutcome
from meshforge.batch.discovery import common_folder
from meshforge.batch.goals import AssetGoals
from meshforge.batch.jobs import AssetJob
from meshforge.batch.provenance import software_version, text_digest
from meshforge.checks import Finding, Physics
from meshforge.common import escape_text, plain_path, relative_name, to_text, write_atomically
from meshforge.engines import CODES, RuleCode, Severity

_SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
_UNCHANGED = "unchanged since the baseline, so not checked again"
_UNTRIED = "-untried"  # how rules end by which nothing was tried


@dataclass(frozen=True, slots=True)
class CheckCase:
    """What one check, or goal, found of one asset. accepted: what a baseline or a person has; skipped: why nothing, or
    not all, was looked at, empty where all was; strict: whether warnings count as errors."""

    asset: str
    path: Path
    check: str
    findings: tuple[Finding, ...] = ()
    accepted: frozenset[Finding] = frozenset()
    skipped: str = ""
    strict: bool = False

    @property
    def errors(self) -> tuple[Finding, ...]:
        """The errors that nobody accepted."""
        return tuple(one for one in self._wrong if one not in self.accepted)

    @property
    def reason(self) -> str:
        """Why it has neither passed nor failed, empty where it has."""
        known = [f"known: {one.message}" for one in self._wrong]
        return "" if self.errors else "; ".join(filter(None, [self.skipped, *known]))

    @property
    def _wrong(self) -> tuple[Finding, ...]:
        return tuple(one for one in self.findings if self.strict or one.severity == "error")

    def relate_to(self, base: Path) -> "CheckCase":
        """Return the same on every machine: paths in its messages count from a folder."""
        findings = tuple(one.relate_to(base) for one in self.findings)
        accepted = frozenset(one.relate_to(base) for one in self.accepted)
        skipped = self.skipped.replace(f"{base}{os.sep}", "")
        return replace(self, findings=findings, accepted=accepted, skipped=skipped)

    def locate(self, base: Path) -> str:
        """Return the path of the asset from a folder."""
        return relative_name(plain_path(self.path), base)


def list_check_cases(
    job: AssetJob, outcome: CheckOutcome, checks: Iterable[str], *, strict: bool = False
) -> Iterator[CheckCase]:
    """Yield a case for each check of an asset, legality first; one alone where it could not be read. strict: whether
    warnings count as errors."""
    examined = outcome.examination
    physics = examined.get("physics", Physics) if examined else None
    for name in ("legality", *checks) if examined else ("read",):
        findings = tuple(one for one in outcome.findings if one.check == name)
        untried = [one.message for one in findings if one.rule.endswith(_UNTRIED)]
        still = [f"not simulated: {physics.refused}"] if name == "physics" and physics and not physics.rest else []
        reasons = [*untried, *still, examined.unmeasured.get(name, "") if examined else ""]
        reasons = [_UNCHANGED] if outcome.is_unchanged else reasons
        yield CheckCase(job.id, job.path, name, findings, outcome.accepted, "; ".join(filter(None, reasons)), strict)


def list_goal_cases(path: Path, found: AssetGoals, accepted: Collection[str] = ()) -> Iterator[CheckCase]:
    """Yield a case for each goal that was tried on an asset, or one that it could not be read or edited. accepted:
    texts of goals that a person accepted to fail there."""
    if found.error:
        yield CheckCase(found.asset, path, "goals", (Finding("unreadable", "error", (), found.error, "", "goals"),))
    for name, result in found.after.items():
        check, skipped = f"goal {name}", result.why if result.outcome == "untried" else ""
        severity: Severity = "warning" if skipped else "error"
        finding = Finding(f"goal-{result.outcome}", severity, result.hulls, f"{result.goal}: {result.why}", "", check)
        findings = () if result.outcome == "passed" else (finding,)
        known = frozenset(findings if result.goal in accepted else ())
        yield CheckCase(found.asset, path, check, findings, known, skipped)


def make_edit_case(
    asset: str, path: Path, error: str | None, alarms: Sequence[str] = (), *, is_known: bool = False
) -> CheckCase:
    """Return the case of an edit. error: why it could not be made; alarms: why it stands out of its family; is_known:
    whether a person looked at it, or need not."""
    found = [Finding("unreadable", "error", (), error, "", "edit")] if error else []
    if alarms:
        found.append(Finding("outlier", "warning" if is_known else "error", (), "; ".join(alarms), "", "edit"))
    return CheckCase(asset, path, "edit", tuple(found))


def write_build_files(sarif: Path | None, junit: Path | None, name: str, cases: Sequence[CheckCase]) -> None:
    """Write what is asked for; name: of the command. Paths in the files count from here, where a build begins, or where
    assets lie elsewhere, from the folder that holds both."""
    base = common_folder([Path.cwd(), *(plain_path(case.path) for case in cases)])
    cases = [case.relate_to(base) for case in cases]
    if sarif:
        write_atomically(sarif, json.dumps(_to_sarif(name, cases, base), indent=1) + "\n")
    if junit:
        write_atomically(junit, _to_junit(name, cases, base))


def _to_sarif(name: str, cases: Sequence[CheckCase], base: Path) -> dict[str, Any]:
    found = [(case, finding) for case in cases for finding in case.findings]
    others = sorted({one.rule for _, one in found if one.code is None})
    rules = [*map(_to_rule, CODES.values()), *({"id": rule} for rule in others)]
    places = {rule["id"]: place for place, rule in enumerate(rules)}
    driver = {"name": "MeshForge", "version": software_version(), "rules": rules}
    results = [_to_result(case, finding, base, places) for case, finding in found]
    if any(case.accepted for case in cases):  # else there is nothing that they were compared with
        for (case, finding), result in zip(found, results, strict=True):
            result["baselineState"] = "unchanged" if finding in case.accepted else "new"
    run = {"tool": {"driver": driver}, "automationDetails": {"id": f"meshforge-{name}/"}, "results": results}
    return {"$schema": _SCHEMA, "version": "2.1.0", "runs": [run]}


def _to_rule(code: RuleCode) -> dict[str, Any]:
    text = f"{code.why}\nWhat to do: {code.remedy}\nExample: {code.example}"
    return {
        "id": code.code,
        "name": code.rules[0],
        "shortDescription": {"text": code.title},
        "fullDescription": {"text": code.why},
        "help": {"text": text, "markdown": text.replace("\n", "\n\n")},
    }


def _to_result(case: CheckCase, finding: Finding, base: Path, places: dict[str, int]) -> dict[str, Any]:
    rule, hulls = finding.code or finding.rule, [escape_text(hull) for hull in finding.hulls]
    names = "\n".join(hulls or [escape_text(finding.message)])
    digest = text_digest("\n".join([escape_text(case.asset), case.check, finding.rule, names]))
    physical = {
        "artifactLocation": {"uri": quote(to_text(case.locate(base))), "uriBaseId": "%SRCROOT%"},
        "region": {"startLine": 1},  # a hull has no line, and GitHub shows no result without one
    }
    logical = [{"name": hull, "fullyQualifiedName": hull, "kind": "object"} for hull in hulls]
    return {
        "ruleId": rule,
        "ruleIndex": places[rule],
        "level": "note" if finding.rule.endswith(_UNTRIED) else finding.severity,
        "message": {"text": escape_text("\n".join(filter(None, [finding.message, finding.remedy])))},
        "locations": [{"physicalLocation": physical} | ({"logicalLocations": logical} if logical else {})],
        "partialFingerprints": {"primaryLocationLineHash": f"{digest}:1"},
        "properties": {"rule": finding.rule, "check": case.check},
    }


def _to_junit(name: str, cases: Sequence[CheckCase], base: Path) -> bytes:
    failed, skipped = sum(bool(case.errors) for case in cases), sum(bool(case.reason) for case in cases)
    counts = {"tests": str(len(cases)), "failures": str(failed), "errors": "0", "skipped": str(skipped)}
    suites = ElementTree.Element("testsuites")
    suite = ElementTree.SubElement(suites, "testsuite", {"name": f"meshforge {name}"} | counts)
    for case in cases:
        about = {"classname": case.asset, "name": case.check, "file": case.locate(base)}
        line = ElementTree.SubElement(suite, "testcase", {key: escape_text(text) for key, text in about.items()})
        shown = escape_text("\n".join(map(str, case.findings)))
        if case.errors:
            first = case.errors[0]
            about = {"message": escape_text(first.message), "type": first.code or first.rule}
            ElementTree.SubElement(line, "failure", about).text = shown
        elif case.reason:
            ElementTree.SubElement(line, "skipped", {"message": escape_text(case.reason)})
        if shown and not case.errors:
            ElementTree.SubElement(line, "system-out").text = shown
    ElementTree.indent(suites)
    return bytes(ElementTree.tostring(suites, encoding="utf-8", xml_declaration=True)) + b"\n"
