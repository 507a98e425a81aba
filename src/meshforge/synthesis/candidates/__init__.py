"""What the demonstrations leave open: readings, how believable they are, and what to ask."""
