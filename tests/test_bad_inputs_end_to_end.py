"""Bad files behind a cell: `handey plan` ends with 2, tells each fault, and writes nothing.

The cell, its robot and its mesh are right but for one change; each line must name the file, the
place and what is wrong.
"""

from __future__ import annotations

import os
import shutil
import struct
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pytest

from handey import cli

PUMA = Path(__file__).resolve().parent.parent / "models" / "robots" / "puma560"
URDF = (PUMA / "puma560.urdf").read_text()
CELL = """\
handey_cell: 1
name: test
robot: {file: robot.yaml}
fixtures:
  table: {box: [1.6, 1.4, 0.05], pose: {xyz: [0.55, 0, -0.025]}, support: true}
parts:
  block: {box: [0.04, 0.06, 0.03], pose: {xyz: [0.5, 0.2, 0.015]}}
task: [{place: block, at: {xyz: [0.45, -0.25, 0.015]}}]
"""


@pytest.fixture
def bench(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a cell and its robot, both right."""
    shutil.copytree(PUMA, tmp_path, dirs_exist_ok=True)
    (tmp_path / "cell.yaml").write_text(CELL)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def put(path: Path, content: str | bytes) -> None:
    path.write_bytes(content if isinstance(content, bytes) else content.encode())


def complaints(bench: Path, capsys: pytest.CaptureFixture[str]) -> list[str]:
    """What is said on standard error, each line without its `handey: `."""
    before = sorted(bench.rglob("*"))
    assert cli.main(["plan", "cell.yaml", "-o", "plan.json"]) == 2
    out, err = capsys.readouterr()
    assert out == "" and sorted(bench.rglob("*")) == before
    lines = err.splitlines()
    assert lines and all(line.startswith("handey: ") for line in lines)
    return [line.removeprefix("handey: ") for line in lines]


def test_the_files_that_the_cases_change_are_right(bench, capsys):
    assert cli.main(["plan", "cell.yaml", "-o", "plan.json"]) == 0
    assert capsys.readouterr().err == "" and (bench / "plan.json").exists()


# The URDF

LIMIT = (
    '<limit lower="-2.792526803190927" upper="2.792526803190927" velocity="1.7453292519943295"'
    ' effort="100"/>'
)
TYPE = '<joint name="joint1" type="revolute">'
AXIS = '<child link="link1"/>\n    <axis xyz="0 0 1"/>'
BOX = '<box size="0.4066 0.4066 0.0654"/>'
END = "</robot>"
FLANGE = '<mesh filename="meshes/link6_flange.obj"'


def changed(old: str, new: str) -> str:
    assert old in URDF
    return URDF.replace(old, new, 1)


def limit(lower: str = "-2", upper: str = "2", velocity: str = "1") -> str:
    values = {"lower": lower, "upper": upper, "velocity": velocity, "effort": "1"}
    text = " ".join(f'{key}="{value}"' for key, value in values.items() if value)
    return changed(LIMIT, f"<limit {text}/>")


def axis(xyz: str) -> str:
    return changed(AXIS, f'<child link="link1"/>\n    <axis xyz="{xyz}"/>')


def shape(geometry: str) -> str:
    return changed(BOX, geometry)


def mesh(filename: str) -> str:
    return shape(f'<mesh filename="{filename}"/>')


def link(name: str) -> str:
    return f'<link name="{name}"><collision><geometry>{BOX}</geometry></collision></link>'


def fixed(name: str, parent: str, child: str) -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="fixed">{ends}</joint>'


def chain(links: int) -> str:
    joints = (fixed(f"j{i}", f"l{i}", f"l{i + 1}") for i in range(links - 1))
    names = (f'<link name="l{i}"/>' for i in range(links))
    return f'<robot name="a">{"".join([*names, *joints])}</robot>'


def laughs() -> str:
    levels = (f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">' for i in range(1, 10))
    return f'<!DOCTYPE l [<!ENTITY a0 "ha">{"".join(levels)}]><robot name="&a9;"/>'


def visual_only() -> str:
    start = URDF.index('<link name="link6">')
    end = URDF.index("</link>", start)
    return URDF[:start] + URDF[start:end].replace("collision>", "visual>") + URDF[end:]


URDF_CASES: dict[str, tuple[str | bytes, str]] = {
    "empty": ("", "line 1: is not well-formed XML: no element found"),
    "no XML": ("hello", "line 1: is not well-formed XML"),
    "cut off": (URDF[: len(URDF) // 2], "is not well-formed XML: unclosed token"),
    "root": ("<model/>", "line 1: the root element is <model>; expected <robot>"),
    "no name": (changed(' name="puma560"', ""), "line 17: <robot> has no name"),
    "no links": ('<robot name="a"/>', "line 1: has no <link>"),
    "two roots": (changed(END, link("stray") + END), "found 'base_link', 'stray'"),
    "link twice": (changed(END, link("link3") + END), "link 'link3': the name is taken already"),
    "joint twice": (
        changed(END, link("x") + fixed("joint3", "link6", "x") + END),
        "joint 'joint3': the name is taken already in line 72",
    ),
    "two parents": (
        changed(END, fixed("again", "base_link", "link3") + END),
        "joint 'again': 'link3' has a parent already, 'link2'",
    ),
    "ring": (changed(END, fixed("back", "link6", "base_link") + END), "the joints form a ring"),
    "ring apart": (
        changed(END, link("p") + link("q") + fixed("a", "p", "q") + fixed("b", "q", "p") + END),
        "link 'p': is its own ancestor",
    ),
    "self joint": (
        changed(END, fixed("self", "link3", "link3") + END),
        "joint 'self': joins 'link3' to itself",
    ),
    "unknown parent": (
        changed('<parent link="link2"/>', '<parent link="lnk"/>'),
        "joint 'joint3': the parent 'lnk' is no link; links are 'base_link'",
    ),
    "no child": (changed('<child link="link3"/>', ""), "joint 'joint3': names no <child> link"),
    "no limit": (changed(LIMIT, ""), "joint 'joint1': has no <limit>; expected one with lower"),
    "reversed limit": (limit("2", "-2"), "the limits are 2 to -2; expected lower < upper"),
    "absent limits": (
        limit("", ""),
        "line 40: joint 'joint1': <limit> has neither lower nor upper",
    ),
    "no velocity": (limit(velocity=""), "joint 'joint1': <limit> has no velocity"),
    "zero velocity": (limit(velocity="0"), "the velocity limit is 0; expected more than 0"),
    "negative velocity": (limit(velocity="-1"), "the velocity limit is -1; expected more than 0"),
    "nan limit": (limit("nan"), "<limit> lower has 'nan'; expected a finite number"),
    "infinite limit": (limit(upper="inf"), "<limit> upper has 'inf'; expected a finite number"),
    "1e400": (limit(upper="1e400"), "<limit> upper has '1e400'; expected a finite number"),
    "degrees": (limit("-160", "160"), "the limits are -160 to 160 rad; are they in degrees?"),
    "decimal comma": (
        limit(upper="1,5"),
        "upper has '1,5'; expected a finite number, with a decimal",
    ),
    "xacro": (limit(upper="${pi}"), 'upper="${pi}" is left over from xacro; expand the file first'),
    "zero axis": (axis("0 0 0"), "line 39: joint 'joint1': the axis is zero"),
    "axis of two": (axis("0 1"), "<axis> xyz has 2 numbers; expected 3 finite numbers"),
    "axis of four": (axis("0 0 1 0"), "<axis> xyz has 4 numbers; expected 3 finite numbers"),
    "misspelt tag": (
        URDF.replace("collision>", "colision>", 2),
        "line 19: link 'base_link': <colision> is unknown inside <link>; known are",
    ),
    "second limit": (changed(LIMIT, LIMIT * 2), "joint 'joint1': a second <limit> inside <joint>"),
    "mimic of nothing": (
        changed(LIMIT, LIMIT + '<mimic joint="nope"/>'),
        "joint 'joint1': mimics 'nope', which is no joint; joints are",
    ),
    "mimic of itself": (
        changed(LIMIT, LIMIT + '<mimic joint="joint1"/>'),
        "joint 'joint1': mimics itself, in a ring",
    ),
    "box nan": (shape('<box size="nan 1 1"/>'), "<box> size has 'nan'; expected 3 finite numbers"),
    "box of two": (shape('<box size="1 1"/>'), "<box> size has 2 numbers; expected 3"),
    "negative box": (shape('<box size="-1 1 1"/>'), "<box> size has -1; expected numbers above 0"),
    "flat box": (shape('<box size="0 1 1"/>'), "<box> size has 0; expected numbers above 0"),
    "no length": (shape('<cylinder radius="1"/>'), "<cylinder> length is missing"),
    "capsule": (
        shape('<capsule radius="1" length="1"/>'),
        "<capsule> is not supported; use a cylinder and two spheres",
    ),
    "no geometry": (shape(""), "line 19: link 'base_link': <collision> has no geometry"),
    "two shapes": (shape(BOX * 2), "two shapes in one <geometry>; give each its own <collision>"),
    "visual only": (visual_only(), "link 'link6': has a <visual> but no <collision>"),
    "no filename": (shape("<mesh/>"), "link 'base_link': <mesh> has no filename"),
    "no mesh": (mesh("meshes/none.obj"), "mesh 'meshes/none.obj' leads to no file"),
    "mesh is a folder": (mesh("meshes"), "mesh 'meshes' is not a regular file"),
    "mesh of no kind": (mesh("robot.yaml"), "'robot.yaml' is of no known kind; expected .stl"),
    "URL": (mesh("http://example.org/a.stl"), "is not a local file; expected a relative path"),
    "package": (mesh("package://nobody/a.stl"), "package 'nobody' is unknown; known are"),
    "link loop": (mesh("loop.stl"), "mesh 'loop.stl' leads to no file"),
    "pipe": (mesh("pipe.stl"), "mesh 'pipe.stl' is not a regular file"),
    "device": (mesh("/dev/zero"), "mesh '/dev/zero' leads out of"),
    "zero scale": (changed(FLANGE, FLANGE + ' scale="0 1 1"'), "<mesh> scale has 0; expected"),
    "scale nan": (changed(FLANGE, FLANGE + ' scale="nan 1 1"'), "<mesh> scale has 'nan'; expected"),
    "mirrored": (changed(FLANGE, FLANGE + ' scale="-1 1 1"'), "<mesh> scale has -1; expected"),
    "deep": ("<robot>" + "<a>" * 200_000, "line 1: elements are nested deeper than 64 levels"),
    "entities": (laughs(), "line 1: a DOCTYPE is not allowed, nor are entities"),
    "Latin-1": (URDF.replace("puma", "pum\xe9", 1).encode("latin-1"), "is not UTF-8; expected"),
    "cut in a character": (b'<?xml version="1.0"?><robot name="\xe4\xbd', "is not UTF-8; expected"),
    "UTF-16": (URDF.encode("utf-16"), "line 1: byte 0 is not UTF-8"),
    "NUL": (URDF.replace("puma", "pu\0ma", 1), "is not UTF-8; expected a UTF-8 file without NUL"),
    "too large": (b"<robot><!--" + b"x" * 100_000_000, "is larger than 16 MiB"),
    "too many links": (chain(30_000), "has 30000 links and 29999 joints; at most 1000 are read"),
}


@pytest.mark.parametrize("name", URDF_CASES)
def test_a_cell_with_a_wrong_urdf_is_refused_in_one_line(name, bench, capsys):
    content, words = URDF_CASES[name]
    (bench / "loop.stl").symlink_to("loop.stl")
    os.mkfifo(bench / "pipe.stl")
    put(bench / "puma560.urdf", content)
    (line,) = complaints(bench, capsys)
    assert line.startswith(f"{bench / 'puma560.urdf'}: ") and words in line


SEVERAL: dict[str, tuple[str, list[str]]] = {
    "unknown kind": (
        changed(TYPE, TYPE.replace("revolute", "hinge")),
        [
            "puma560.urdf: line 35: joint 'joint1': the type 'hinge' is unknown; known are",
            "robot.yaml: arm: 'joint1' is hinge; expected revolute",
        ],
    ),
    "planar": (
        changed(TYPE, TYPE.replace("revolute", "planar")),
        [
            "puma560.urdf: line 35: joint 'joint1': the type 'planar' is not supported",
            "robot.yaml: arm: 'joint1' is planar; expected revolute",
        ],
    ),
    "misspelt attribute": (
        changed('<parent link="link2"/>', '<parent lnk="link2"/>'),
        [
            "line 74: joint 'joint3': <parent> has the unknown attribute 'lnk'; known are 'link'",
            "line 72: joint 'joint3': names no <parent> link",
        ],
    ),
    "empty name": (
        changed('<link name="link3">', '<link name="">'),
        [
            "line 79: <link> has no name",
            "the child 'link3' is no link",
            "the parent 'link3' is no link",
        ],
    ),
}


@pytest.mark.parametrize("name", SEVERAL)
def test_a_fault_that_shows_in_several_places_is_told_at_each(name, bench, capsys):
    content, expected = SEVERAL[name]
    put(bench / "puma560.urdf", content)
    lines = complaints(bench, capsys)
    assert len(lines) == len(expected)
    assert all(words in line for words, line in zip(expected, lines, strict=True))


def test_of_very_many_faults_the_first_hundred_are_told(bench, capsys):
    attributes = " ".join(f'a{i}="1"' for i in range(100_000))
    put(bench / "puma560.urdf", f'<robot name="a" {attributes}/>')
    lines = complaints(bench, capsys)
    assert len(lines) == 101 and "'a0'" in lines[0] and "more faults" in lines[-1]


def test_of_very_many_faults_of_a_cell_the_rest_is_counted(bench, capsys):
    parts = "".join(f"  p{i}: {{bx: 1}}\n" for i in range(300))
    put(bench / "cell.yaml", CELL.replace("parts:\n", "parts:\n" + parts))
    lines = complaints(bench, capsys)
    assert len(lines) == 101 and lines[-1] == "500 more faults are not shown"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (axis("0 0 2"), "puma560.urdf: line 39: joint 'joint1': the axis has length 2"),
        (
            changed(LIMIT, LIMIT + '<safety_controller soft_upper_limit="2" k_velocity="1"/>'),
            "line 40: joint 'joint1': the safety controller's upper limit 2 is applied",
        ),
    ],
)
def test_what_is_odd_but_clear_is_a_warning(content, words, bench, capsys):
    put(bench / "puma560.urdf", content)
    cli.main(["plan", "cell.yaml", "-o", "plan.json"])
    err = capsys.readouterr().err
    assert "warning: " in err and words in err and err.count("puma560.urdf") == err.count("\n")


# Meshes

CORNERS = [(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]


def obj(
    faces: Iterable[tuple[int, ...]] = TRIANGLES,
    corners: Iterable[tuple[float, ...]] = CORNERS,
    size: float = 0.04,
) -> str:
    vertices = (f"v {size * x:g} {size * y:g} {size * z:g}\n" for x, y, z in corners)
    return "".join([*vertices, *(f"f {' '.join(str(i + 1) for i in face)}\n" for face in faces)])


def stl(
    faces: list[tuple[int, ...]] = TRIANGLES,
    corners: list[tuple[float, ...]] = CORNERS,
    count: int | None = None,
    start: bytes = b"",
) -> bytes:
    def triangle(face: tuple[int, ...]) -> bytes:
        return struct.pack("<12fH", 0, 0, 0, *(0.04 * x for i in face for x in corners[i]), 0)

    head = start.ljust(80) + struct.pack("<I", len(faces) if count is None else count)
    return head + b"".join(map(triangle, faces))


def with_corner(x: float) -> list[tuple[float, ...]]:
    return [(x, 0.0, 0.0), *CORNERS[1:]]


MESH_CASES: dict[str, tuple[str, str | bytes, str]] = {
    "empty": ("stl", b"", "p.stl: found an empty file, expected a mesh"),
    "no triangles": ("stl", stl([]), "found no triangles, expected at least one"),
    "count": ("stl", stl(count=2**32 - 1), "expected 214748364834 of a binary STL of 4294967295"),
    "cut off": ("stl", stl()[:-30], "found 654 bytes, expected 684 of a binary STL of 12"),
    "cut text": ("stl", "solid a\nfacet normal 0 0 1\n", "p.stl: line 3: the file ends, expected"),
    "trailing": ("stl", stl() + b"junk", "found 4 bytes after the last of 12 triangles"),
    "nan": ("stl", stl(corners=with_corner(np.nan)), "triangle 0 has a vertex that is not finite"),
    "nan text": ("obj", obj(corners=with_corner(np.nan)), "p.obj: line 1: found 'nan', expected"),
    "1e30": (
        "stl",
        stl(corners=with_corner(1e30)),
        "has a coordinate of 4e+28 m, expected at most",
    ),
    "slivers": ("stl", stl([(0, 0, 1)] * 12), "found only triangles without area"),
    "flat": ("obj", obj([(1, 2, 3)] * 4), "encloses no volume, expected a solid"),
    "open": (
        "stl",
        stl(TRIANGLES[1:]),
        "3 edges with a triangle on one side only, expected a closed",
    ),
    "index 0": (
        "obj",
        obj([(-1, 0, 1), *TRIANGLES]),
        "line 9: found vertex index 0, expected 1 to 8",
    ),
    "index 900": (
        "obj",
        obj([*TRIANGLES, (0, 1, 899)]),
        "line 21: found vertex index 900, expected",
    ),
    "no faces": ("obj", obj([]), "found no triangles"),
    "decimal comma": ("obj", obj().replace(".", ","), "line 2: found '0,04'"),
    "too large": (
        "stl",
        stl([], count=5_000_000) + b"\0" * 250_000_000,
        "expected at most 67108864",
    ),
    "millimetres": (
        "obj",
        obj(size=500),
        "500 m long at scale [1 1 1], expected at most 20 m; a file in",
    ),
    "zip": ("zip", b"PK\3\4" + b"\0" * 99, "found a ZIP archive (or 3MF), expected an STL"),
    "bz2": ("bz2", b"BZh9" + b"\0" * 99, "found a bzip2 archive, expected an STL"),
    "zip as STL": ("stl", b"PK\3\4" + b"\0" * 99, "found a ZIP archive (or 3MF), expected an STL"),
    "picture": (
        "obj",
        b"\x89PNG\r\n\x1a\n" + b"\0" * 99,
        "found a file of no known kind, expected an STL",
    ),
    "COLLADA": ("dae", "<COLLADA/>", "found a COLLADA file, expected an STL"),
    "long face": ("obj", obj([tuple(range(8)) * 1000]), "found a face of 8000 corners"),
}


def mesh_cell(bench: Path, ending: str, content: str | bytes) -> None:
    put(bench / f"p.{ending}", content)
    text = CELL.replace("box: [0.04, 0.06, 0.03]", f"mesh: p.{ending}").replace("0.015", "0")
    put(bench / "cell.yaml", text)


@pytest.mark.parametrize("name", MESH_CASES)
def test_a_cell_with_a_wrong_mesh_is_refused_in_one_line(name, bench, capsys):
    ending, content, words = MESH_CASES[name]
    mesh_cell(bench, ending, content)
    (line,) = complaints(bench, capsys)
    assert line.startswith(f"cell.yaml: parts.block.mesh: p.{ending}: ") and words in line


@pytest.mark.parametrize(
    ("ending", "content"),
    [
        ("stl", stl(start=b"solid cube")),
        ("STL", stl()),
        ("obj", stl()),
        ("stl", obj()),
        ("obj", obj(QUADS)),
        ("obj", obj([tuple(i - 9 for i in face) for face in TRIANGLES])),
        ("obj", "mtllib ../../x.mtl\n" + obj()),
    ],
    ids=["solid", "capitals", "STL as OBJ", "OBJ as STL", "polygons", "negative", "material"],
)
def test_an_odd_mesh_is_read_by_its_content_and_its_plan_is_valid(ending, content, bench, capsys):
    mesh_cell(bench, ending, content)
    assert cli.main(["plan", "cell.yaml", "-o", "plan.json"]) == 0
    assert capsys.readouterr().err == ""


# The cell

CELL_CASES: dict[str, tuple[str, str, str]] = {
    "sunk goal": (
        "[0.45, -0.25, 0.015]",
        "[0.45, -0.25, 0]",
        "task[0].at: 'block' overlaps 'table' at its goal by 15.0 mm",
    ),
    "inside": (
        "[0.45, -0.25, 0.015]",
        "[0.45, -0.25, -0.025]",
        "task[0].at: 'block' overlaps 'table'",
    ),
    "in the air": (
        "[0.45, -0.25, 0.015]",
        "[0.45, -0.25, 0.5]",
        "'block' does not stand stably at its goal: nothing is within 0.6 mm below it",
    ),
    "few joints": (
        "robot.yaml}",
        "robot.yaml, start: [0, 0, 0]}",
        "robot.start: expected 6 numbers, one for each arm joint, found 3",
    ),
    "limit": (
        "robot.yaml}",
        "robot.yaml, start: [2.8, 1.57, -1.57, 0, 0, 0]}",
        "robot.start[0]: joint1 = 2.8 rad lies outside its limits -2.79253 to 2.79253 rad",
    ),
    "opening": (
        "robot.yaml}",
        "robot.yaml, start_opening: 0.2}",
        "robot.start_opening: expected an opening from 0 to 0.1 m, found 0.2",
    ),
    "robot in the table": (
        "robot.yaml}",
        "robot.yaml, base: {xyz: [0, 0, -1]}}",
        "robot.start: 'link2' of the robot overlaps 'table' at the start by",
    ),
    "no robot file": ("robot.yaml", "none.yaml", "robot.file: 'none.yaml' cannot be read"),
    "no friction": (
        "box: [0.04",
        "friction: 0, box: [0.04",
        "parts.block.friction: expected a number greater than 0, found 0",
    ),
    "goal on": ("at: {xyz: [0.45, -0.25, 0.015]}", "on: tabel", "task[0].on: there is no fixture"),
}


@pytest.mark.parametrize("name", CELL_CASES)
def test_a_cell_that_cannot_be_is_refused_at_its_place(name, bench, capsys):
    old, new, words = CELL_CASES[name]
    put(bench / "cell.yaml", CELL.replace(old, new))
    line = complaints(bench, capsys)[0]
    assert line.startswith("cell.yaml: ") and words in line


def test_a_part_inside_a_closed_mesh_is_refused(bench, capsys):
    put(bench / "cube.obj", obj(size=0.3))
    heap = "  heap: {mesh: cube.obj, pose: {xyz: [0.35, 0.05, -0.1]}}\nparts:"
    put(bench / "cell.yaml", CELL.replace("parts:", heap))
    lines = complaints(bench, capsys)
    assert any("'heap' and 'block' overlap at the start" in line for line in lines)


@pytest.mark.parametrize(
    ("array", "entry", "words"),
    [
        (np.zeros((0, 3)), "heights: d.npy, cell: 0.01", "heights: 'd.npy' has 0 rows"),
        (np.full((2, 2), np.nan), "heights: d.npy, cell: 0.01", "heights: has no measured entry"),
        (np.array([[{}]], object), "heights: d.npy, cell: 0.01", "entries of kind object"),
        (
            np.ones((4, 4), np.uint16),
            "depth: d.npy, intrinsics: {fx: 10, fy: 10, cx: 2, cy: 2}",
            "depth: holds whole numbers of unknown unit; expected `scale`",
        ),
        (
            np.ones((4, 4)),
            "depth: d.npy, intrinsics: {fx: 10, fy: 10, cx: 320, cy: 2}",
            "intrinsics.cx: 320 lies outside the image, which has 4 columns",
        ),
    ],
)
def test_a_cell_with_a_wrong_depth_map_is_refused_in_one_line(array, entry, words, bench, capsys):
    np.save(bench / "d.npy", array, allow_pickle=True)
    put(bench / "cell.yaml", CELL + f"depth_maps: {{map: {{{entry}}}}}\n")
    (line,) = complaints(bench, capsys)
    assert line.startswith("cell.yaml: depth_maps.map.") and words in line


# The output


def test_an_input_that_the_cell_leads_to_is_not_overwritten(bench, capsys):
    for name in ("puma560.urdf", "robot.yaml", "meshes/link6_flange.obj"):
        content = (bench / name).read_bytes()
        assert cli.main(["plan", "cell.yaml", "-o", name]) == 2
        assert capsys.readouterr().err.startswith(f"handey: {name}: exists, and ends with ")
        assert (bench / name).read_bytes() == content


def test_a_folder_is_no_cell(bench, capsys):
    for name in (".", "meshes"):
        assert cli.main(["plan", name]) == 2
        assert capsys.readouterr().err == f"handey: {name}: is not a regular file\n"
