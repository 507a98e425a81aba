"""From an edited asset back to its files: only the geoms that the edit touches become others, and MuJoCo is asked."""
