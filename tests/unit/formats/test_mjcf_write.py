"""Edited MJCF as text: names, references, files that are included, what may not be changed, and all bytes around."""

import difflib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import output_path_of, save
from meshforge.geometry import Box, Pose, convex_hull
from meshforge.symbolic import Asset, Geom
from tests.mjcf_engines import TETRAHEDRON, model, put, read
from tests.mjcf_models import Pair, compiled, hull, replaced, write

BOX = Box(Pose(Pose.from_rpy([0, 0, 0], [0.4, -0.3, 1.2]).rotation, [0.3, -0.2, 0.7]), np.array([0.1, 0.2, 0.3]))
HULL = convex_hull(BOX.vertices * [1, 1.2, 0.8])
OBJ = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
GEOMS = '<geom size="1"/><geom size="2"/><geom size="3"/><geom size="4" contype="0" conaffinity="0"/><geom size="5"/>'


def checked(folder: Path, asset: Asset, removed: list[str], *made: Geom) -> Path:
    """The written edit, in which MuJoCo finds all but the edited hulls as before."""
    path, output = write(replaced(asset, removed, *made), folder)
    assert not output.names
    Pair(compiled(asset.path), compiled(path)).assert_same(removed=removed, made=made)
    return path


def changed_lines(before: Path, after: Path) -> list[str]:
    """The lines that were taken away (-) and added (+)."""
    one, other = (path.read_bytes().decode("latin-1").splitlines(keepends=True) for path in (before, after))
    found = difflib.unified_diff(one, other, n=0)
    return [line for line in found if line[0] in "+-" and not line.startswith(("+++", "---"))]


# names


def test_geoms_without_a_name_get_one_where_they_would_read_back_under_another(tmp_path: Path) -> None:
    asset = read(put(tmp_path / "in", {"main.xml": model(f'<body name="b">{GEOMS}</body>')}))
    path = checked(tmp_path / "out", asset, ["b/geom1"])
    assert [geom.name for geom in read(path).geoms] == ["b/geom0", "b/geom2", "b/geom4"]
    names = ["", "geom2", "geom3", "geom4"]
    assert [compiled(path).geom(k).name for k in range(4)] == names


def test_a_name_that_another_body_has_begins_with_its_own_body(tmp_path: Path) -> None:
    bodies = f'<body name="a">{GEOMS}</body><body name="b">{GEOMS}</body><body>{GEOMS}</body>'
    asset = read(put(tmp_path / "in", {"main.xml": model(bodies)}))
    on = ("a", "b", "body3")
    made = [hull(asset, f"{body}/geom1", BOX) for body in on]
    path = checked(tmp_path / "out", asset, [f"{body}/{geom}" for body in on for geom in ("geom0", "geom1")], *made)
    named = [compiled(path).geom(k).name for k in range(12)]
    assert named[:4] == ["geom1~1", "geom2", "geom3", "geom4"]
    assert named[4:8] == [f"b/{name}" for name in named[:4]]
    again = read(path)
    assert {geom.name for geom in again.geoms} == {
        f"{body}/{name}" for body in on for name in ("geom1~1", "geom2", "geom4")
    }
    third = checked(tmp_path / "again", again, ["b/geom2"], hull(again, "b/geom2", BOX))
    assert "b/geom2~1" in [geom.name for geom in read(third).geoms]


def test_a_new_name_is_none_that_the_file_uses(tmp_path: Path) -> None:
    inside = '<body name="a"><geom name="g" size="1"/></body><body name="b"><geom name="g~1" size="1"/></body>'
    asset = read(put(tmp_path / "in", {"main.xml": model(inside)}))
    path = checked(tmp_path / "out", asset, ["a/g"], hull(asset, "a/g", BOX))
    assert compiled(path).geom(0).name == "a/g~1"


def test_names_that_cannot_be_had_are_told(tmp_path: Path) -> None:
    """Copies that <replicate> makes have no name attributes of their own."""
    inside = '<body name="b"><geom size="1"/><replicate count="2" offset="1 0 0"><geom size="2"/></replicate></body>'
    asset = read(put(tmp_path / "in", {"main.xml": model(inside)}))
    path, output = write(replaced(asset, ["b/geom0"]), tmp_path / "out")
    assert output.names == {"b/geom1": "b/geom0", "b/geom2": "b/geom1"}
    assert [geom.name for geom in read(path).geoms] == ["b/geom0", "b/geom1"]


# references

