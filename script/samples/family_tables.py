"""Tables to eat at, to serve on and to stand beside a chair: none to two drawers."""

from __future__ import annotations

import numpy as np

from script.samples import drawers, extras, legs, tops
from script.samples.layout import corners, legs_at, outward, ring, row
from script.samples.legs import leg
from script.samples.recipes import BLOCK, CHUNKS, COARSE, FINE, FINEST, MEDIUM, PLUGGED, UNMERGED, coacd
from script.samples.table import Table, join_parts


def kitchen_table() -> Table:
    """Boards on turned legs, one drawer."""
    rng = np.random.default_rng(1)
    return Table(
        "table_01",
        "kitchen table, boarded top, turned legs, one drawer",
        join_parts(
            tops.boards(1.2, 0.76, 0.74, 0.03, 4, 0.008, 0.02),
            legs_at(corners(1.04, 0.6), lambda x, y: legs.lathe(0.712, 0.085)),
            row(1, 0, (0.46, 0.44, 0.13), drawers.knob, 0.33, 0.54, pulled=(0.24,)),
            extras.mug(0.3, 0.15, 0.74, 30),
            extras.book(-0.2, -0.1, 0.74, -15),
            extras.crumbs([(0.2, 0.1, 0.03), (-0.3, -0.1, 0.03), (0.0, 0.2, 0.25)], 0.05, rng),
        ),
        (0, 0, 33),
        MEDIUM,
        {"drawer": BLOCK, "handle": BLOCK, "misc": CHUNKS},
    )


def side_table() -> Table:
    """Three curved legs, no drawer, a carrying grip."""
    rng = np.random.default_rng(2)
    return Table(
        "table_02",
        "side table, pierced top, three curved legs, a carrying grip, no drawer",
        join_parts(
            tops.pierce_top(0.62, 0.5, 0.56, 0.026, 0.06, [(-0.2, 0.0), (0.2, 0.0)]),
            legs_at(ring(3, 0.17), lambda x, y: legs.sabre(0.54, 0.055, 0.1, outward(x, y))),
            extras.grip("grip", 0, -0.25, 0.547, 0.2, 0.045),
            extras.mug(0.05, 0.1, 0.56, 200),
            extras.crumbs([(0.05, 0.0, 0.02), (-0.12, -0.1, 0.04)], 0.04, rng),
        ),
        (0, 0, -20),
        UNMERGED,
        {"misc": CHUNKS, "grip": COARSE, "leg": coacd(0.02, seed=1)},
    )


def refectory() -> Table:
    """Two trestles, no drawer; its file has Y up."""
    rng = np.random.default_rng(4)
    return Table(
        "table_04",
        "refectory table on two trestles, waisted top, no drawer, y up",
        join_parts(
            tops.waist_top(2.1, 0.85, 0.76, 0.04, 0.06),
            [leg(f"trestle_{k + 1}", legs.lyre(0.724, 0.6, 0.05)).move(x=x) for k, x in enumerate((-0.75, 0.75))],
            extras.bowl(0.1, 0.05, 0.76),
            extras.book(-0.6, 0.1, 0.76, 50),
            extras.offcut(0.2, 0.1, -30, (0.4, 0.06, 0.04)),
            extras.crumbs([(-0.2, -0.1, 0.03), (0.5, 0.05, 0.3), (-0.45, 0.2, 0.02)], 0.06, rng),
        ),
        (-90, 0, 0),
        FINE,
        {"misc": CHUNKS, "top": FINEST},
    )


def drum_table() -> Table:
    """One stout column, a soft square top, a drawer on either side."""
    rng = np.random.default_rng(6)
    return Table(
        "table_06",
        "drum table, top of four quarters, one column, two drawers back to back",
        join_parts(
            tops.quarter_top(1.0, 1.0, 0.74, 0.035, 0.006),
            [leg("column", legs.drum(0.708, 0.18))],
            row(1, 0, (0.42, 0.22, 0.1), drawers.knob, 0.45, 0.565, pulled=(0.08,)),
            row(1, 0, (0.42, 0.22, 0.1), drawers.knob, 0.45, 0.565, turn=180, first=2),
            extras.bowl(0.2, 0.15, 0.74),
            extras.crumbs([(0.3, 0.1, 0.02), (-0.3, -0.2, 0.03), (-0.32, 0.2, 0.2)], 0.05, rng),
        ),
        (0, 0, 30),
        COARSE,
        {"leg": MEDIUM, "drawer": PLUGGED, "handle": BLOCK, "misc": BLOCK},
    )


