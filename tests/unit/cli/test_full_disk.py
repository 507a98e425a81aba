"""Commands on a disk that fills up: one message that names a file, and nothing of before is lost."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from meshforge.project import Project
from tests.cup_project import CUP, cup_project
from tests.faults.runs import outputs

_ALONE = ("unshare", "--user", "--map-root-user", "--mount")  # in which an ordinary user may mount a disk
_CAN_MOUNT = sys.platform == "linux" and shutil.which("unshare") is not None
_SIZE = 2 << 20
_PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096
COMMANDS = {
    "label": "label {p} --with names --pattern b*=other",
    "label by hand": "label {p} cup.urdf cup/b0=other",
    "cut": "cut {p} cup.urdf cup/b0 --at 0.05,0.05,0.005 --across 1,0,0",
    "apply": "apply {p} --workers 1",
    "demonstrate": "demonstrate {p} cup.urdf All=>Delete",
    "convert": "convert assets {p}/out --to .xml --workers 1",
    "check --fix": "check assets --engine unreal --fix --out {p}/out --workers 1",
    "review": "review {p}",
}
IN_CI = ("label by hand", "apply", "review")


@pytest.mark.slow
@pytest.mark.skipif(not _CAN_MOUNT, reason="no disk can be mounted here")
@pytest.mark.parametrize(
    "command", [pytest.param(one, marks=[] if one in IN_CI else [pytest.mark.long]) for one in COMMANDS]
)
@pytest.mark.parametrize("room", [0, pytest.param(3, marks=pytest.mark.long)])
def test_one_message_names_a_file_and_nothing_of_before_is_lost(command: str, room: int, tmp_path: Path) -> None:
    words = [*_ALONE, sys.executable, "-m", "tests.unit.cli.test_full_disk", str(tmp_path), command, str(room)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=120)
    if done.returncode and "unshare" in done.stderr:
        pytest.skip("namespaces are not allowed here")
    assert done.returncode == 0, done.stdout + done.stderr
    code, said, before, after = json.loads(done.stdout.splitlines()[-1])
    assert "fault" not in said and "Traceback" not in said, said
    if room == 0:
        assert code, said
    if code == 2 or room == 0:
        assert "No space left" in said, said
        assert str(tmp_path) in said, said
        edited = {name: data for name, data in before.items() if name.startswith("edited/")}
        assert edited and edited.items() <= after.items(), said
    assert not [name for name in after if name.endswith(".tmp")], said


def _try_command(folder: Path, command: str, room: int) -> None:
    """One command in a project on a disk with so many pages left; prints what came of it."""
    (folder / "disk").mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={_SIZE}", "tmpfs", str(folder / "disk")], check=True)
    made = cup_project(folder)
    shutil.move(made.folder, folder / "disk/p")
    project = folder / "disk/p"
    text = (project / "meshforge.toml").read_text()
    (project / "meshforge.toml").write_text(
        text.replace('"../assets', '"../../assets').replace('["cup"]', '["cup", "other"]')
    )
    if command == "label":
        (project / "labels/bare.urdf.json").unlink()
    assert CUP in Project.open(project).assets()
    (project / "program.mf").write_text("labels cup\n\nIs(cup) => Replace(box)\n")
    before = {name: data.hex() for name, data in outputs(project).items()}
    with (folder / "disk/filler").open("wb", buffering=0) as filler:
        try:
            while True:
                filler.write(bytes(_PAGE))
        except OSError:
            filler.truncate(max(filler.tell() - room * _PAGE, 0))
    words = [word.replace("{p}", str(project)) for word in COMMANDS[command].split()]
    done = subprocess.run(
        [sys.executable, "-c", "from meshforge.cli import main; main()", *words],
        capture_output=True,
        text=True,
        cwd=folder,
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
    )
    after = {name: data.hex() for name, data in outputs(project).items()}
    print(json.dumps([done.returncode, done.stdout + done.stderr, before, after]))


if __name__ == "__main__":
    _try_command(Path(sys.argv[1]), sys.argv[2], int(sys.argv[3]))
