"""How an asset behaves in MuJoCo: at rest on a plane; and at given places: what stands, carries, holds, can be gripped,
passed and moved."""