REFERENCES = {
    "pair": '<contact><pair name="p" geom1="g" geom2="h"/></contact>',
    "pair2": '<contact>\n  <pair geom1="h" geom2="g"/></contact>',
    "distance": '<sensor><distance name="d" geom1="g" body2="c"/></sensor>',
    "contact": '<sensor><contact geom2="g"/></sensor>',
    "framepos": '<sensor><framepos objtype="geom" objname="g"/></sensor>',
    "reference": '<sensor><framequat objtype="body" objname="c" reftype="geom" refname="g"/></sensor>',
    "user": '<sensor><user objtype="geom" objname="g" dim="1"/></sensor>',
    "tendon": '<tendon><spatial><site site="s"/><geom geom="g" sidesite="s"/><site site="t"/></spatial></tendon>',
    "tuple": '<custom><tuple name="t"><element objtype="geom" objname="g"/></tuple></custom>',
}
REFERRED = (
    '<body name="b"><site name="s"/><joint/><geom name="g" size="1"/><geom name="k" size="1"/></body>'
    '<body name="c" pos="5 0 0"><joint/><site name="t"/><geom name="h" size="1"/></body>'
)


@pytest.mark.parametrize("kind", REFERENCES)
def test_a_geom_that_is_referred_to_cannot_be_removed(kind: str, tmp_path: Path) -> None:
    text = model(REFERRED).replace("</mujoco>", f"\n{REFERENCES[kind]}</mujoco>")
    path = put(tmp_path / "in", {"main.xml": text})
    asset = read(path)
    for made in ([], [hull(asset, "b/g", BOX)]):
        with pytest.raises(AssetError) as refused:
            write(replaced(asset, ["b/g"], *made), tmp_path / "out")
        assert refused.value.where == f"{path}:{3 if kind == 'pair2' else 2}"
        assert refused.value.problem.startswith("hull 'b/g' cannot be removed: <")
        assert refused.value.problem.endswith("> refers to its geom 'g'")
        assert "Take this element out" in str(refused.value.remedy)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("kind", REFERENCES)
def test_references_to_other_geoms_still_mean_these(kind: str, tmp_path: Path) -> None:
    text = model(REFERRED).replace("</mujoco>", f"\n{REFERENCES[kind]}</mujoco>")
    asset = read(put(tmp_path / "in", {"main.xml": text}))
    checked(tmp_path / "out", asset, ["b/k"], hull(asset, "b/k", BOX))
    first = model(REFERRED.replace('<geom name="g"', '<geom name="k2" size="1"/><geom name="g"')).replace(
        "</mujoco>", f"\n{REFERENCES[kind]}</mujoco>"
    )
    asset = read(put(tmp_path / "other", {"main.xml": first}))
    checked(tmp_path / "out2", asset, ["b/k2"])


def test_names_of_bodies_are_no_references_to_geoms(tmp_path: Path) -> None:
    inside = '<body name="g"><joint/><geom name="g" size="1"/></body><body name="c"><geom size="1"/></body>'
    text = model(inside).replace("</mujoco>", '<contact><exclude body1="g" body2="c"/></contact></mujoco>')
    asset = read(put(tmp_path / "in", {"main.xml": text}))
    checked(tmp_path / "out", asset, ["g/g"])


# what cannot be changed

FIXED = {
    "frame": (
        '<frame scale="2"><body name="b"><geom name="g" size=".1"/></body></frame>',
        "b/g",
        "inside a <frame> that scales",
    ),
    "replicate": (
        '<body name="b"><replicate count="3" offset="1 0 0"><geom name="r" size=".1"/></replicate></body>',
        "b/r1",
        "inside a <replicate>",
    ),
    "attach": ('<body name="b"><attach model="sub" body="part" prefix="x-"/></body>', "x-part/x-g", "another model"),
}


@pytest.mark.parametrize("kind", FIXED)
def test_geoms_without_an_element_of_their_own_cannot_be_changed(kind: str, tmp_path: Path) -> None:
    inside, name, why = FIXED[kind]
    files: dict[str, str | bytes] = {
        "main.xml": model(inside, '<asset><model name="sub" file="sub.xml"/></asset>'),
        "sub.xml": model('<body name="part"><geom name="g" size="1"/></body>'),
    }
    asset = read(put(tmp_path / "in", files))
    with pytest.raises(AssetError, match=f"(?s)hull '{name}' cannot be changed: .*{why}"):
        write(replaced(asset, [name]), tmp_path / "out")


