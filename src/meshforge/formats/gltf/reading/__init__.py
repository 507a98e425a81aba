"""From a glTF scene to an asset: conventions of collision, shapes, bodies, visuals."""
