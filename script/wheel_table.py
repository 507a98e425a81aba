"""Which dependencies have binary wheels on which platform and Python; usage: script/wheels [--only WORD] [--json]."""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

PROJECT = Path(__file__).parents[1] / "pyproject.toml"
PYTHONS = ("3.11", "3.12", "3.13")
PLATFORMS = {
    "Linux x86_64": "x86_64-manylinux_2_28",
    "Linux aarch64": "aarch64-manylinux_2_28",
    "macOS 13 x86_64": "x86_64-apple-darwin",
    "macOS 13 arm64": "aarch64-apple-darwin",
    "Windows x86_64": "x86_64-pc-windows-msvc",
}
"""What the resolver calls each platform."""
_MACOS = "13.0"
_TIMEOUT = 600.0
_QUIET = ("--no-header", "--no-annotate", "--no-config", "--no-python-downloads", "--color", "never")
_NETWORK = re.compile(r"error sending request|failed to fetch|dns error|timed out", re.IGNORECASE)


@dataclass(frozen=True)
class Row:
    """A group of dependencies on one platform; lacking: requirements that do not resolve, and why."""

    platform: str
    python: str
    group: str
    packages: int
    lacking: dict[str, str]


def read_groups(project: Mapping[str, Any]) -> dict[str, list[str]]:
    """The dependencies of MeshForge itself, then those of each extra."""
    return {"meshforge": project["dependencies"], **project.get("optional-dependencies", {})}


def resolve(requirements: Sequence[str], platform: str, python: str) -> tuple[int, str]:
    """How many packages the requirements come to, and why they do not resolve, empty where they do."""
    target = ["--python-platform", PLATFORMS[platform], "--python-version", python]
    words = ["uv", "pip", "compile", "-", *target, "--only-binary", ":all:", *_QUIET]
    text = "".join(f"{line}\n" for line in requirements)
    environment = os.environ | {"MACOSX_DEPLOYMENT_TARGET": _MACOS}
    done = subprocess.run(
        words, input=text, capture_output=True, text=True, timeout=_TIMEOUT, check=False, env=environment
    )
    if done.returncode and _NETWORK.search(done.stderr):
        sys.exit(f"the package index does not answer:\n{done.stderr}")
    return len(done.stdout.split()), "" if done.returncode == 0 else shorten(done.stderr)


def shorten(text: str) -> str:
    """The reason out of what the resolver prints, in one line."""
    lines = (line.strip(" ╰─▶│├×·") for line in text.splitlines() if not line.startswith("warning"))
    return " ".join(" ".join(line for line in lines if line).split())


def check_group(group: str, requirements: Sequence[str], platform: str, python: str) -> Row:
    """One group; requirements that the reason names, and that do not resolve by themselves, are left out in turn."""
    rest, lacking = list(requirements), dict[str, str]()
    count, why = resolve(rest, platform, python)
    while why:
        named = [one for one in rest if name_of(one).lower() in why.lower()]
        bad = {one: problem for one in named if (problem := resolve([one], platform, python)[1])}
        if not bad:
            return Row(platform, python, group, 0, lacking | {"all together": why})
        lacking |= bad
        rest = [one for one in rest if one not in bad]
        count, why = resolve(rest, platform, python)
    return Row(platform, python, group, count, lacking)


def name_of(requirement: str) -> str:
    """The name of a package out of what is required of it."""
    found = re.match(r"[\w.-]+", requirement)
    return found.group() if found else requirement


def make_rows(only: str) -> Iterator[Row]:
    """A row for each platform, Python and group; only: of platforms that have this word in their name."""
    groups = read_groups(tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"])
    for platform in PLATFORMS:
        for python in PYTHONS if only.lower() in platform.lower() else ():
            for group, requirements in groups.items():
                yield check_group(group, requirements, platform, python)


def main() -> None:
    """Print a line for each row; exit code 1 when a dependency has no wheel."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", default="", metavar="WORD", help="Only platforms with WORD in their name.")
    parser.add_argument("--json", action="store_true", help="Print JSON, a line a row.")
    given = parser.parse_args()
    failed = False
    for row in make_rows(given.only):
        failed = failed or bool(row.lacking)
        if given.json:
            print(json.dumps(asdict(row)), flush=True)
            continue
        without = f", without {', '.join(map(name_of, row.lacking))}" if row.lacking else ""
        state = f"{row.packages} packages{without}"
        print(f"{row.platform:16} {row.python:5} {row.group:10} {state}", flush=True)
        for one, why in row.lacking.items():
            print(f"    {one}: {why}", flush=True)
    sys.exit(failed)


if __name__ == "__main__":
    main()
