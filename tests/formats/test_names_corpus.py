"""What the names in real files say of their hulls."""

from __future__ import annotations

from collections import Counter

import pytest

from meshforge.formats import read
from meshforge.labels.names.label_by_names import HullNames, match_names
from tests.corpus_path import corpus

VOCABULARY = ("door", "drawer", "handle", "knob", "top", "back", "trim", "shelf", "window", "lid", "leg", "blade")
CABINETS = "doors_cabinets"
ANSWERS: dict[str, dict[tuple[str, str], int]] = {
    # a body and a collision element are called after a drawer, and only the mesh says that it is its handle
    f"{CABINETS}/IsaacGymEnvs/sektion_cabinet_model/urdf/sektion_cabinet.urdf": {
        ("door", "hull"): 12,
        ("drawer", "hull"): 7,
        ("drawer", "mesh"): 7,
        ("handle", "mesh"): 4,
        ("handle", "shown"): 3,
        ("", ""): 7,
    },
    "knives_cutlery/object_sim/knife/object.xml": {("blade", "hull"): 1, ("handle", "hull"): 1, ("", ""): 2},
    # `trim_top` may be a top as well, of which its body is sure
    f"{CABINETS}/robocasa/cabinets/cabinet_panels/full_window.xml": {
        ("door", "hull"): 1,
        ("trim", "hull"): 3,
        ("trim", "body"): 1,
    },
    f"{CABINETS}/furniture_sim/microwave.xml": {("door", "body"): 4, ("", ""): 6},
}


@pytest.mark.parametrize("path", ANSWERS)
def test_names_say_what_hulls_are_and_by_which_kind_of_name(path: str) -> None:
    found = Counter[tuple[str, str]]()
    for geom in read(corpus(path)).geoms:
        one = match_names(HullNames(geom.name, geom.body, geom.mentions), VOCABULARY)
        found[(one.label or "", one.kind) if one else ("", "")] += 1
    assert found == ANSWERS[path]
