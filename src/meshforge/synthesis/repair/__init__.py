"""Wrong labels, found out by what was shown: programs with corrections, weighed by how believable both are."""
