"""What is done to an asset before any program sees it: geometry decomposed, hulls split; kept as data, replayed."""
