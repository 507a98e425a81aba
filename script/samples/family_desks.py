"""Desks, benches and consoles: tables with two or more drawers."""

from __future__ import annotations

import numpy as np

from script.samples import drawers, extras, legs, tops
from script.samples.layout import corners, legs_at, row
from script.samples.recipes import BLOCK, CHUNKS, COARSE, FINE, MEDIUM, PLUGGED, SHATTERED, UNMERGED, coacd
from script.samples.table import Table, join_parts


def writing_desk() -> Table:
    """Demonstrated: a shelf, two drawers, and a towel bar that is a handle on no drawer."""
    rng = np.random.default_rng(3)
    return Table(
        "table_03",
        "writing desk, notched top, shelf, towel bar",
        join_parts(
            tops.notch_top(1.4, 0.7, 0.75, 0.03, (0.16, 0.06)),
            tops.shelf(1.27, 0.6, 0.2),
            legs_at(corners(1.25, 0.58), lambda x, y: legs.square(0.724, 0.05, 0.08, 0.16)),
            row(2, 0.04, (0.5, 0.5, 0.12), drawers.bow, 0.31, 0.582, pulled=(0.0, 0.28)),
            extras.towel_bar("towel_bar", 0.664, 0, 0.47, 0.62, 0.06, 90),
            extras.book(-0.35, 0.12, 0.75, 25),
            extras.cable([(-0.3, 0.1, 0.008), (-0.1, 0.2, 0.008), (0.05, 0.05, 0.008), (0.3, 0.15, 0.008)]),
            extras.crumbs([(0.2, -0.15, 0.03), (-0.45, -0.05, 0.35)], 0.05, rng),
        ),
        (0, 0, 15),
        FINE,
        {"drawer_1": BLOCK, "drawer": PLUGGED, "handle": BLOCK, "towel_bar": COARSE, "misc": COARSE},
    )


def workbench() -> Table:
    """Six legs, four drawers with cup pulls; lies on its back."""
    rng = np.random.default_rng(7)
    holes = [(x, y) for x in (-0.7, 0.0, 0.7) for y in (-0.22, 0.22)]
    return Table(
        "table_07",
        "workbench, pierced top, six legs, shelf, four drawers, rail at an end",
        join_parts(
            tops.pierce_top(1.9, 0.72, 0.9, 0.05, 0.07, holes),
            tops.shelf(1.7, 0.56, 0.24, 0.025),
            legs_at(
                [(x, y) for x in (-0.8, 0.0, 0.8) for y in (-0.27, 0.27)],
                lambda x, y: legs.square(0.854, 0.07, 0.1, 0.1),
            ),
            row(2, 0.22, (0.62, 0.34, 0.13), drawers.cup, 0.31, 0.7, pulled=(0.16, 0.0)),
            row(2, 0.22, (0.62, 0.22, 0.13), drawers.cup, 0.31, 0.7, turn=180, first=3),
            extras.towel_bar("rail", -0.94, 0, 0.874, 0.5, 0.05, 270),
            extras.offcut(0.5, 0.05, 40, (0.5, 0.05, 0.03)),
            extras.mug(0.35, 0.12, 0.9, 80),
            extras.crumbs([(-0.3, -0.1, 0.27), (0.1, 0.1, 0.02), (-0.5, 0.12, 0.02), (0.3, -0.12, 0.5)], 0.045, rng),
        ),
        (0, 90, 0),
        FINE,
        {
            "drawer_1": COARSE,
            "drawer_2": COARSE,
            "drawer": BLOCK,
            "handle": BLOCK,
            "rail": COARSE,
            "misc": CHUNKS,
            "mug": BLOCK,
            "top": coacd(0.022),
        },
    )


def partners_desk() -> Table:
    """Demonstrated: shallow drawers on one side, deep ones on the other, grips on the edge of the top, no shelf."""
    rng = np.random.default_rng(8)
    return Table(
        "table_08",
        "partners' desk, boarded top, turned legs, drawers on both sides, grips at the ends",
        join_parts(
            tops.boards(1.6, 0.82, 0.76, 0.028, 5, 0.008, 0.02),
            legs_at(corners(1.44, 0.68), lambda x, y: legs.lathe(0.735, 0.08)),
            row(2, 0.06, (0.5, 0.34, 0.12), drawers.rod, 0.37, 0.574, pulled=(0.2, 0.0)),
            row(2, 0.06, (0.5, 0.34, 0.22), drawers.rod, 0.37, 0.474, pulled=(0.0, 0.14), turn=180, first=3),
            extras.grip("grip_1", 0.8, 0, 0.746, 0.24, 0.05, 90),
            extras.grip("grip_2", -0.8, 0, 0.746, 0.24, 0.05, 270),
            extras.lamp(0.45, 0.2, 0.76, 200),
            extras.crumbs([(-0.2, 0.1, 0.02), (0.4, -0.2, 0.04), (0.1, 0.2, 0.3)], 0.05, rng),
        ),
        (0, 0, -28),
        UNMERGED,
        {
            "leg": coacd(0.05, seed=2),
            "drawer_1": MEDIUM,
            "drawer_2": MEDIUM,
            "drawer": PLUGGED,
            "handle": BLOCK,
            "grip_1": COARSE,
            "grip_2": COARSE,
            "misc": COARSE,
        },
    )


