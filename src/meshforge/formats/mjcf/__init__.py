"""MJCF: the models of MuJoCo, main file and includes; read through MuJoCo itself, written back losslessly."""