def test_nothing_takes_after_a_hull_of_a_sub_model(tmp_path: Path) -> None:
    files: dict[str, str | bytes] = {
        "main.xml": model(FIXED["attach"][0], '<asset><model name="sub" file="sub.xml"/></asset>'),
        "sub.xml": model('<body name="part"><geom name="g" size="1"/></body>'),
    }
    asset = read(put(tmp_path / "in", files))
    for body, why in (("b", "takes after 'x-part/x-g', which is out of"), ("x-part", "which is out of")):
        with pytest.raises(AssetError, match=f"'{body}/new~1' .*{why} another model"):
            write(replaced(asset, [], Geom(f"{body}/new~1", body, BOX, "x-part/x-g")), tmp_path / "out")


def test_what_a_replicated_hull_adds_stands_beside_the_replicate(tmp_path: Path) -> None:
    inside = FIXED["replicate"][0].replace('size=".1"', 'size=".1" condim="4"')
    asset = read(put(tmp_path / "in", {"main.xml": model(inside)}))
    checked(tmp_path / "out", asset, [], hull(asset, "b/r1", BOX))


@pytest.mark.parametrize(
    ("inside", "parent"),
    [
        ('<replicate count="2" offset="1 0 0"><body name="b"><geom name="g" size=".1"/></body></replicate>', "b1/g1"),
        (FIXED["frame"][0], "b/g"),
    ],
)
def test_a_hull_on_a_body_that_is_replicated_or_scaled_cannot_be_made(inside: str, parent: str, tmp_path: Path) -> None:
    asset = read(put(tmp_path / "in", {"main.xml": model(inside)}))
    with pytest.raises(AssetError, match=f"'{parent}~1' is on body '.*', which is inside a <(replicate|frame)>"):
        write(replaced(asset, [], hull(asset, parent, BOX)), tmp_path / "out")


def test_a_sub_model_stays_while_other_hulls_change(tmp_path: Path) -> None:
    files: dict[str, str | bytes] = {
        "main.xml": model(
            '<body name="b"><geom name="g" size="1"/><attach model="sub" body="part" prefix="x-"/></body>',
            '<asset><model name="sub" file="parts/sub.xml"/></asset>',
        ),
        "parts/sub.xml": model(
            '<body name="part"><geom name="g" type="mesh" mesh="m"/></body>',
            '<asset><mesh name="m" file="m.obj"/></asset>',
        ),
        "parts/m.obj": OBJ,
    }
    asset = read(put(tmp_path / "in", files))
    made = hull(asset, "b/g", HULL)
    path, output = write(replaced(asset, ["b/g"], made), tmp_path / "out")
    assert sorted(output.copies) == ["parts/m.obj", "parts/sub.xml"]
    Pair(compiled(asset.path), compiled(path)).assert_same(removed=["b/g"], made=[made])


# files

PARTS = {
    "main.xml": '<mujoco>\n  <include file="parts/defaults.xml"/>\n  <worldbody>\n    <body name="b" childclass="c">\n'
    '      <include file="parts/body.xml"/>\n    </body>\n  </worldbody>\n</mujoco>\n',
    "parts/defaults.xml": "<mujocoinclude>\n  <default><default class='c'><geom condim='4'/></default></default>\n"
    '  <asset>\n    <mesh name="m" file="meshes/m.obj"/>\n  </asset>\n</mujocoinclude>\n',
    "parts/body.xml": '<mujocoinclude>\n  <!-- the seat -->\n  <geom name="g" type="mesh" mesh="m"/>\n'
    '  <geom name="h" size="1"/>\n  <include file="parts/more.xml"/>\n</mujocoinclude>\n',
    "parts/more.xml": '<mujocoinclude><geom name="i" size="2"/></mujocoinclude>\n',
    "meshes/m.obj": OBJ,
}


def test_an_edit_in_an_included_file_changes_that_file_only(tmp_path: Path) -> None:
    asset = read(put(tmp_path / "in", dict(PARTS)))
    path = checked(tmp_path / "out", asset, ["b/h", "b/i"], hull(asset, "b/i", BOX))
    assert [line[:13] for line in changed_lines(asset.path, path)] == ["+      <inert"]
    parts = tmp_path / "out" / "parts"
    (gone,) = changed_lines(tmp_path / "in/parts/body.xml", parts / "body.xml")
    assert gone == '-  <geom name="h" size="1"/>\n'
    assert (parts / "more.xml").read_text().startswith('<mujocoinclude><geom name="i~1" ')
    assert (parts / "defaults.xml").read_bytes() == (tmp_path / "in/parts/defaults.xml").read_bytes()


