"""Learning in the background: the process that learns, its queue, and its results as the page shows them."""
