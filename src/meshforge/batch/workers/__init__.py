"""Worker processes: supervised on this machine, or on the nodes of a cluster; time and memory are bounded."""