def test_a_made_mesh_is_an_asset_of_the_main_file_beside_the_mesh_it_replaces(tmp_path: Path) -> None:
    asset = read(put(tmp_path / "in", dict(PARTS)))
    path = checked(tmp_path / "out", asset, ["b/g"], hull(asset, "b/g", HULL))
    added = [line for line in changed_lines(asset.path, path) if "inertial" not in line]
    assert added == ["+  <asset>\n", '+    <mesh name="main--b_g_1" file="meshes/main--b_g_1.obj"/>\n', "+  </asset>\n"]
    assert (tmp_path / "out/meshes/main--b_g_1.obj").is_file()
    _, put_in = changed_lines(tmp_path / "in/parts/body.xml", tmp_path / "out/parts/body.xml")
    assert put_in == '+  <geom name="g~1" type="mesh" mesh="main--b_g_1"/>\n'


DIRECTORIES = {
    "meshdir": ('meshdir="meshes"', "m.obj", "meshes/m.obj", "main--b_g_1.obj", "meshes/main--b_g_1.obj"),
    "assetdir": ('assetdir="a/"', "b/m.obj", "a/b/m.obj", "b/main--b_g_1.obj", "a/b/main--b_g_1.obj"),
    "strippath": ('meshdir="k" strippath="true"', "x/y/m.obj", "k/m.obj", "main--b_g_1.obj", "k/main--b_g_1.obj"),
    "none": ("", "m.obj", "m.obj", "main--b_g_1.obj", "main--b_g_1.obj"),
    "outside": ('meshdir="../shared"', "m.obj", "../shared/m.obj", "../in/main--b_g_1.obj", "main--b_g_1.obj"),
    "outside by its path": ("", "../shared/m.obj", "../shared/m.obj", "main--b_g_1.obj", "main--b_g_1.obj"),
    "around": ('meshdir=".."', "../x/in/m.obj", "m.obj", "../x/in/main--b_g_1.obj", "main--b_g_1.obj"),
}


@pytest.mark.parametrize("kind", DIRECTORIES)
def test_made_meshes_are_found_under_every_setting_of_folders(kind: str, tmp_path: Path) -> None:
    setting, reference, file, made_reference, made_file = DIRECTORIES[kind]
    before = f'<compiler {setting}/><asset><mesh name="m" file="{reference}"/></asset>'
    text = model(
        '<body name="b"><geom name="g" type="mesh" mesh="m"/><geom name="h" type="mesh" mesh="m"/></body>', before
    )
    asset = read(put(tmp_path / "x/in", {"main.xml": text, file: OBJ}))
    made = hull(asset, "b/g", HULL)
    edit = replaced(asset, ["b/g"], made)
    target = output_path_of(edit, asset.path.parent, tmp_path / "out")
    saved = save(edit, target)
    assert (target == tmp_path / "out/main.xml") == (kind in ("none", "meshdir", "assetdir", "strippath"))
    assert all(file.is_relative_to(tmp_path / "out") for file in saved.files)
    Pair(compiled(asset.path), compiled(target)).assert_same(removed=["b/g"], made=[made])
    assert f'file="{made_reference}"' in target.read_text()
    assert (target.parent / made_file).is_file()


def test_absolute_folders_of_meshes_get_the_hull_in_the_text(tmp_path: Path) -> None:
    meshes = put(tmp_path / "meshes", {"m.obj": OBJ}, "m.obj").parent
    before = f'<compiler meshdir="{meshes}"/><asset><mesh name="m" file="m.obj"/></asset>'
    text = model('<body name="b"><geom name="g" type="mesh" mesh="m"/><geom type="mesh" mesh="m"/></body>', before)
    asset = read(put(tmp_path / "in", {"main.xml": text}))
    made = hull(asset, "b/g", HULL)
    path, output = write(replaced(asset, ["b/g"], made), tmp_path / "out")
    Pair(compiled(asset.path), compiled(path)).assert_same(removed=["b/g"], made=[made])
    assert not output.made and not output.copies
    assert output.notes == ("'m.obj' is an absolute reference: the file is used where it is, not copied",)


