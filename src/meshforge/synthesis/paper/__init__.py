"""The algorithms of the paper as printed, the yardstick: a worklist of partial programs, and abductive inference."""