def coffee_table() -> Table:
    """Low, splayed legs, a slatted shelf, one wide drawer; its file leans."""
    rng = np.random.default_rng(10)
    slats = [tops.shelf(0.86, 0.09, 0.13, 0.016, f"slat_{k + 1}").move(y=(k - 1.5) * 0.11) for k in range(4)]
    return Table(
        "table_10",
        "coffee table, waisted top, splayed legs, slatted shelf, a wide drawer, leaning",
        join_parts(
            tops.waist_top(1.1, 0.65, 0.44, 0.028, 0.035),
            slats,
            legs_at(
                corners(0.9, 0.46),
                lambda x, y: legs.splay_leg(0.415, 0.055, (0.06 * np.sign(x), 0.05 * np.sign(y), 0), 6, 0.02),
            ),
            row(1, 0, (0.62, 0.42, 0.085), drawers.cup, 0.28, 0.305, pulled=(0.2,)),
            extras.book(0.25, 0.1, 0.44, 12),
            extras.book(0.24, 0.09, 0.4711, 30, (0.18, 0.13, 0.022)).rename("book_2"),
            extras.mug(-0.2, -0.1, 0.44, 75),
            extras.crumbs([(0.1, 0.05, 0.17), (-0.25, 0.0, 0.03)], 0.035, rng),
        ),
        (16, -12, 55),
        MEDIUM,
        {"drawer": COARSE, "handle": BLOCK, "misc": BLOCK, "top": FINEST},
    )


def night_table() -> Table:
    """Small, a drawer under the top and one on the shelf."""
    rng = np.random.default_rng(11)
    return Table(
        "table_11",
        "night table, notched top, curved legs, a drawer under the top and one on the shelf",
        join_parts(
            tops.notch_top(0.52, 0.44, 0.62, 0.022, (0.1, 0.03)),
            tops.shelf(0.4, 0.33, 0.2, 0.016),
            legs_at(corners(0.42, 0.34), lambda x, y: legs.sabre(0.602, 0.045, 0.05, outward(x, y), 4)),
            row(1, 0, (0.32, 0.32, 0.11), drawers.knob, 0.19, 0.472, pulled=(0.14,)),
            row(1, 0, (0.32, 0.3, 0.13), drawers.knob, 0.17, 0.218, first=2),
            extras.mug(0.1, 0.05, 0.62, 10),
            extras.crumbs([(-0.1, 0.05, 0.02), (0.05, 0.0, 0.4)], 0.035, rng),
        ),
        (0, 0, 70),
        FINE,
        {"drawer": BLOCK, "handle": BLOCK, "misc": BLOCK},
    )


def serving_table() -> Table:
    """Two upright boards for legs, two shelves, a rail at each end."""
    rng = np.random.default_rng(12)
    return Table(
        "table_12",
        "serving table on two boards, two shelves, rails at both ends, one drawer",
        join_parts(
            tops.rim_top(0.95, 0.5, 0.82, 0.02, 0.035, 0.015),
            tops.shelf(0.74, 0.4, 0.2),
            tops.shelf(0.74, 0.4, 0.45, 0.018, "shelf_2"),
            [leg(f"board_{k + 1}", legs.slab(0.79, 0.4, 0.04)).move(x=x) for k, x in enumerate((-0.38, 0.38))],
            row(1, 0, (0.6, 0.38, 0.1), drawers.rod, 0.22, 0.667, pulled=(0.15,)),
            extras.towel_bar("rail_1", 0.475, 0, 0.8, 0.36, 0.05, 90),
            extras.towel_bar("rail_2", -0.475, 0, 0.8, 0.36, 0.05, 270),
            extras.bowl(-0.15, 0.0, 0.82),
            extras.mug(0.15, 0.05, 0.46, 120),
            extras.crumbs([(0.1, 0.0, 0.02), (-0.2, 0.08, 0.25)], 0.04, rng),
        ),
        (0, 0, -17),
        FINE,
        {"drawer": CHUNKS, "drawer_1_handle": BLOCK, "handle": COARSE, "misc": CHUNKS},
    )


def double_pedestal() -> Table:
    """Two columns, two drawers between them; upside down in its file."""
    rng = np.random.default_rng(13)
    return Table(
        "table_13",
        "double pedestal table, pierced top, two columns, two drawers, upside down",
        join_parts(
            tops.pierce_top(1.9, 0.9, 0.76, 0.035, 0.08, [(-0.35, 0.0), (0.35, 0.0)]),
            [leg(f"column_{k + 1}", legs.drum(0.728, 0.16)).move(x=x) for k, x in enumerate((-0.65, 0.65))],
            row(2, 0.05, (0.4, 0.5, 0.12), drawers.cup, 0.4, 0.58, pulled=(0.26, 0.0)),
            extras.cable([(0.0, 0.1, 0.4), (0.02, 0.12, 0.2), (0.1, 0.15, 0.02), (0.25, 0.1, 0.012)]),
            extras.lamp(-0.6, 0.2, 0.76, -40),
            extras.crumbs([(0.2, -0.1, 0.02), (-0.2, 0.1, 0.02)], 0.06, rng),
        ),
        (180, 0, 200),
        FINE,
        {"drawer": PLUGGED, "handle": BLOCK, "misc": COARSE},
    )


TABLES = (
    kitchen_table, side_table, refectory, drum_table, coffee_table, night_table, serving_table, double_pedestal,
)  # fmt: skip
