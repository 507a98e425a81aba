"""What the Khronos glTF validator says of files; it runs on Node, which `script/bootstrap dev` installs."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import pytest

_HOME = Path(__file__).parent / "gltf_validator"
_NODE = Path(sys.executable).parent / "node"


def errors(paths: Sequence[Path]) -> list[Counter[str]]:
    """The codes of the errors in each file, with how often they occur; skips the calling test without a validator."""
    if not _NODE.exists() or not (_HOME / "node_modules").is_dir():
        if os.environ.get("CI"):
            pytest.fail("the glTF validator is not installed")
        pytest.skip("the glTF validator is not installed (script/bootstrap dev)")
    lines = subprocess.run(
        [str(_NODE), str(_HOME / "validate.mjs")],
        input="\n".join(map(str, paths)),
        capture_output=True,
        text=True,
        check=True,
        timeout=120,
    ).stdout.splitlines()
    reports = [json.loads(line) for line in lines]
    assert [report["path"] for report in reports] == [str(path) for path in paths]
    return [Counter(m["code"] for m in report["messages"] if m["severity"] == 0) for report in reports]
