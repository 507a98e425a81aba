"""SDF: the models of Gazebo, with what they include; read, and written back losslessly; worlds are read only."""