def test_files_at_absolute_paths_stay_where_they_are(tmp_path: Path) -> None:
    far = put(tmp_path / "far", {"part.xml": f"<mujocoinclude>{GEOMS}</mujocoinclude>", "m.obj": OBJ}, "part.xml")
    before = f'<asset><mesh name="m" file="{far.parent / "m.obj"}"/></asset>'
    inside = f'<body name="b"><include file="{far}"/></body><body name="c"><geom name="g" type="mesh" mesh="m"/></body>'
    asset = read(put(tmp_path / "in", {"main.xml": model(inside, before)}))
    made = hull(asset, "c/g", BOX)
    path, output = write(replaced(asset, ["c/g"], made), tmp_path / "out")
    Pair(compiled(asset.path), compiled(path)).assert_same(removed=["c/g"], made=[made])
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["main.xml"]
    assert len(output.notes) == 2 and all("is an absolute reference" in note for note in output.notes)
    with pytest.raises(AssetError, match=r"(?s)the edit is in '.*part.xml', which is included by an absolute path"):
        write(replaced(asset, ["b/geom0"]), tmp_path / "out")


def test_an_unedited_model_takes_all_its_files_along(tmp_path: Path) -> None:
    files: dict[str, str | bytes] = {**PARTS, "height.bin": b"\2\0\0\0\2\0\0\0" + b"\0\0\x80\x3f" * 4}
    files["main.xml"] = PARTS["main.xml"].replace(
        "<worldbody>", '<asset><hfield name="h" file="height.bin" size="1 1 1 1"/></asset><worldbody>'
    )
    asset = read(put(tmp_path / "in", files))
    saved = save(asset, tmp_path / "out" / "main.xml")
    assert sorted(path.relative_to(tmp_path / "out").as_posix() for path in saved.files) == sorted(files)
    assert all((tmp_path / "out" / name).read_bytes() == (tmp_path / "in" / name).read_bytes() for name in files)


# the text around

ODD = {
    "line ends of Windows": lambda text: text.replace(b"\n", b"\r\n"),
    "Latin letters": lambda text: b'<?xml version="1.0" encoding="latin-1"?>\n' + text.replace("ö".encode(), b"\xf6"),
    "a byte order mark": lambda text: b"\xef\xbb\xbf" + text,
    "a declaration": lambda text: b"<?xml version='1.0'?>\n" + text,
    "tabs": lambda text: text.replace(b"\n  ", b"\n\t"),
}
AROUND = """<mujoco>
  <!-- Stühle -->
  <worldbody>
    <body name='b'   pos = "1 0 0" >
      <geom name="g"   size='1'  rgba="1 0 0 1"/>  <!-- of wood -->
      <geom name="h" size="2"
            condim="4"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
    </body>
  </worldbody>
</mujoco>"""


@pytest.mark.parametrize("kind", ODD)
def test_only_lines_of_edited_geoms_change(kind: str, tmp_path: Path) -> None:
    change: Callable[[bytes], bytes] = ODD[kind]
    path = put(tmp_path / "in", {"main.xml": change(AROUND.replace("ü", "ö").encode())})
    asset = read(path)
    out = checked(tmp_path / "out", asset, ["b/g"], hull(asset, "b/g", Box(BOX.pose, np.array([1, 2, 3]))))
    old, new = changed_lines(path, out)
    assert old[1:].strip() == """<geom name="g"   size='1'  rgba="1 0 0 1"/>  <!-- of wood -->"""
    assert new[1 : new.index(" type=")] == old[1 : old.index("/>")].replace('"g"', '"g~1"').replace("'1'", "'1 2 3'")
    assert new[new.index("/>") :] == old[old.index("/>") :]
    gone = checked(tmp_path / "gone", asset, ["b/h"])
    assert [line[0] for line in changed_lines(path, gone)] == ["-", "-"]


# refused files


def test_a_file_that_mujoco_refuses_is_edited_in_its_own_text(tmp_path: Path) -> None:
    inside = f'<body name="b"><geom name="g" size="1"/><geom name="h" size="1"/><region x="1"/></body>{TETRAHEDRON}'
    text = f"<mujoco>\n<worldbody>\n{inside}\n</worldbody>\n</mujoco>"
    asset = read(put(tmp_path / "in", {"main.xml": text}))
    path, _ = write(replaced(asset, ["b/g"], hull(asset, "b/g", HULL)), tmp_path / "out")
    again = read(path)
    assert [geom.name for geom in again.geoms] == ["b/g~1", "b/h"]
    assert b'<region x="1"/>' in path.read_bytes()
    assert b"<inertial " in path.read_bytes()
