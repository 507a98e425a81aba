"""The XML of a URDF: read as engines read it, hardened, with places that can be edited."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import AssetError
from meshforge.formats.xml import Element, XmlText, parse_xml
from tests.examples import examples
from tests.urdf_sample import SAMPLE, read, sample


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
