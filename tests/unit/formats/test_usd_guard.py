"""What is looked at before the library sees a layer: nothing that it wrote itself is refused, what would harm it is."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import AssetError
from meshforge.formats.usd.crate import CRATE_MARK
from meshforge.formats.usd.crate_values import Allowance, CrateBytes
from meshforge.formats.usd.guard import refuse_harmful
from tests import usd_crates as crates

_EVERYTHING = """
import sys
from pxr import Gf, Sdf, Ts, Usd, Vt
out, version = sys.argv[1:]
new = version == "new"
stage = Usd.Stage.CreateInMemory()
layer = stage.GetRootLayer()
prim, mesh = stage.DefinePrim("/A", "Xform"), stage.DefinePrim("/A/B", "Mesh")
stage.DefinePrim("/C")
for name in sorted(dir(Sdf.ValueTypeNames)):
    kind = getattr(Sdf.ValueTypeNames, name)
    usual = not name.startswith(("Duration", "PathExpression", "TimeCode"))
    held = isinstance(kind, Sdf.ValueTypeName) and kind.defaultValue is not None and name not in ("Opaque", "Group")
    if held and (new or usual):
        value = kind.defaultValue
        if kind.isArray:
            value = type(value)([kind.scalarType.defaultValue] * 40)
        attribute = prim.CreateAttribute("of:" + name, kind)
        for time in (Usd.TimeCode.Default(), 1.0, 2.0):
            attribute.Set(value, time)
for name in ("Int", "UInt", "Int64", "UInt64", "Half", "Float", "Double"):
    attribute = mesh.CreateAttribute("many:" + name, getattr(Sdf.ValueTypeNames, name + "Array"))
    real = name in ("Half", "Float", "Double")
    attribute.Set([k * k % 997 for k in range(3000)])
    attribute.Set([k % 3 + 0.5 * real for k in range(3000)] if real else [k % 3 for k in range(3000)], 1.0)
    attribute.Set([7] * 100000, 2.0)
    attribute.Set([k * 0.37 for k in range(3000)] if real else [2 ** (k % 31) for k in range(3000)], 3.0)
prim.SetCustomData({"x": {"y": {"z": [1, 2, 3], "s": "t"}}, "many": Vt.FloatArray([1.0] * 50)})
of = {"customData": {"k": {"q": 1}}}
prim.GetReferences().SetReferences([Sdf.Reference("", "/C", **of), Sdf.Reference("", "/C", Sdf.LayerOffset(3), **of)])
if version >= "0.8.0":
    mesh.GetPayloads().AddInternalPayload("/C")
chosen = prim.GetVariantSets().AddVariantSet("v")
chosen.AddVariant("one"), chosen.AddVariant("two"), chosen.SetVariantSelection("one")
prim.GetInherits().AddInherit("/C"), prim.GetSpecializes().AddSpecialize("/C"), prim.AddAppliedSchema("FooAPI")
prim.CreateRelationship("rel").SetTargets(["/A/B", "/C"])
mesh.GetAttribute("many:Int").AddConnection("/A.of:Int")
layer.customLayerData = {"deep": {"er": {"est": 1}}}
if new:
    layer.relocates = [("/A/B2", "/A/B3")]
    knot = Ts.Knot("double", time=1.0, value=2.0)
    knot.SetCustomData({"a": {"b": 1}})
    spline = Ts.Spline("double")
    spline.SetKnot(knot)
    prim.CreateAttribute("spline", Sdf.ValueTypeNames.Double).SetSpline(spline)
assert layer.Export(out)
"""
BEFORE = ("0.4.0", "0.5.0", "0.6.0", "0.7.0", "0.8.0")


@pytest.mark.slow
@pytest.mark.parametrize("version", [*BEFORE, "new"])
def test_all_kinds_of_values_that_the_library_writes_pass(tmp_path: Path, version: str) -> None:
    made = tmp_path / "made.usdc"
    env = os.environ | ({"USD_WRITE_NEW_USDC_FILES_AS_VERSION": version} if version in BEFORE else {})
    command = [sys.executable, "-c", _EVERYTHING, str(made), version]
    subprocess.run(command, env=env, check=True, capture_output=True)
    data = made.read_bytes()
    assert data.startswith(CRATE_MARK)
    if version in BEFORE:
        assert ".".join(map(str, data[8:11])) == version
    refuse_harmful(data, "made.usdc")


@given(st.lists(st.integers(-(2**31), 2**31 - 1) | st.integers(-300, 300), max_size=70))
def test_integers_are_those_that_were_coded(numbers: list[int]) -> None:
    coded = crates.integers(numbers)
    assert CrateBytes(coded, 0, Allowance(len(coded))).read_integers(len(numbers)).tolist() == numbers


def test_a_layer_made_by_hand_is_one_that_the_library_reads(tmp_path: Path) -> None:
    from pxr import Usd

    made = tmp_path / "made.usdc"
    made.write_bytes(crates.nested(30))
    stage = Usd.Stage.Open(str(made))
    assert [str(prim.GetPath()) for prim in stage.TraverseAll()][-1] == "/a" * 30
    held = tmp_path / "held.usdc"
    held.write_bytes(crates.array(crates.INT, 20, crates.integers(range(20)), crates.PACKED))
    stage = Usd.Stage.Open(str(held))
    assert list(stage.GetPrimAtPath("/a").GetCustomData()["a"]) == list(range(20))


@pytest.mark.parametrize(
    ("make", "most"), [(crates.nested, 1000), (crates.dictionaries, 1000)], ids=["prims", "dictionaries"]
)
def test_a_thousand_deep_is_read_and_more_is_not(make: Callable[[int], bytes], most: int) -> None:
    refuse_harmful(make(most), "deep")
    with pytest.raises(AssetError, match="nested more than 1000 deep"):
        refuse_harmful(make(most + 1), "deeper")


def test_a_tree_of_branches_is_read() -> None:
    refuse_harmful(crates.crate([-1, 2, -2, 3, 0, -2, -2]), "branches")


@given(st.integers(0, 40), st.sampled_from((0, crates.PACKED)))
def test_an_array_is_as_long_as_its_bytes(more: int, flags: int) -> None:
    """Twenty numbers, of which it says that they are more."""
    content = crates.integers(range(20)) if flags else bytes(80)
    refuse_harmful(crates.array(crates.INT, 20, content, flags), "as long")
    said = 20 + (more + 1) * 100_000
    with pytest.raises(AssetError, match="damaged or cut off"):
        refuse_harmful(crates.array(crates.INT, said, content, flags), "longer")


@given(st.binary(max_size=40), st.integers(0, 2_000))
def test_bytes_changed_anywhere_are_read_or_refused(new: bytes, at: int) -> None:
    data = crates.dictionaries(8)
    at %= len(data)
    try:
        refuse_harmful(data[:at] + new + data[at + len(new) :], "changed")
    except AssetError as error:
        assert error.remedy
