"""The bundled family of tables: frozen files, made by `script/make-samples`."""

from __future__ import annotations

from pathlib import Path

TABLES = Path(__file__).parent / "tables"
"""Fourteen tables as OBJ files with their labels beside them; `tables.mf`, `templates/` and `demonstrations/`."""
