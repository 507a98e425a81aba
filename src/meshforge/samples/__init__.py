"""The bundled family of tables: frozen files, made by `script/make-samples`."""
