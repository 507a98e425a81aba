"""By what the checks of an output are kept: all that decides them."""

from __future__ import annotations

from meshforge.batch import Stamp, software, text_digest
from meshforge.project.reviewing import output_digest

_MEASURING = "1"
"""Counts the ways in which outputs were measured."""


def check_key(stamp: Stamp | None) -> str | None:
    """A digest of the files of an output and of the asset it was made from, None where there is no output."""
    output = output_digest(stamp)
    if stamp is None or stamp.inputs is None or output is None:
        return None
    files = [f"{name} {digest}" for name, digest in sorted(stamp.inputs.asset.items())]
    return text_digest("\n".join([_MEASURING, software(), output, str(stamp.inputs.preparation), *files]))
