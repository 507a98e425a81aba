"""What is installed from a wheel has the studio's page in it."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_a_wheel_carries_the_built_page_and_no_sources_of_it(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(tmp_path), str(ROOT)]
    subprocess.run(command, check=True, capture_output=True)
    (wheel,) = tmp_path.glob("*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    assert "meshforge/studio/static/index.html" in names
    assert any(name.startswith("meshforge/studio/static/assets/") and name.endswith(".js") for name in names)
    assert not [name for name in names if name.startswith("web/") or name.endswith((".ts", ".tsx"))]
