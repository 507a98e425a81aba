"""Laws of reading MJCF: a model is the same in however many files it lies, and where MuJoCo has it."""

import tempfile
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from tests.examples import examples
from tests.mjcf_engines import assert_as_in_mujoco, put, read

NUMBERS = st.integers(-8, 8).map(lambda k: k / 4)
POSE = st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS, NUMBERS, NUMBERS)


@st.composite
def elements(draw: st.DrawFn, depth: int = 3) -> list[str]:
    """Elements of a body, some of which stand in `<include>`s: marked by a leading and a closing `~`."""
    made = []
    for _ in range(draw(st.integers(1, 3))):
        x, y, z, a, b, c = draw(POSE)
        place = f'pos="{x} {y} {z}" euler="{a} {b} {c}"'
        kind = draw(st.sampled_from(["geom", "body", "frame", "replicate"] if depth else ["geom"]))
        if kind == "geom":
            made.append(f'<geom type="box" size="1 2 3" {place}/>')
        elif kind == "replicate":
            made.append(f'<replicate count="2" offset="{x} {y} {z}">{"".join(draw(elements(depth - 1)))}</replicate>')
        else:
            made.append(f"<{kind} {place}>{''.join(draw(elements(depth - 1)))}</{kind}>")
        if draw(st.booleans()):
            made[-1] = f"~{made[-1]}^"
    return made


def _split(text: str) -> tuple[str, dict[str, str | bytes]]:
    """The text with what is marked in include files, one in another, in folders of their own."""
    files: dict[str, str | bytes] = {}
    stack = [""]
    for letter in text:
        if letter == "~":
            stack.append("")
        elif letter == "^":
            name = f"part{len(files)}.xml" if len(files) % 2 else f"deep/part{len(files)}.xml"
            files[name] = f"<any>\n{stack.pop()}\n</any>"
            stack[-1] += f'<include file="{name}"/>'
        else:
            stack[-1] += letter
    return stack[0], files


@examples(60)
@given(elements())
def test_a_model_is_the_same_in_however_many_files_it_lies(parts: list[str]) -> None:
    text = f"<mujoco><worldbody>{''.join(parts)}</worldbody></mujoco>"
    main, files = _split(text)
    with tempfile.TemporaryDirectory() as folder:
        many = put(Path(folder), {"main.xml": main, **files})
        one = put(Path(folder), {"one.xml": text.replace("~", "").replace("^", "")}, "one.xml")
        split, whole = read(many), read(one)
        assert_as_in_mujoco(split, many)
        assert [(g.name, g.body) for g in split.geoms] == [(g.name, g.body) for g in whole.geoms]
        assert all((a.shape.vertices == b.shape.vertices).all() for a, b in zip(split.geoms, whole.geoms, strict=True))
        assert len(split.files) == len(files)
