"""What pages see of a project, worked out anew each time and kept nowhere.

Rooms: `shapes` (an asset and its triangles), `staging` (in the midst of edits), `pictures`. Doors beside them: `cards`,
`project`, `next_step`, `programs`, `language`.
"""
