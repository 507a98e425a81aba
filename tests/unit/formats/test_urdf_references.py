"""References to mesh files: where they lead, what is said when they lead nowhere, what must go along. The XML of a
URDF: read as engines read it, hardened, with places that can be edited."""

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import AssetError
from meshforge.formats.references import find_companions
from meshforge.formats.xml import Element, XmlText, parse_xml
from tests.examples import examples
from tests.urdf_sample import SAMPLE, THREE, link, put, read, robot, sample, write


def _tree(tmp_path: Path, reference: str) -> Path:
    """`pkg/urdf/cart.urdf` with a link that refers to a mesh, and `pkg/meshes/three.obj`."""
    path = sample(tmp_path / "pkg" / "urdf", robot(link(f'<mesh filename="{reference}"/>')))
    (tmp_path / "pkg" / "meshes").mkdir()
    (tmp_path / "pkg" / "meshes" / "three.obj").write_text(THREE)
    return path


@pytest.mark.parametrize(
    ("reference", "place"),
    [
        ("package://pkg/meshes/three.obj", "pkg/meshes/three.obj"),
        ("model://pkg/meshes/three.obj", "pkg/meshes/three.obj"),
        ("../meshes/three.obj", "../meshes/three.obj"),
        (" meshes/./three.obj ", "meshes/three.obj"),
        ("meshes\\three.obj", "meshes/three.obj"),
    ],
)
def test_a_reference_is_found_and_found_again_in_the_output(reference: str, place: str, tmp_path: Path) -> None:
    asset = read(_tree(tmp_path, reference))
    assert len(asset.geoms) == 3
    output = write(asset)
    assert list(output.copies) == [place]
    again = read(put(output, tmp_path / "out" / "deep" / "cart.urdf"))
    assert len(again.geoms) == 3
    assert str(tmp_path / "out") in str(again.files[0])


@pytest.mark.parametrize("form", ["{}", "file://{}", "file:{}", "file://localhost{}"])
def test_an_absolute_reference_stays_where_it_is_with_a_note(form: str, tmp_path: Path) -> None:
    reference = form.format(tmp_path / "pkg" / "meshes" / "three.obj")
    asset = read(_tree(tmp_path, reference))
    assert len(asset.geoms) == 3
    output = write(asset)
    assert output.copies == {}
    assert "is an absolute reference: the file is used where it is, not copied" in output.notes[0]


def test_a_package_is_found_in_given_roots_which_come_first(tmp_path: Path) -> None:
    path = _tree(tmp_path, "package://other/three.obj")
    (tmp_path / "roots" / "other").mkdir(parents=True)
    mesh = tmp_path / "roots" / "other" / "three.obj"
    mesh.write_text(THREE)
    for root in (tmp_path / "roots", tmp_path / "roots" / "other"):
        asset = read(path, root)
        assert asset.files == (mesh,)
        assert write(asset).copies == {"other/three.obj": mesh}


def test_a_folder_is_a_package_of_the_name_in_its_package_xml(tmp_path: Path) -> None:
    path = _tree(tmp_path, "package://cart_description/meshes/three.obj")
    (tmp_path / "pkg" / "package.xml").write_text("<package><name> cart_description </name></package>")
    assert read(path).files == (tmp_path / "pkg" / "meshes" / "three.obj",)


def test_files_are_the_meshes_with_their_materials_and_textures(tmp_path: Path) -> None:
    path = sample(tmp_path, robot(link('<mesh filename="meshes/three.obj"/>'),
                                  '<material name="m"><texture filename="wood.png"/></material>'))  # fmt: skip
    meshes = tmp_path / "meshes"
    (meshes / "three.obj").write_text("mtllib three.mtl\nmtllib gone.mtl\n" + THREE)
    maps = "newmtl m\nmap_Kd -s 1 1 1 skins/oak.png\nmap_Bump  old oak.png\nmap_Ks gone.png\n"
    (meshes / "three.mtl").write_text(maps)
    (meshes / "skins").mkdir()
    for image in (meshes / "skins" / "oak.png", meshes / "old oak.png", tmp_path / "wood.png"):
        image.write_bytes(b"png")
    names = ["three.obj", "three.mtl", "skins/oak.png", "old oak.png"]
    asset = read(path)
    assert asset.files == (*(meshes / name for name in names), tmp_path / "wood.png")
    assert list(write(asset).copies) == [*(f"meshes/{name}" for name in names), "wood.png"]


def test_companions_of_collada_and_gltf_are_their_images_and_buffers(tmp_path: Path) -> None:
    for name in ("a b.png", "c.bin", "d.png"):
        (tmp_path / name).write_bytes(b"x")
    (tmp_path / "m.dae").write_text("<init_from>a%20b.png</init_from><init_from><ref>file://d.png</ref></init_from>")
    uris = '{"buffers": [{"uri": "c.bin"}, {}], "images": [{"uri": "a%20b.png"}, {"uri": "data:,x"}, {"uri": "gone"}]}'
    (tmp_path / "m.gltf").write_text(uris)
    chunk = uris.encode()
    (tmp_path / "m.glb").write_bytes(b"glTF" + b"\0" * 8 + len(chunk).to_bytes(4, "little") + b"JSON" + chunk + b"BIN")
    (tmp_path / "broken.gltf").write_text("[1, 2")
    (tmp_path / "list.gltf").write_text("[1, 2]")
    assert list(find_companions(tmp_path / "m.dae")) == ["a b.png", "d.png"]
    assert list(find_companions(tmp_path / "m.gltf")) == ["c.bin", "a b.png"]
    assert list(find_companions(tmp_path / "m.glb")) == ["c.bin", "a b.png"]
    assert all(find_companions(tmp_path / name) == {} for name in ("broken.gltf", "list.gltf", "none.obj", "c.bin"))


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
