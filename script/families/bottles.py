"""Bottles, one OBJ each: a body of 1 to 18 hulls, and none to 8 of a cap, a pump, a trigger or a cork.

What holds for all, so that one program is right for them: the hull of a body has no hollow that matters, since what
a hand goes through is of no bottle here; and each has at most one cap.
"""

from __future__ import annotations

from dataclasses import dataclass

from meshforge.geometry import Floats, Polytope, Pose
from meshforge.samples.families import Files
from script.families.parts import format_hulls, format_labels, name_hulls
from script.families.pieces import Y_UP, Cut, Profile, X, Y, Z, block, slice_all, stack, superellipse

_ROUND = superellipse(2.0, 2.0, 2.0, 16)
_OVAL = superellipse(2.0, 1.1, 2.5, 14)
_SQUARE = superellipse(2.0, 2.0, 8.0, 16)
_FLAT = superellipse(2.0, 0.8, 6.0, 14)
_UPRIGHT = Pose.identity()
_ON_ITS_SIDE = Pose([[0, 0, 1], [0, 1, 0], [-1, 0, 0]], [0, 0, 0.03])


@dataclass(frozen=True, eq=False)
class Bottle:
    """One bottle: its body as a stack of rings, which is cut up, and its cap in pieces.

    outline: of the body, see `stack`; names: of the hulls, see `name_hulls`; cap_first: whether it comes first in the
    file; pose: how it lies in the file.
    """

    name: str
    about: str
    outline: Floats
    body: Profile
    body_cuts: tuple[Cut, ...] = ()
    cap: tuple[Polytope, ...] = ()
    names: str = "convex_{}"
    cap_first: bool = False
    pose: Pose = _UPRIGHT

    def write(self) -> Files:
        """Its OBJ and its labels."""
        parts = [("body", slice_all(stack(self.outline, self.body), self.body_cuts)), ("cap", list(self.cap))]
        hulls = name_hulls(parts[::-1] if self.cap_first else parts, self.names, self.pose)
        labels = format_labels((hull.name for hull in hulls), (hull.label for hull in hulls))
        return {f"{self.name}.obj": format_hulls(hulls, self.about), f"{self.name}.labels.json": labels}


def _cap(*profile: tuple[float, float], cuts: tuple[Cut, ...] = ()) -> tuple[Polytope, ...]:
    return tuple(slice_all(stack(_ROUND, profile), cuts))


def build_bottles() -> Files:
    """All bottles."""
    return {path: content for bottle in _list_bottles() for path, content in bottle.write().items()}


def _list_bottles() -> list[Bottle]:
    pump = (*_cap((0.016, 0.15), (0.016, 0.168)), *_cap((0.005, 0.168), (0.005, 0.19)))
    head = (block((-0.012, -0.012, 0.19), (0.012, 0.012, 0.203)), block((0.012, -0.006, 0.193), (0.045, 0.006, 0.203)))
    collar = _cap((0.018, 0.2), (0.018, 0.222), cuts=((X, 2),))
    sprayer = (
        block((-0.03, -0.013, 0.222), (0.035, 0.013, 0.25)),
        block((0.035, -0.008, 0.23), (0.05, 0.008, 0.245)),
        block((0.024, -0.006, 0.19), (0.034, 0.006, 0.222)),
    )
    return [
        Bottle(
            "shampoo",
            "oval, flip cap",
            outline=_OVAL,
            body=[(0.034, 0), (0.038, 0.02), (0.038, 0.13), (0.024, 0.16)],
            body_cuts=((X, 2),),
            cap=_cap((0.02, 0.16), (0.02, 0.185), (0.012, 0.19), cuts=((Y, 2),)),
        ),
        Bottle(
            "dish_soap",
            "flat, shoulders, narrow push cap",
            outline=_FLAT,
            body=[(0.04, 0), (0.042, 0.12), (0.036, 0.17), (0.014, 0.2)],
            cap=_cap((0.013, 0.2), (0.013, 0.212), (0.006, 0.228)),
        ),
        Bottle(
            "hand_soap",
            "square, pump with a nozzle",
            outline=_SQUARE,
            body=[(0.03, 0), (0.03, 0.12), (0.014, 0.15)],
            body_cuts=((Z, 2), (Y, 2)),
            cap=(*pump, *head),
            names="part.{}",
            cap_first=True,
        ),
        Bottle(
            "spray_cleaner",
            "oval, trigger sprayer",
            outline=_OVAL,
            body=[(0.04, 0), (0.043, 0.03), (0.04, 0.12), (0.02, 0.16), (0.014, 0.2)],
            body_cuts=((X, 3),),
            cap=(*collar, *sprayer),
            names="hull_{}",
        ),
        Bottle(
            "wine",
            "round, long neck, cork",
            outline=_ROUND,
            body=[(0.036, 0), (0.037, 0.18), (0.03, 0.2), (0.015, 0.225), (0.014, 0.295)],
            body_cuts=((X, 2), (Y, 2)),
            cap=_cap((0.011, 0.295), (0.011, 0.308)),
            cap_first=True,
        ),
        Bottle(
            "milk",
            "square, wide screw cap in six layers",
            outline=_SQUARE,
            body=[(0.045, 0), (0.045, 0.16), (0.022, 0.21)],
            body_cuts=(((1.0, 1.0, 0.0), 3),),
            cap=_cap((0.02, 0.21), (0.021, 0.228), cuts=((Z, 3), (X, 2))),
            names="milk_{}",
        ),
        Bottle(
            "ketchup",
            "oval, stands on its cap",
            outline=_OVAL,
            body=[(0.034, 0.03), (0.037, 0.07), (0.034, 0.14), (0.036, 0.19)],
            body_cuts=((Z, 2),),
            cap=_cap((0.026, 0), (0.028, 0.03), cuts=((X, 2), (Y, 2))),
            names="hull_{}",
        ),
        Bottle(
            "pills",
            "round, one hull and a cap as wide",
            outline=_ROUND,
            body=[(0.022, 0), (0.022, 0.06)],
            cap=_cap((0.023, 0.06), (0.023, 0.078), cuts=((X, 3),)),
            names="decomp{}",
        ),
        Bottle(
            "tube",
            "lies on its side, cut along",
            outline=_FLAT,
            body=[(0.03, 0), (0.028, 0.08), (0.015, 0.13)],
            body_cuts=((X, 3),),
            cap=_cap((0.013, 0.13), (0.012, 0.155)),
            pose=_ON_ITS_SIDE,
        ),
        Bottle(
            "soda",
            "round, waist, Y up in its file",
            outline=_ROUND,
            body=[(0.028, 0), (0.033, 0.02), (0.0315, 0.08), (0.033, 0.14), (0.013, 0.2), (0.012, 0.215)],
            body_cuts=((Y, 2),),
            cap=_cap((0.015, 0.215), (0.014, 0.23)),
            names="Mesh.{}",
            pose=Y_UP,
        ),
        Bottle(
            "flask",
            "flat, without a cap",
            outline=_FLAT,
            body=[(0.04, 0), (0.045, 0.11), (0.012, 0.14)],
            body_cuts=((X, 2), (Z, 2)),
        ),
        Bottle("ampoule", "one hull, without a cap", outline=_ROUND, body=[(0.008, 0), (0.006, 0.06)], names="geom"),
    ]
