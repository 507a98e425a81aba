"""Hulls that share one shape object are hulls of their own in the contact graph."""

from __future__ import annotations

from dataclasses import replace

from tests.unit.language.scenes import box, hull, mesh


def test_hulls_that_share_a_shape_keep_their_contacts_in_an_edited_mesh() -> None:
    shape = box([0, 0, 0], [1, 1, 1])
    scene = mesh(hull("a", shape), hull("b", shape), hull("c", box([1, 0, 0], [2, 1, 1])))
    fixed = replace(scene, scale=scene.diagonal)
    assert fixed.contacts == {(0, 1), (0, 2), (1, 2)} == fixed.with_hulls(fixed.hulls).contacts
    assert fixed.with_hulls(fixed.hulls[1:]).contacts == {(0, 1)}
