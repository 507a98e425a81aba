"""From files to an asset: what MuJoCo compiles of them, in MeshForge's words."""
