"""Reading an SDF: models with what they include, frames, shapes, joints and masses."""
