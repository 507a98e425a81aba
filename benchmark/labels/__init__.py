"""How well labels are found: by propagation, and what its metric was learned on."""
