"""How an asset behaves in a physics engine: MuJoCo rests it on a plane."""
