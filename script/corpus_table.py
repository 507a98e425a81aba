"""The table of all files of the corpus and what MeshForge makes of each: `docs/corpus.md` and `docs/corpus.tsv`."""

from __future__ import annotations

import os
import re
import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import astuple, fields
from pathlib import Path

from meshforge.batch import ExecutionOptions, WorkerFailure, run_isolated
from meshforge.common import pluralize
from script.corpus_rows import Row, entries, row

DOCS = Path(__file__).resolve().parents[1] / "docs"
TABLE = DOCS / "corpus.tsv"
PAGE = DOCS / "corpus.md"
_SECONDS = 300.0  # for one file
_HEAD = """\
# What MeshForge makes of real files

`script/corpus` opened every file of the corpus that MeshForge can read, and every folder of several mesh files;
`script/corpus --check` lists the files that it reads differently now. The whole table is [corpus.tsv](corpus.tsv):
path, format, hulls, bodies, non-convex pieces (column `opaque`) with the reasons, notes, and the message if a file is
refused. Collada files are read as parts of other assets, so their rows say `part .dae`.
"""


def corpus() -> Path:
    """The folder of the corpus: MESHFORGE_CORPUS, or `../shared/corpus` beside the project."""
    named = os.environ.get("MESHFORGE_CORPUS")
    return Path(named).resolve() if named else DOCS.parents[1] / "shared" / "corpus"


def rows(root: Path, names: Sequence[str], workers: int | None = None) -> list[Row]:
    """The rows of paths below a root, each read in a worker process, so that none can take the others along."""
    found = run_isolated(row, [(str(root), name) for name in names], ExecutionOptions(workers, _SECONDS))
    return [
        Row(n, message=one.why) if isinstance(one, WorkerFailure) else one for n, one in zip(names, found, strict=True)
    ]


def table(found: Iterable[Row]) -> str:
    """All rows as text, a line each, columns apart by tabs."""
    lines = ["\t".join(field.name for field in fields(Row))]
    lines += ["\t".join(str(value).replace("\t", " ") for value in astuple(one)) for one in found]
    return "\n".join(lines) + "\n"


def parse(text: str) -> dict[str, str]:
    """The line of each path in a table."""
    return {line.split("\t", 1)[0]: line for line in text.splitlines()[1:]}


def page(found: Sequence[Row]) -> str:
    """The page: a summary by format, the files that are refused, what is noted, and the files without a hull."""
    refused = [one for one in found if one.message]
    closed = [one for one in found if one.opaque and not one.hulls]
    parts = [_HEAD, f"{pluralize(len(found), 'row')}: {_totals(found)}.\n", _summary(found)]
    parts += [_list("Refused", refused, "message"), _note(found)]
    parts += [_list("Without a hull, all pieces non-convex", closed, "reasons")]
    return "\n".join(parts)


def _note(found: Sequence[Row]) -> str:
    """The notes, the commonest first: in how many files, with one of these and what is noted there."""
    files: dict[str, dict[str, str]] = {}
    for one in found:
        for note in one.notes.split("; ") if one.notes else ():
            kind = re.sub(r"[\d,.]+|\([^)]*\)", "#", note)
            files.setdefault(kind, {}).setdefault(one.path, note)
    noted = [(len(own), *min(own.items())) for own in files.values()]
    noted.sort(key=lambda row: (-row[0], row[1]))
    lines = ["## Notes\n", "| files | such as | its note |", "|---|---|---|"]
    lines += [f"| {count} | {path} | {_cell(note)} |" for count, path, note in noted]
    return "\n".join(lines) + "\n"


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("<", "&lt;")


def _totals(found: Sequence[Row]) -> str:
    hulls, opaque = sum(one.hulls for one in found), sum(one.opaque for one in found)
    refused = sum(bool(one.message) for one in found)
    return f"{pluralize(hulls, 'hull')}, {pluralize(opaque, 'non-convex piece')}, {refused} refused"


def _summary(found: Sequence[Row]) -> str:
    kinds = Counter(_kind(one) for one in found)
    lines = [
        "| format | files | with hulls | hulls | bodies | non-convex pieces | refused |",
        "|---|---|---|---|---|---|---|",
    ]
    for kind in sorted(kinds):
        own = [one for one in found if _kind(one) == kind]
        counts = (len(own), sum(bool(o.hulls) for o in own), *(sum(getattr(o, f) for o in own) for f in _SUMMED))
        lines.append(f"| {kind} | " + " | ".join(map(str, (*counts, sum(bool(o.message) for o in own)))) + " |")
    return "\n".join(lines) + "\n"


_SUMMED = ("hulls", "bodies", "opaque")


def _kind(one: Row) -> str:
    """The format of a row, of a refused file its suffix."""
    return one.format or (Path(one.path).suffix.lower() or "folder")


def _list(title: str, found: Sequence[Row], field: str) -> str:
    lines = [f"## {title} ({len(found)})\n", "| file | hulls | non-convex | |", "|---|---|---|---|"]
    lines += [f"| {one.path} | {one.hulls} | {one.opaque} | {_cell(str(getattr(one, field)))} |" for one in found]
    return "\n".join(lines) + "\n"


def differences(before: dict[str, str], after: dict[str, str]) -> list[str]:
    """The lines that are gone, other or new, `-` and `+` ahead of them."""
    names = sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))
    pairs = ((sign, lines.get(name)) for name in names for sign, lines in (("-", before), ("+", after)))
    return [f"{sign} {line}" for sign, line in pairs if line is not None]


def main(words: Sequence[str]) -> int:
    """Write the table, or with --check tell what is otherwise in it; a folder may be named."""
    named = [word for word in words if not word.startswith("-")]
    root = Path(named[0]).resolve() if named else corpus()
    if not root.is_dir():
        print(f"{root}: no corpus is here; set MESHFORGE_CORPUS to its folder", file=sys.stderr)
        return 2
    found = rows(root, entries(root))
    if "--check" in words:
        changed = differences(parse(TABLE.read_text(encoding="utf-8")), parse(table(found)))
        print("\n".join(changed) or f"{pluralize(len(found), 'row')} as before")
        return int(bool(changed))
    TABLE.write_text(table(found), encoding="utf-8")
    PAGE.write_text(page(found), encoding="utf-8")
    print(f"{TABLE}: {pluralize(len(found), 'row')}, {_totals(found)}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
