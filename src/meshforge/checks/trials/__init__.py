"""Physics in MuJoCo at given places of hulls, Z up: what stands, carries, can be gripped, passed and moved."""
