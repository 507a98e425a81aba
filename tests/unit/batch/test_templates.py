from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.batch import load_templates, template_folders
from meshforge.common import ProgramError
from meshforge.language import Program
from tests.unit.batch.families import obj, write_table

PROGRAM = Program.parse('labels a\nIs(a) => Replace("bar.obj")\nIs(a) => Each(Add(+X, "knobs/knob.obj"))\n')


def test_a_template_is_looked_for_beside_the_program_first(tmp_path: Path) -> None:
    write_table(tmp_path / "templates/bar.obj")
    write_table(tmp_path / "templates/knobs/knob.obj")
    folders = template_folders(tmp_path / "program.mf")
    loaded = load_templates(PROGRAM, folders)
    assert {name: len(template.shapes) for name, template in loaded.items()} == {"bar.obj": 6, "knobs/knob.obj": 6}
    (tmp_path / "bar.obj").write_text(obj({"bar": ((0, 0, 0), (1, 1, 1))}))
    assert len(load_templates(PROGRAM, folders)["bar.obj"].shapes) == 1


def test_a_template_that_is_not_there_is_named_with_where_it_was_looked_for(tmp_path: Path) -> None:
    with pytest.raises(ProgramError, match=r'the template "bar\.obj" is not there') as caught:
        load_templates(PROGRAM, template_folders(tmp_path / "program.mf"))
    assert str(tmp_path / "bar.obj") in caught.value.message
    assert str(tmp_path / "templates" / "bar.obj") in caught.value.message


def test_a_template_that_is_not_convex_is_refused_by_its_name(tmp_path: Path) -> None:
    (tmp_path / "bar.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n")
    with pytest.raises(ProgramError, match=r'the template "bar\.obj" is no convex hull'):
        load_templates(PROGRAM, [tmp_path])
