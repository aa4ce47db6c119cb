"""What the tests of `handey inspect` share: models, meshes made by hand, the command."""

from __future__ import annotations

import json
import re

from hand_made import ROOT

from handey import cli

PARTS, CELLS = ROOT / "models" / "parts", ROOT / "models" / "cells"
ROBOT = ROOT / "models" / "robots" / "puma560" / "robot.yaml"
SHARED = ROOT.parent / "shared" / "data" / "parts"
MM = 1e-3


def write_obj(path, vertices, faces):
    lines = [f"v {x} {y} {z}" for x, y, z in vertices]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in faces]
    path.write_text("\n".join(lines) + "\n")
    return path


def box_corners(x, y, z):
    return [(x * i, y * j, z * k) for k in (0, 1) for j in (0, 1) for i in (0, 1)]


BOX = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def triangles(quads):
    return [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def run(capsys, *arguments):
    status = cli.main(["inspect", *map(str, arguments)])
    out, err = capsys.readouterr()
    return status, out, err


def scene_of(path):
    return json.loads(re.search(r'id="scene">(.*?)</script>', path.read_text(), re.S).group(1))
