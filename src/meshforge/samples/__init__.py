"""The bundled family of tables: frozen files, made by `script/make-samples`."""

from pathlib import Path

TABLES = Path(__file__).parent / "tables"
"""`table_NN.obj` with their labels beside them, `templates/` and `demonstrations/`."""