def console() -> Table:
    """Narrow and tall, three drawers in a row with knobs, a shelf."""
    rng = np.random.default_rng(9)
    return Table(
        "table_09",
        "console, bordered top, leaning legs, shelf, three drawers",
        join_parts(
            tops.rim_top(1.25, 0.38, 0.86, 0.022, 0.04, 0.02),
            tops.shelf(1.12, 0.28, 0.25),
            legs_at(
                corners(1.12, 0.28),
                lambda x, y: legs.splay_leg(0.83, 0.05, (0.02 * np.sign(x), 0.01 * np.sign(y), 0), 4, 0.018),
            ),
            row(3, 0.03, (0.3, 0.26, 0.1), drawers.knob, 0.165, 0.7, pulled=(0.0, 0.13, 0.0)),
            extras.bowl(-0.3, 0.0, 0.86),
            extras.crumbs([(0.25, 0.03, 0.29), (-0.2, -0.03, 0.03)], 0.04, rng),
        ),
        (0, 0, 38),
        FINE,
        {
            "leg": coacd(0.03),
            "top": coacd(0.015),
            "drawer_2": PLUGGED,
            "drawer": COARSE,
            "handle": BLOCK,
            "misc": COARSE,
        },
    )


def conference() -> Table:
    """Eight legs under three leaves, a drawer on each long side."""
    rng = np.random.default_rng(5)
    return Table(
        "table_05",
        "conference table, three leaves, eight legs, a drawer on each side",
        join_parts(
            tops.leaves(2.5, 1.05, 0.75, 0.03, 3, 0.007),
            legs_at(
                [(x, y) for x in (-1.05, -0.38, 0.38, 1.05) for y in (-0.42, 0.42)],
                lambda x, y: legs.lathe(0.724, 0.085),
            ),
            row(1, 0, (0.58, 0.4, 0.1), drawers.rod, 0.48, 0.575, pulled=(0.22,)),
            row(1, 0, (0.58, 0.4, 0.1), drawers.rod, 0.48, 0.575, turn=180, first=2),
            extras.cable(
                [(-0.6, -0.1, 0.01), (-0.3, 0.15, 0.01), (0.0, 0.1, 0.01), (0.2, -0.1, 0.01), (0.6, -0.05, 0.01)], 0.018
            ),
            extras.mug(-0.8, -0.3, 0.75, 130),
            extras.mug(0.7, 0.25, 0.75, 300).rename("mug_2"),
            extras.crumbs([(0.9, 0.0, 0.04), (-0.9, 0.2, 0.1)], 0.07, rng),
        ),
        (0, 0, 12),
        MEDIUM,
        {"drawer": PLUGGED, "handle": BLOCK, "misc": BLOCK, "cable": COARSE},
    )


def drafting_table() -> Table:
    """A fifth leg in the middle, two drawers on each side."""
    rng = np.random.default_rng(14)
    return Table(
        "table_14",
        "drafting table, waisted top, five legs, two drawers on each side",
        join_parts(
            tops.waist_top(1.6, 0.95, 0.8, 0.03, 0.05),
            legs_at([*corners(1.4, 0.78), (0.0, 0.0)], lambda x, y: legs.square(0.774, 0.06, 0.09, 0.12)),
            row(2, 0.16, (0.42, 0.34, 0.1), drawers.bow, 0.4, 0.652, pulled=(0.0, 0.2)),
            row(2, 0.16, (0.42, 0.34, 0.1), drawers.bow, 0.4, 0.652, pulled=(0.2, 0.0), turn=180, first=3),
            extras.book(0.3, -0.1, 0.8, 70),
            extras.book(0.32, -0.12, 0.831, 95, (0.17, 0.12, 0.02)).rename("book_2"),
            extras.crumbs([(0.3, 0.1, 0.02), (-0.4, 0.15, 0.02), (-0.35, -0.2, 0.3)], 0.05, rng),
        ),
        (0, 0, 40),
        SHATTERED,
        {"drawer": BLOCK, "handle": BLOCK, "misc": BLOCK},
    )


DESKS = (writing_desk, workbench, partners_desk, console, conference, drafting_table)
