"""`meshforge label`, in each of its ways."""

from meshforge.cli.label.command import label

__all__ = ["label"]
