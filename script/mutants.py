"""Tells whether tests notice changes of the source: places chosen at random, each judged by the tests that reach it.

`python -m script.mutants reach FOLDER` runs all tests once in a copy of the checkout that records which of them reach
the places of `tests/mutants/places.json`, and `python -m script.mutants judge FOLDER` makes each change in a copy of
its own, and runs the tests that reach it, the cheapest first, until one fails. What is done stays in FOLDER.
`tests/mutants/before.json` has the test that noticed each before tests were cut, null where none did, `after.json` that
which noticed it after.
"""

from __future__ import annotations

import ast
import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PLACES = ROOT / "tests/mutants/places.json"
MOST_SECONDS = 300.0
"""CPU time of the tests that are tried on one change."""
_CHUNK, _CHUNK_SECONDS = 60, 40.0
_BUILT = ("src/meshforge/studio/static", "web/node_modules", "tests/gltf_validator/node_modules")
_PROBE = '''"""Records which test reaches a place."""
import os
_seen = set()
def hit(number):
    test = os.environ.get("PYTEST_CURRENT_TEST", "?").rsplit(" (", 1)[0]
    if (number, test) not in _seen:
        _seen.add((number, test))
        with open(f"{FOLDER}/reach/{number:02d}", "a") as file:
            file.write(test + "\\n")
'''


@dataclass(frozen=True)
class Place:
    """A line of the source, as it is and as it becomes; line: where it was when it was chosen, from 1."""

    number: int
    file: str
    line: int
    text: str
    mutant: str

    def find(self, lines: list[str]) -> int | None:
        """Return the index of the line that has the text, the nearest one to where it was; None where none has."""
        found = [k for k, line in enumerate(lines) if line.strip() == self.text]
        return min(found, key=lambda k: abs(k + 1 - self.line), default=None)


def read_places() -> list[Place]:
    """Return the places in order."""
    return [Place(**row) for row in json.loads(PLACES.read_text(encoding="utf-8"))]


def copy_checkout(target: Path) -> Path:
    """Return a copy of the committed checkout, with what is built linked into it."""
    shutil.rmtree(target, ignore_errors=True)
    subprocess.run(["git", "clone", "--quiet", str(ROOT), str(target)], check=True)
    for name in _BUILT:
        (target / name).symlink_to(ROOT / name)
    return target


def run_tests(tree: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run pytest on a copy, also in the processes that its tests start."""
    env = {**os.environ, "PYTHONPATH": os.pathsep.join((str(tree / "src"), str(tree)))}
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--tb=line", *words]
    return subprocess.run(command, cwd=tree, env=env, capture_output=True, text=True, check=False)


def record_reach(folder: Path) -> None:
    """Run all tests with a probe at each place; writes `reach/NN` with their names, and `seconds.txt`."""
    tree = copy_checkout(folder / "tree")
    shutil.rmtree(folder / "reach", ignore_errors=True)
    (folder / "reach").mkdir()
    (tree / "src/meshforge/_probe.py").write_text(_PROBE.replace("{FOLDER}", str(folder)), encoding="utf-8")
    for place in read_places():
        path = tree / place.file
        lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
        at = place.find(lines)
        if at is None:
            print(f"{place.number:02d}: {place.file} has no line {place.text!r} any more")
            continue
        starts = {node.lineno - 1: node.col_offset for node in _list_statements(ast.parse("\n".join(lines)))}
        while at not in starts or lines[at][: starts[at]].strip():
            at -= 1
        lines.insert(at, f"{' ' * starts[at]}from meshforge import _probe; _probe.hit({place.number})")
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    done = run_tests(tree, "--all", "-n", "2", "--dist", "worksteal", "--record-seconds", str(folder / "seconds.txt"))
    print(done.stdout.splitlines()[-1])


def _list_statements(tree: ast.Module) -> list[ast.stmt]:
    bodies = (getattr(node, part, None) for node in ast.walk(tree) for part in ("body", "orelse", "finalbody"))
    return [one for body in bodies if isinstance(body, list) for one in body if isinstance(one, ast.stmt)]


def judge(folder: Path) -> None:
    """Print of each place the test that notices its change, and keep it in `judged/NN.json`."""
    rows = [line.split("\t", 1) for line in (folder / "seconds.txt").read_text(encoding="utf-8").splitlines()]
    seconds = {test: float(spent) for spent, test in rows}
    tree, caught = copy_checkout(folder / "tree"), 0
    (folder / "judged").mkdir(exist_ok=True)
    for place in read_places():
        kept = folder / f"judged/{place.number:02d}.json"
        if not kept.exists():
            kept.write_text(json.dumps(_judge_place(tree, place, folder, seconds)), encoding="utf-8")
        by = json.loads(kept.read_text(encoding="utf-8"))
        caught += bool(by)
        print(f"{place.number:02d} {place.file}: {by or 'not noticed'}", flush=True)
    print(f"{caught} are noticed")


def _judge_place(tree: Path, place: Place, folder: Path, seconds: dict[str, float]) -> str | None:
    path, reach = tree / place.file, folder / f"reach/{place.number:02d}"
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    at = place.find(lines)
    if at is None or not reach.exists():
        return None
    changed = [*lines[:at], lines[at].replace(place.text, place.mutant), *lines[at + 1 :]]
    path.write_text("\n".join(changed) + "\n", encoding="utf-8")
    names = set(reach.read_text(encoding="utf-8").splitlines())
    tests = sorted((name for name in names if "::" in name), key=lambda name: seconds.get(name, 5.0))
    spent, failed = 0.0, None
    while tests and not failed and spent < MOST_SECONDS:
        cost, count = 0.0, 0
        while count < min(len(tests), _CHUNK) and cost < _CHUNK_SECONDS:
            cost, count = cost + seconds.get(tests[count], 5.0), count + 1
        done = run_tests(tree, "-x", "-n", "0", *tests[:count])
        lines_of = (line.split(" ", 2) for line in done.stdout.splitlines())
        failed = next((words[1] for words in lines_of if words[0] in ("FAILED", "ERROR") and len(words) > 1), None)
        tests, spent = tests[count:], spent + cost
    subprocess.run(["git", "-C", str(tree), "checkout", "--quiet", "--", "src"], check=True)
    return failed


if __name__ == "__main__":
    {"reach": record_reach, "judge": judge}[sys.argv[1]](Path(sys.argv[2]).resolve())
