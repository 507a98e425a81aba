"""What checks and goals find: beside the criteria of the benchmark, of planted defects, and beside other tools."""
