"""The text of USD layers: edits in place, and what becomes of text that is not understood."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from meshforge.common import AssetError
from meshforge.formats import read, save
from meshforge.formats.usd.layer_text import UnscannableError, has_comments, patch_layer, scan_layer
from tests.usd_stages import CUP, written

ODD = '''#usda 1.0
(
    """a } brace"""
)
def Xform "a" ( doc = "{ ( [" ) { custom string x = "}"; int y = 3 # behind
    rel z = </a{v=w}b>
    asset f = @./a}b.usda@
    dictionary d = { string e = "f" }
    def "b" { } /* } */
    variantSet "v" = {
        "w" { def "c" { } }
    }
}
'''


def test_prims_and_properties_are_found_whatever_stands_in_texts_and_comments() -> None:
    root = scan_layer(ODD)
    a = root.children["a"]
    assert list(root.children) == ["a"] and list(a.children) == ["b"]
    assert list(a.own) == ["x", "y", "z", "f", "d", '"v"']
    assert ODD[slice(*a.own["y"])] == "int y = 3" and ODD[a.end - 1] == "}"


@pytest.mark.parametrize("text", ['def "a" {', 'def "a" { int x = (3 }', "}", 'def "a" { } } def "b" { }'])
def test_what_does_not_close_is_not_understood(text: str) -> None:
    with pytest.raises(UnscannableError):
        scan_layer(text)


def test_comments_are_those_that_are_not_in_texts() -> None:
    assert has_comments("#usda 1.0\n# one") and not has_comments('#usda 1.0\ndef "a" { string b = "# none" }')


def test_without_an_edit_nothing_changes() -> None:
    library = '#usda 1.0\n\ndef "a"\n{\n    int x = 3\n}\n'
    assert patch_layer('#usda 1.0\ndef "a" { int x = 3 }', library, library) == '#usda 1.0\ndef "a" { int x = 3 }'


def test_a_text_of_another_form_is_written_anew_and_its_comments_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import meshforge.formats.usd.layer_text as writing

    monkeypatch.setattr(writing, "patch_layer", lambda text, before, after: text)  # an edit that goes amiss is noticed
    asset = read(written(tmp_path, CUP))
    saved = save(asset.with_geoms(asset.geoms[1:]), tmp_path / "out" / "a.usda")
    assert len(read(saved.path).geoms) == 3 and "comments in its text are not kept" in saved.notes


def test_without_the_library_the_message_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in sys.modules if name == "pxr" or name.startswith("pxr.")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "pxr", None)
    with pytest.raises(AssetError, match=r"pip install 'meshforge\[usd\]'"):
        read(written(tmp_path, CUP))
