"""TODO"""

from meshforge.common.errors import (
    AssetError,
    DemonstrationError,
    GeometryError,
    MeshForgeError,
    ProgramError,
    ProjectError,
    StoppedError,
    UsageError,
    describe_error,
    first_validation_error,
)
from meshforge.common.files import (
    FileStates,
    expand_glob,
    file_state,
    file_states,
    is_file,
    is_link_cycle,
    plain_path,
    relative_name,
    replace_atomically,
    write_atomically,
)
from meshforge.common.text import join_names, nearest_name, pluralize

__all__ = [
    "AssetError",
    "DemonstrationError",
    "FileStates",
    "GeometryError",
    "MeshForgeError",
    "ProgramError",
    "ProjectError",
    "StoppedError",
    "UsageError",
    "describe_error",
    "expand_glob",
    "file_state",
    "file_states",
    "first_validation_error",
    "is_file",
    "is_link_cycle",
    "join_names",
    "nearest_name",
    "plain_path",
    "pluralize",
    "relative_name",
    "replace_atomically",
    "write_atomically",
]
