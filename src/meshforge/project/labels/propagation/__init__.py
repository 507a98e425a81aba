"""Labels of a few assets carried to all others: each asset is described once, in a worker process, and kept so."""
