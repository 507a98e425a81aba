"""How an asset behaves in MuJoCo: at rest on a plane; what stands, carries, holds, can be gripped, passed and moved."""
