"""Runs over very many assets: what the batch adds to the work, and whether that stays so for a hundred thousand."""
