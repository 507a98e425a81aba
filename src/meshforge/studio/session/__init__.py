"""The session of a studio: what it opens, changes, keeps in step with the files, and runs as jobs."""
