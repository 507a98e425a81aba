"""A small asset as PartNet-Mobility has them: parts with meshes, named where they are shown."""

from pathlib import Path

from tests.unit.batch.families import Corner, obj

PARTS: dict[str, tuple[tuple[str, Corner, Corner], ...]] = {
    "link_2": (
        ("frame_side-1", (-0.4, -0.3, 0.0), (-0.35, 0.3, 0.8)),
        ("bottom-2", (-0.35, -0.3, 0.0), (0.4, 0.3, 0.05)),
    ),
    "link_0": (
        ("drawer_front-5", (-0.35, -0.32, 0.1), (0.35, -0.3, 0.4)),
        ("handle-7", (-0.1, -0.36, 0.24), (0.1, -0.32, 0.26)),
    ),
    "link_1": (
        ("surface-9", (-0.35, -0.32, 0.42), (0.35, -0.3, 0.8)),
        ("knob-3", (0.25, -0.36, 0.6), (0.3, -0.32, 0.65)),
    ),
}


def write_partnet(folder: Path) -> Path:
    """`mobility.urdf` and its meshes in a folder."""
    links, joints = [], []
    for link, parts in PARTS.items():
        own = []
        for k, (name, low, high) in enumerate(parts):
            mesh = folder / f"textured_objs/original-{link[-1]}{k}.obj"
            mesh.parent.mkdir(parents=True, exist_ok=True)
            mesh.write_text(obj({"mesh": (low, high)}))
            shape = f'<geometry><mesh filename="textured_objs/{mesh.name}"/></geometry>'
            own.append(f'<visual name="{name}">{shape}</visual><collision>{shape}</collision>')
        links.append(f'<link name="{link}">{"".join(own)}</link>')
        joints.append(f'<joint name="j{link[-1]}" type="fixed"><parent link="base"/><child link="{link}"/></joint>')
    urdf = folder / "mobility.urdf"
    urdf.write_text(f'<robot name="partnet"><link name="base"/>{"".join(links + joints)}</robot>')
    return urdf
