"""Labels of one to five assets propagated to all others of a family, offline, each with its chance."""
