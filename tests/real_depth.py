"""A cell about a real depth image: boxes that a Kinect saw on a table, and a part beside them.

The images are organised point clouds (PCD, LZF-compressed) of the mOSD data set, labelled by
people: 1 is the table. Where the camera stood is found by a plane through the table's points.
Run: python real_depth.py CLOUD FOLDER, which writes cell.yaml and depth.npy.
"""

from __future__ import annotations

import struct
import sys
from pathlib import Path

import numpy as np
import yaml

MODELS = Path(__file__).resolve().parents[1] / "models"
FOCAL, CENTRE = 525.0, (319.5, 239.5)  # pixels
TABLE = 1  # label
MIDDLE = (0.52, -0.02)  # where the middle of the table's points goes in the cell [m]


def read_cloud(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Depths [m], NaN where nothing was measured, and labels of an organised cloud (480, 640)."""
    content = path.read_bytes()
    header = b"DATA binary_compressed\n"
    start = content.index(header) + len(header)
    packed, size = struct.unpack("<II", content[start : start + 8])
    raw = unpacked(content[start + 8 : start + 8 + packed], size)
    fields = np.frombuffer(raw, "<f4").reshape(5, 480, 640)  # label, x, y, z, colour
    return fields[3].astype(float), fields[0].view("<u4")


def unpacked(packed: bytes, size: int) -> bytes:
    """LZF: runs of bytes as they are, and references to what came before."""
    out = bytearray()
    at = 0
    while at < len(packed):
        control = packed[at]
        at += 1
        if control < 32:
            out += packed[at : at + control + 1]
            at += control + 1
            continue
        length = control >> 5
        if length == 7:
            length += packed[at]
            at += 1
        back = ((control & 31) << 8) + packed[at] + 1
        at += 1
        first = len(out) - back
        for k in range(length + 2):
            out.append(out[first + k])
    assert len(out) == size
    return bytes(out)


def camera_pose(depth: np.ndarray, labels: np.ndarray) -> np.ndarray:
    """The camera in the cell (4, 4): the table is z = 0, the camera looks along +y."""
    v, u = np.nonzero(np.isfinite(depth) & (labels == TABLE))
    z = depth[v, u]
    points = np.stack([(u - CENTRE[0]) / FOCAL * z, (v - CENTRE[1]) / FOCAL * z, z], axis=1)
    for _ in range(4):  # least squares, then again without what lies off
        middle = points.mean(axis=0)
        up = np.linalg.eigh(np.cov((points - middle).T))[1][:, 0]
        off = np.abs((points - middle) @ up)
        points = points[off < 3 * off.std() + 1e-4]
    up = up * -np.sign(up[2])  # towards the camera
    ahead = np.array([0.0, 0.0, 1.0]) - up[2] * up
    ahead /= np.linalg.norm(ahead)
    pose = np.eye(4)
    pose[:3, :3] = np.stack([np.cross(ahead, up), ahead, up])
    pose[:3, 3] = np.array([*MIDDLE, 0.0]) - pose[:3, :3] @ middle
    return pose


def write_cell(
    cloud: Path, folder: Path, start=(0.56, -0.33), goal=(0.46, 0.25), crop=(85, 475, 150, 535)
) -> Path:
    """The cell: Puma, table, part, and the image, cut to rows and columns that show the table."""
    depth, labels = read_cloud(cloud)
    X_WC = camera_pose(depth, labels)
    v0, v1, u0, u1 = crop
    np.save(folder / "depth.npy", depth[v0:v1, u0:u1].astype(np.float32))
    sign = np.array([X_WC[2, 1], X_WC[2, 2], -X_WC[2, 0], X_WC[1, 0], X_WC[0, 0]])
    rpy = [np.arctan2(sign[0], sign[1]), np.arcsin(sign[2]), np.arctan2(sign[3], sign[4])]
    lens = {"fx": FOCAL, "fy": FOCAL, "cx": CENTRE[0] - u0, "cy": CENTRE[1] - v0}
    part = {"mesh": str(MODELS / "parts" / "l_block.stl"), "scale": 0.001}
    cell = {
        "handey_cell": 1,
        "name": cloud.stem,
        "robot": {"file": str(MODELS / "robots" / "puma560" / "robot.yaml")},
        "fixtures": {
            "table": {"box": [1.6, 1.8, 0.05], "pose": {"xyz": [0.65, 0, -0.025]}, "support": True}
        },
        "parts": {"l_block": {**part, "pose": {"xyz": [*start, 0]}}},
        "depth_maps": {
            "kinect": {
                "depth": "depth.npy",
                "intrinsics": lens,
                "pose": {"xyz": X_WC[:3, 3].tolist(), "rpy": [float(angle) for angle in rpy]},
                "explained": 0.008,  # the table's points lie within 5 mm of a plane, but for a few
            }
        },
        "task": [{"place": "l_block", "at": {"xyz": [*goal, 0], "rpy": [0, 0, 0.7]}}],
    }
    path = folder / "cell.yaml"
    path.write_text(yaml.safe_dump(cell, sort_keys=False))
    return path


if __name__ == "__main__":
    print(write_cell(Path(sys.argv[1]), Path(sys.argv[2])))
