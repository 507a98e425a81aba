"""The XML of a URDF: read as engines read it, hardened, with places that can be edited."""

from __future__ import annotations

import codecs
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import AssetError
from meshforge.formats.xml import Element, XmlText, parse_xml
from tests.examples import examples
from tests.urdf_sample import SAMPLE, link, read, robot, sample, write

BOX = link('<box size="1 1 1"/>')


@pytest.mark.parametrize(
    "raw",
    [
        b'<?xml version="0.0" ?>\n' + robot(BOX).encode(),
        b"\n  \t" + b'<?xml version="1.0"?>' + robot(BOX).encode(),
        codecs.BOM_UTF8 + b'<?xml version="1.0"?>' + robot(BOX).encode(),
        b'<?xml version="1.0" encoding="utf-16"?>' + robot(BOX).encode(),
        b'<?xml version="1.0" encoding="no-such-thing"?>' + robot(BOX).encode(),
        codecs.BOM_UTF16_LE + ('<?xml version="1.0" encoding="utf-16"?>' + robot(BOX)).encode("utf-16-le"),
        codecs.BOM_UTF16_BE + robot("<!-- 90° -->", BOX).encode("utf-16-be"),
        b'<?xml version="1.0" encoding="ISO-8859-1"?>' + robot("<!-- 90° -->", BOX).encode("latin-1"),
        robot("<!-- 90° -->", BOX).encode("latin-1"),
        b"<!DOCTYPE robot>\n" + robot("<!-- a -- b --->", BOX).encode(),
        b'<!DOCTYPE robot SYSTEM "urdf.dtd">\n' + robot(BOX).encode(),
        robot(BOX).replace("\n", "\r\n").encode(),
        robot("<![CDATA[ <link name='no'/> <!-- ]]>", BOX).encode(),
    ],
)
def test_files_that_engines_accept_are_read_and_come_back_byte_for_byte(raw: bytes, tmp_path: Path) -> None:
    path = tmp_path / "odd.urdf"
    path.write_bytes(raw)
    asset = read(path)
    assert [g.name for g in asset.geoms] == ["a/geom0"]
    assert write(asset).main == raw


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('<!DOCTYPE r [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><robot name="&b;"/>', "declares XML entities"),
        ('<!DOCTYPE r [<!ENTITY a SYSTEM "file:///etc/passwd">]><robot>&a;</robot>', "declares XML entities"),
        ('<!DOCTYPE r [<!ENTITY % a SYSTEM "http://x/y.dtd"> %a;]><robot/>', "declares XML entities"),
        ('<!DOCTYPE r SYSTEM "http://x/y.dtd">\n<robot name="&a;"/>', "odd.urdf:2: is not well-formed XML: undefined"),
        ("<robot>\n<link name='a'>\n</robot>", "odd.urdf:3: is not well-formed XML: mismatched tag"),
        ("<robot><!-- no end", "is not well-formed XML"),
        ("", "the file is empty"),
        ("  \n", "the file is empty"),
        ("<mujoco>\n</mujoco>", "its root element is <mujoco>, not <robot>"),
        ("\x00\x01\x02", "is not well-formed XML"),
    ],
)
def test_what_is_no_urdf_or_an_attack_is_refused_with_its_place(text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "odd.urdf"
    path.write_text(text)
    with pytest.raises(AssetError) as error:
        read(path)
    assert said in str(error.value)
    assert "odd.urdf" in str(error.value)


def test_a_folder_or_a_missing_file_is_an_asset_error(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "none.urdf"):
        with pytest.raises(AssetError, match="cannot be read"):
            read(path)


def test_ten_thousand_nested_elements_are_read(tmp_path: Path) -> None:
    deep = "<gazebo>" * 10_000 + "</gazebo>" * 10_000
    assert len(read(sample(tmp_path, robot(deep, BOX))).geoms) == 1


def test_many_comments_without_an_end_are_refused_at_once(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match="not well-formed"):
        read(sample(tmp_path, "<robot>" + "<!--" * 200_000))


def _shape(element: Element) -> object:
    return element.tag, element.attributes, [_shape(child) for child in element.children]


def _reference(element: ET.Element) -> object:
    return element.tag, element.attrib, [_reference(child) for child in element]


def test_the_tree_of_the_sample_is_that_of_a_plain_xml_reader() -> None:
    plain = SAMPLE.replace(" -- by", " by").replace(' xmlns:drake="http://drake.mit.edu"', "").replace("drake:", "")
    assert _shape(parse_xml(plain.encode(), "x")) == _reference(ET.fromstring(plain))


BLANK = st.sampled_from(["", " ", "\n", "\r\n\t", "<!-- <b> -- ' \" -->", "<?pi > ?>", "text é"])
SPACE = st.sampled_from([" ", "\n", " \t"])
VALUE = st.text(st.sampled_from("aé/>='\" &\n"), max_size=5)


@st.composite
def element_text(draw: st.DrawFn, depth: int = 3) -> str:
    """Well-formed XML with every kind of quotes and blanks, and with `>` and `/>` inside values."""
    tag = draw(st.sampled_from(["a", "bé", "collision", "x:y"]))
    head = "<" + tag
    for name in draw(st.lists(st.sampled_from(["name", "k", "é:k"]), unique=True, max_size=3)):
        quote = draw(st.sampled_from("\"'"))
        value = draw(VALUE).replace("&", "&amp;").replace("<", "&lt;").replace(quote, f"&#{ord(quote)};")
        head += draw(SPACE) + name + draw(st.sampled_from(["", " "])) + "=" + quote + value + quote
    head += draw(st.sampled_from(["", " ", "\n"]))
    children = draw(st.lists(element_text(depth - 1), max_size=3)) if depth else []
    if not children and draw(st.booleans()):
        return head + "/>"
    inside = "".join(draw(BLANK) + child for child in children) + draw(BLANK)
    return f"{head}>{inside}</{tag}{draw(SPACE)}>"


@examples(150)
@given(element_text())
def test_the_place_of_every_element_is_exactly_its_text(text: str) -> None:
    data = XmlText.of(text.encode()).data
    for element in parse_xml(data, "x").walk():
        alone = parse_xml(data[element.start : element.end], "x")
        assert _shape(alone) == _shape(element)
        assert (alone.start, alone.end) == (0, element.end - element.start)
        assert alone.inside == element.inside - element.start
