"""Looking at one asset, given as a mesh or as a file: checks, pictures, and the difference that an edit made."""

from meshforge.common.exports import export_lazily

__getattr__, __all__ = export_lazily(__name__, {"look": "Difference check diff render"})
