"""The whole loop on three small tables, from files to edited files; on real families and the bundled tables: loop."""

from __future__ import annotations

from pathlib import Path

from meshforge.formats import load
from meshforge.language import Program
from tests.loop.command import meshforge_here as meshforge
from tests.unit.batch.families import PROGRAM, write_tables


def test_from_files_to_edited_files(tmp_path: Path) -> None:
    sources = write_tables(tmp_path / "assets")
    meshforge("new", "tables", "assets", "--vocabulary", "top,leg,misc", cwd=tmp_path)
    meshforge("label", "tables", "--with", "file", cwd=tmp_path)
    for table in ("table0", "table2"):
        steps = ("crumb => Delete", "left_*, right_* => Each(Merge)")
        meshforge("demonstrate", "tables", f"{table}/model.obj", *steps, cwd=tmp_path)
    learned = meshforge("synthesize", "tables", cwd=tmp_path)
    assert Program.parse(learned.out) == Program.parse(PROGRAM)
    meshforge("apply", "tables", "--workers", "1", cwd=tmp_path)
    for source in sources:
        before, after = load(source), load(tmp_path / "tables/edited" / source.parent.name / source.name)
        assert sorted(hull.label or "" for hull in after.hulls) == ["leg", "leg", "top"]
        assert after.hull_of("top").volume == before.hull_of("top").volume
