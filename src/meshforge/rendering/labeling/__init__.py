"""Pictures for naming the parts of a mesh: views in which each hull is seen and numbered."""
