"""Actions and orientations by their texts, read as a program has them."""

from __future__ import annotations

from meshforge.language import Action, Orient, Program


def parse_action(text: str) -> Action:
    (rule,) = Program.parse(f"All => {text}").rules
    return rule.action


def parse_orient(text: str) -> Orient:
    orient = Program.parse(text).orient
    assert orient is not None
    return orient
