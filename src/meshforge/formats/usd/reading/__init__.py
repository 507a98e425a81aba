"""From a USD stage to an asset: colliders, shapes, bodies, joints, masses, visuals."""
