"""Files that are wrong: each is refused with its kind of fault, its file and its place."""

from __future__ import annotations

import os
import resource
import struct
import time
import zlib
from pathlib import Path

import numpy as np
import pytest

from handey.cell_file import read_cell
from handey.errors import InvalidInput
from handey.formats.strict_yaml import MOST_BYTES, read_yaml
from handey.plan import Plan, Step
from handey.robot_file import read_robot

CELL = """\
handey_cell: 1
name: test
robot: {{file: robot.yaml{robot}}}
fixtures:
  table: {{box: [1.0, 1.0, 0.05], pose: {{xyz: [0.5, 0, -0.025]}}, support: true{table}}}
parts:
  block: {{box: [0.04, 0.06, 0.03], pose: {pose}{block}}}
{more}
task: {task}
"""
TASK = "[{place: block, at: {xyz: [0.4, 0, 0.015]}}]"


def written_cell(folder: Path, **changes: str) -> Path:
    """A small cell file that is right but for `changes`."""
    entries = {"robot": "", "table": "", "block": "", "more": "", "task": TASK}
    entries |= {"pose": "{xyz: [0.5, 0.1, 0.015]}"} | changes
    (folder / "robot.yaml").write_text("handey_robot: 1\n")
    path = folder / "cell.yaml"
    path.write_text(CELL.format(**entries))
    return path


def faults_of(read, path: Path) -> list[tuple[str, str]]:
    with pytest.raises(InvalidInput) as caught:
        read(path)
    assert all(fault.file == str(path) and fault.message for fault in caught.value.faults)
    return [(fault.code, fault.place) for fault in caught.value.faults]


def test_the_cell_that_the_cases_change_is_right(tmp_path):
    cell = read_cell(written_cell(tmp_path))
    assert [part.name for part in cell.parts] == ["block"]
    assert cell.parts[0].X_WB[2, 3] == 0.015


YAML_CASES = {
    "alias": ("a: &x 1\nb: *x\n", "E_YAML_ALIAS"),
    "alias alone": ("a: *x\n", "E_YAML_ALIAS"),
    "cyclic": ("a: &a [*a]\n", "E_YAML_ALIAS"),
    "python tag": ("a: !!python/object/apply:os.system ['true']\n", "E_YAML_TAG"),
    "plain tag": ("a: !!float 1\n", "E_YAML_TAG"),
    "own tag": ("a: !thing {b: 1}\n", "E_YAML_TAG"),
    "duplicate key": ("a: 1\nb: 2\na: 3\n", "E_DUP"),
    "empty": ("", "E_YAML"),
    "comment only": ("# nothing\n", "E_YAML"),
    "null": ("~\n", "E_YAML"),
    "two documents": ("a: 1\n---\nb: 2\n", "E_YAML"),
    "tab": ("a:\n\tb: 1\n", "E_YAML"),
    "nested lists": ("a: " + "[" * 2000 + "]" * 2000, "E_YAML"),
    "nested mappings": ("{a: " * 2000 + "1" + "}" * 2000, "E_YAML"),
    "open bracket": ("a: [1, 2\n", "E_YAML"),
    "NUL": ("a: \0\n", "E_YAML"),
    "key is a list": ("[1, 2]: 3\n", "E_YAML"),
    "explicit key is a mapping": ("? {a: 1}\n: 3\n", "E_YAML"),
}


@pytest.mark.parametrize("name", YAML_CASES)
def test_yaml_that_may_be_misread_is_refused(name, tmp_path):
    text, code = YAML_CASES[name]
    path = tmp_path / "case.yaml"
    path.write_text(text)
    assert [found for found, _ in faults_of(read_yaml, path)][:1] == [code]


def test_a_duplicate_key_is_named_with_both_lines(tmp_path):
    path = tmp_path / "case.yaml"
    path.write_text("a: {b: 1,\n  c: 2,\n  b: 3}\n")
    with pytest.raises(InvalidInput) as caught:
        read_yaml(path)
    assert str(caught.value) == f"{path}: a.b: key 'b' is given twice, first on line 1 (line 3)"


@pytest.mark.parametrize("content", [b"a: \xff\n", "a: 1\n".encode("utf-16"), b"\xfe"])
def test_what_is_not_utf8_is_refused(content, tmp_path):
    path = tmp_path / "case.yaml"
    path.write_bytes(content)
    assert faults_of(read_yaml, path)[0][0] == "E_ENCODING"


def billion_laughs() -> str:
    lines = ["a0: &a0 [lol, lol]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 12)]
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (billion_laughs(), "E_YAML_ALIAS"),
        ("[" + "1," * (MOST_BYTES // 2 - 1) + "1]", "E_YAML"),
        ("- 1\n" * (MOST_BYTES // 4), "E_YAML"),
        ("a: " + "x" * MOST_BYTES, "E_YAML"),
        ("[" * 1_000_000, "E_YAML"),
        ("- " * 1_000_000, "E_YAML"),
        ("{" * 1_000_000, "E_YAML"),
        ("".join(f"k{n}: 1\n" for n in range(500_000)), "E_YAML"),
        ("? " * 500_000, "E_YAML"),
        ("&" + "a" * 5_000_000 + " 1", "E_YAML_ALIAS"),
    ],
    ids=[
        "laughs",
        "flow list",
        "block list",
        "too large",
        "[[[",
        "- - -",
        "{{{",
        "keys",
        "???",
        "&aaa",
    ],
)
def test_a_large_or_deep_text_costs_neither_time_nor_memory(text, code, tmp_path):
    path = tmp_path / "case.yaml"
    path.write_text(text)
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.process_time()
    assert faults_of(read_yaml, path)[0][0] == code
    assert time.process_time() - start < 2.0  # the promise to whoever passes on files of others
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - memory < 256 * 1024


def test_files_that_are_no_regular_files_are_refused(tmp_path):
    os.mkfifo(tmp_path / "fifo.yaml")
    (tmp_path / "loop.yaml").symlink_to(tmp_path / "loop.yaml")
    for path in (tmp_path / "fifo.yaml", tmp_path / "loop.yaml", tmp_path, tmp_path / "none.yaml"):
        assert faults_of(read_yaml, path) == [("E_PATH", "")]
    assert faults_of(read_yaml, Path("/dev/zero")) == [("E_PATH", "")]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-3", 0.001),
        ("1E+3", 1000.0),
        (".5", 0.5),
        ("5.", 5.0),
        ("-2", -2),
        ("+0.5e2", 50.0),
        ("010", "010"),
        ("1:30", "1:30"),
        ("off", "off"),
        ("yes", "yes"),
        ("0x1F", "0x1F"),
        ("1_000", "1_000"),
        ("2001-01-01", "2001-01-01"),
        ("'1'", "1"),
        ("true", True),
        ("~", None),
        ("1e", "1e"),
        ("e5", "e5"),
        ("<<", "<<"),
    ],
)
def test_a_scalar_means_what_it_looks_like(text, value, tmp_path):
    path = tmp_path / "case.yaml"
    path.write_text(f"a: {text}\n")
    found = read_yaml(path).value["a"]
    assert found == value and type(found) is type(value)


CELL_CASES = {
    "unknown key": ({"block": ", poze: {}"}, "E_UNKNOWN_KEY", "parts.block.poze"),
    "merge key": ({"block": ", <<: {}"}, "E_UNKNOWN_KEY", "parts.block.<<"),
    "margin": ({"more": "margin: -1"}, "E_UNKNOWN_KEY", "margin"),
    "sexagesimal": ({"pose": "{xyz: [1:30, 0, 0]}"}, "E_TYPE", "parts.block.pose.xyz[0]"),
    "octal": ({"pose": "{xyz: [010, 0, 0]}"}, "E_TYPE", "parts.block.pose.xyz[0]"),
    "off": ({"pose": "{xyz: [off, 0, 0]}"}, "E_TYPE", "parts.block.pose.xyz[0]"),
    "true for a number": ({"pose": "{xyz: [true, 0, 0]}"}, "E_TYPE", "parts.block.pose.xyz[0]"),
    "text for a number": ({"pose": "{xyz: ['1', 0, 0]}"}, "E_TYPE", "parts.block.pose.xyz[0]"),
    "nothing for a number": ({"pose": "{xyz: [~, 0, 0]}"}, "E_TYPE", "parts.block.pose.xyz[0]"),
    "nan": ({"pose": "{xyz: [.nan, 0, 0]}"}, "E_NUMBER", "parts.block.pose.xyz[0]"),
    "inf": ({"pose": "{xyz: [-.inf, 0, 0]}"}, "E_NUMBER", "parts.block.pose.xyz[0]"),
    "1e400": ({"pose": "{xyz: [1e400, 0, 0]}"}, "E_NUMBER", "parts.block.pose.xyz[0]"),
    "1e30": ({"pose": "{xyz: [1e30, 0, 0]}"}, "E_RANGE", "parts.block.pose.xyz[0]"),
    "long integer": (
        {"pose": f"{{xyz: [{'9' * 400}, 0, 0]}}"},
        "E_NUMBER",
        "parts.block.pose.xyz[0]",
    ),
    "norm": (
        {"pose": "{quat_xyzw: [0, 0, 0, 1.01]}"},
        "E_QUATERNION",
        "parts.block.pose.quat_xyzw",
    ),
    "zero norm": (
        {"pose": "{quat_xyzw: [0, 0, 0, 0]}"},
        "E_QUATERNION",
        "parts.block.pose.quat_xyzw",
    ),
    "undeclared order": (
        {"pose": "{quat: [0, 0, 0, 1]}"},
        "E_UNKNOWN_KEY",
        "parts.block.pose.quat",
    ),
    "two rotations": (
        {"pose": "{rpy: [0, 0, 0], quat_xyzw: [0, 0, 0, 1]}"},
        "E_TYPE",
        "parts.block.pose",
    ),
    "pose is a list": ({"pose": "[0, 0, 0, 0, 0]"}, "E_TYPE", "parts.block.pose"),
    "two numbers": ({"pose": "{xyz: [0, 0]}"}, "E_TYPE", "parts.block.pose.xyz"),
    "name of a fixture": ({"more": "  table: {box: [1, 1, 1]}"}, "E_DUP", "parts.table"),
    "unknown part": ({"task": "[{place: blok, on: table}]"}, "E_REF", "task[0].place"),
    "unknown fixture": ({"task": "[{place: block, on: tabel}]"}, "E_REF", "task[0].on"),
    "on a part": ({"task": "[{place: block, inside: block}]"}, "E_REF", "task[0].inside"),
    "no place": ({"task": "[{on: table}]"}, "E_MISSING", "task[0].place"),
    "no target": ({"task": "[{place: block}]"}, "E_MISSING", "task[0]"),
    "two targets": ({"task": "[{place: block, on: table, inside: table}]"}, "E_TYPE", "task[0]"),
    "resting with at": (
        {"task": "[{place: block, at: {}, resting: same}]"},
        "E_UNKNOWN_KEY",
        "task[0].resting",
    ),
    "region": (
        {"task": "[{place: block, on: table, region: [[0, 0], [1, 0]]}]"},
        "E_RANGE",
        "task[0].region",
    ),
    "task is a mapping": ({"task": "{place: block}"}, "E_TYPE", "task"),
    "order": ({"more": "order: none"}, "E_TYPE", "order"),
    "finish": ({"more": "finish: home"}, "E_TYPE", "finish"),
    "two geometries": ({"block": ", sphere: {radius: 1}"}, "E_TYPE", "parts.block"),
    "nested shapes": (
        {"more": "  b: {shapes: [{box: [1, 1, 1], shapes: []}]}"},
        "E_UNKNOWN_KEY",
        "parts.b.shapes[0].shapes",
    ),
    "no shapes": ({"more": "  b: {shapes: []}"}, "E_TYPE", "parts.b.shapes"),
    "no geometry": ({"more": "  b: {pose: {}}"}, "E_MISSING", "parts.b"),
    "negative box": ({"more": "  b: {box: [1, -1, 1]}"}, "E_RANGE", "parts.b.box[1]"),
    "zero radius": ({"more": "  b: {sphere: {radius: 0}}"}, "E_RANGE", "parts.b.sphere.radius"),
    "no length": ({"more": "  b: {cylinder: {radius: 1}}"}, "E_MISSING", "parts.b.cylinder.length"),
    "scale of a box": ({"block": ", scale: 0.001"}, "E_UNKNOWN_KEY", "parts.block.scale"),
    "zero scale": ({"more": "  b: {mesh: cell.yaml, scale: 0}"}, "E_SCALE", "parts.b.scale"),
    "missing mesh": ({"more": "  b: {mesh: b.stl}"}, "E_PATH", "parts.b.mesh"),
    "mesh is a folder": ({"more": "  b: {mesh: ../}"}, "E_PATH", "parts.b.mesh"),
    "mesh is a URL": (
        {"more": "  b: {mesh: 'http://example.org/b.stl'}"},
        "E_PATH",
        "parts.b.mesh",
    ),
    "mesh is a device": ({"more": "  b: {mesh: /dev/zero}"}, "E_PATH", "parts.b.mesh"),
    "friction of a fixture": (
        {"table": ", friction: 1"},
        "E_UNKNOWN_KEY",
        "fixtures.table.friction",
    ),
    "zero mass": ({"block": ", mass: 0"}, "E_RANGE", "parts.block.mass"),
    "negative friction": ({"block": ", friction: -1"}, "E_RANGE", "parts.block.friction"),
    "yes for true": ({"block": ", may_move: yes"}, "E_TYPE", "parts.block.may_move"),
    "opening": ({"robot": ", start_opening: -0.1"}, "E_RANGE", "robot.start_opening"),
    "start is a text": ({"robot": ", start: home"}, "E_TYPE", "robot.start"),
    "comma in a number": ({"block": ", mass: '1,5'"}, "E_TYPE", "parts.block.mass"),
}


@pytest.mark.parametrize("name", CELL_CASES)
def test_a_wrong_cell_file_is_refused_at_its_place(name, tmp_path):
    changes, code, place = CELL_CASES[name]
    assert faults_of(read_cell, written_cell(tmp_path, **changes)) == [(code, place)]


def test_all_faults_of_a_cell_file_are_told_together_in_its_order(tmp_path):
    path = tmp_path / "cell.yaml"
    path.write_text(
        "handey_cell: 2\nname: 3\nparts:\n  a: {box: [1, 1]}\n  b: {bax: [1, 1, 1]}\n"
        "task: [{place: c, on: d}]\n"
    )
    assert faults_of(read_cell, path) == [
        ("E_MISSING", "robot"),
        ("E_VERSION", "handey_cell"),
        ("E_TYPE", "name"),
        ("E_TYPE", "parts.a.box"),
        ("E_UNKNOWN_KEY", "parts.b.bax"),
        ("E_MISSING", "parts.b"),
        ("E_REF", "task[0].place"),
        ("E_REF", "task[0].on"),
    ]


def test_an_unknown_key_names_the_nearest_legal_one(tmp_path):
    path = written_cell(tmp_path, block=", frictoin: 0.3")
    with pytest.raises(InvalidInput, match="unknown key 'frictoin'; did you mean 'friction'"):
        read_cell(path)


# Depth maps


def png(
    rows: int, columns: int, bits: int = 16, colour: int = 0, pixels: bytes | None = None
) -> bytes:
    def chunk(kind: bytes, body: bytes) -> bytes:
        return (
            struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        )

    header = struct.pack(">IIBBBBB", columns, rows, bits, colour, 0, 0, 0)
    if pixels is None:
        pixels = (b"\0" + b"\1\0" * columns) * rows
    body = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + body


def depth_cell(folder: Path, entry: str, **arrays) -> Path:
    for name, content in arrays.items():
        if isinstance(content, bytes):
            (folder / f"{name}.png").write_bytes(content)
        else:
            np.save(folder / f"{name}.npy", content, allow_pickle=True)
    return written_cell(folder, more=f"depth_maps:\n  map: {{{entry}}}")


CAMERA = "intrinsics: {fx: 10, fy: 10, cx: 4, cy: 3}"


def test_depth_maps_are_read(tmp_path):
    heights = np.array([[0.1, np.nan, 0.2]] * 4)
    entry = "heights: h.npy, cell: 0.002, pose: {xyz: [0.3, 0, 0]}"
    (found,) = read_cell(depth_cell(tmp_path, entry, h=heights)).depth_maps
    assert (found.kind, found.shape, found.cell) == ("heights", (4, 3), 0.002)
    entry = f"depth: d.png, scale: 0.001, {CAMERA}"
    (found,) = read_cell(depth_cell(tmp_path, entry, d=png(6, 8))).depth_maps
    assert (found.shape, found.scale, found.explained, found.far) == ((6, 8), 0.001, 0.005, 0.3)
    some = np.full((6, 8), np.nan)
    some[2, 3] = 1.0
    (found,) = read_cell(depth_cell(tmp_path, f"depth: d.npy, {CAMERA}", d=some)).depth_maps
    assert found.shape == (6, 8)


DEPTH_CASES = {
    "zero size": ("heights: h.npy, cell: 1", {"h": np.zeros((0, 3))}, "E_IMAGE", "heights"),
    "zero-size image": (f"depth: d.png, scale: 1, {CAMERA}", {"d": png(0, 8)}, "E_IMAGE", "depth"),
    "all NaN": ("heights: h.npy, cell: 1", {"h": np.full((2, 2), np.nan)}, "E_IMAGE", "heights"),
    "infinite": ("heights: h.npy, cell: 1", {"h": np.array([[1, np.inf]])}, "E_NUMBER", "heights"),
    "undeclared unit": (f"depth: d.png, {CAMERA}", {"d": png(6, 8)}, "E_UNITS", "depth"),
    "undeclared unit of an array": (
        f"depth: d.npy, {CAMERA}",
        {"d": np.zeros((6, 8), np.uint16)},
        "E_UNITS",
        "depth",
    ),
    "whole heights": (
        "heights: h.npy, cell: 1",
        {"h": np.zeros((2, 2), int)},
        "E_UNITS",
        "heights",
    ),
    "fx": (
        "depth: d.png, scale: 1, intrinsics: {fx: 0, fy: 10, cx: 4, cy: 3}",
        {"d": png(6, 8)},
        "E_CAMERA",
        "intrinsics.fx",
    ),
    "fy": (
        "depth: d.png, scale: 1, intrinsics: {fx: 10, fy: .nan, cx: 4, cy: 3}",
        {"d": png(6, 8)},
        "E_CAMERA",
        "intrinsics.fy",
    ),
    "cx": (
        "depth: d.png, scale: 1, intrinsics: {fx: 10, fy: 10, cx: 320, cy: 3}",
        {"d": png(6, 8)},
        "E_CAMERA",
        "intrinsics.cx",
    ),
    "pickle": ("heights: h.npy, cell: 1", {"h": np.array([[{}]], object)}, "E_NPY", "heights"),
    "texts": ("heights: h.npy, cell: 1", {"h": np.array([["a"]])}, "E_NPY", "heights"),
    "complex": ("heights: h.npy, cell: 1", {"h": np.array([[1j]])}, "E_NPY", "heights"),
    "three dimensions": ("heights: h.npy, cell: 1", {"h": np.zeros((2, 2, 2))}, "E_NPY", "heights"),
    "image of heights": ("heights: h.png, cell: 1", {"h": png(6, 8)}, "E_UNSUPPORTED", "heights"),
    "bomb": (
        f"depth: d.png, scale: 1, {CAMERA}",
        {"d": png(60000, 60000, pixels=b"")},
        "E_TOO_BIG",
        "depth",
    ),
    "unpacks to more": (
        f"depth: d.png, scale: 1, {CAMERA}",
        {"d": png(6, 8, pixels=b"\0" * 10**8)},
        "E_IMAGE",
        "depth",
    ),
    "nothing measured": (
        f"depth: d.npy, {CAMERA}",
        {"d": np.full((6, 8), np.nan)},
        "E_IMAGE",
        "depth",
    ),
    "negative depth": (
        f"depth: d.npy, {CAMERA}",
        {"d": np.full((6, 8), -0.5)},
        "E_NUMBER",
        "depth",
    ),
    "8 bits": (f"depth: d.png, scale: 1, {CAMERA}", {"d": png(6, 8, bits=8)}, "E_IMAGE", "depth"),
    "colour": (f"depth: d.png, scale: 1, {CAMERA}", {"d": png(6, 8, colour=2)}, "E_IMAGE", "depth"),
    "cut off": (f"depth: d.png, scale: 1, {CAMERA}", {"d": png(6, 8)[:-20]}, "E_IMAGE", "depth"),
    "no image": (f"depth: d.png, scale: 1, {CAMERA}", {"d": b"PNG"}, "E_IMAGE", "depth"),
    "no cell": ("heights: h.npy", {"h": np.zeros((2, 2))}, "E_MISSING", "cell"),
    "negative cell": ("heights: h.npy, cell: -1", {"h": np.zeros((2, 2))}, "E_RANGE", "cell"),
}


@pytest.mark.parametrize("name", DEPTH_CASES)
def test_a_wrong_depth_map_is_refused(name, tmp_path):
    entry, arrays, code, place = DEPTH_CASES[name]
    assert faults_of(read_cell, depth_cell(tmp_path, entry, **arrays)) == [
        (code, f"depth_maps.map.{place}")
    ]


@pytest.mark.parametrize(
    "content", [b"", b"\x93NUMPY", b"PK\x03\x04", b"\x93NUMPY\x01\x00\xff\xff{", b"x" * 99]
)
def test_a_broken_array_file_is_refused(content, tmp_path):
    path = written_cell(tmp_path, more="depth_maps: {map: {heights: h.npy, cell: 1}}")
    (tmp_path / "h.npy").write_bytes(content)
    assert faults_of(read_cell, path) == [("E_NPY", "depth_maps.map.heights")]


def test_an_array_file_that_claims_more_than_it_has_is_refused(tmp_path):
    path = written_cell(tmp_path, more="depth_maps: {map: {heights: h.npy, cell: 1}}")
    header = "{'descr': '<f8', 'fortran_order': False, 'shape': (4000000000, 4000000000), }"
    header = header.ljust(117) + "\n"
    content = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode()
    (tmp_path / "h.npy").write_bytes(content)
    assert faults_of(read_cell, path) == [("E_TOO_BIG", "depth_maps.map.heights")]
    (tmp_path / "h.npy").write_bytes(
        content.replace(b"4000000000, 4000000000", b"        40,         40")
    )
    assert faults_of(read_cell, path) == [("E_NPY", "depth_maps.map.heights")]


# The robot file

ROBOT = """\
handey_robot: 1
name: arm
urdf: arm.urdf
arm: [joint1, joint2]
home: [0.0, 1.5]
gripper:
  link: gripper
  grasp_frame: {xyz: [0, 0, 0.12]}
  fingers: [left, right]
  opening: [0.0, 0.1]
  pad: {width: 0.02, length: 0.03}
"""
ROBOT_CASES = {
    "home too short": ("home: [0.0, 1.5]", "home: [0.0]", "E_DOF", "home"),
    "degrees are no texts": ("home: [0.0, 1.5]", "home: [0.0, 90deg]", "E_TYPE", "home[1]"),
    "no gripper": (ROBOT[ROBOT.index("gripper:") :], "", "E_MISSING", "gripper"),
    "joint twice": ("[joint1, joint2]", "[joint1, joint1]", "E_DUP", "arm"),
    "no joint": ("arm: [joint1, joint2]", "arm: []", "E_TYPE", "arm"),
    "finger twice": ("[left, right]", "[left, left]", "E_DUP", "gripper.fingers"),
    "one finger": ("[left, right]", "[left]", "E_TYPE", "gripper.fingers"),
    "finger in the arm": ("[left, right]", "[left, joint1]", "E_DUP", "gripper"),
    "opening reversed": ("[0.0, 0.1]", "[0.1, 0.0]", "E_RANGE", "gripper.opening"),
    "negative opening": ("[0.0, 0.1]", "[-0.1, 0.1]", "E_RANGE", "gripper.opening[0]"),
    "pad": ("width: 0.02", "width: 0", "E_RANGE", "gripper.pad.width"),
    "pad of one size": ("width: 0.02, ", "", "E_MISSING", "gripper.pad.width"),
    "misspelt": ("gripper:", "griper:", "E_UNKNOWN_KEY", "griper"),
    "no URDF": ("arm.urdf", "arm2.urdf", "E_PATH", "urdf"),
    "no grasp frame": (
        "  grasp_frame: {xyz: [0, 0, 0.12]}\n",
        "",
        "E_MISSING",
        "gripper.grasp_frame",
    ),
    "version": ("handey_robot: 1", "handey_robot: 1.0", "E_VERSION", "handey_robot"),
    "acceleration": ("urdf:", "acceleration: [5, 0]\nurdf:", "E_RANGE", "acceleration[1]"),
    "accelerations": ("urdf:", "acceleration: [5]\nurdf:", "E_DOF", "acceleration"),
    "pair": ("urdf:", "ignore_collisions: [[a, b], [c]]\nurdf:", "E_TYPE", "ignore_collisions[1]"),
}


@pytest.mark.parametrize("name", ROBOT_CASES)
def test_a_wrong_robot_file_is_refused_at_its_place(name, tmp_path):
    old, new, code, place = ROBOT_CASES[name]
    (tmp_path / "arm.urdf").write_text("<robot/>")
    path = tmp_path / "robot.yaml"
    path.write_text(ROBOT)
    assert read_robot(path).gripper.opening == (0.0, 0.1)
    assert old in ROBOT
    path.write_text(ROBOT.replace(old, new))
    assert (code, place) in faults_of(read_robot, path)


# Anything at all


def spoilt(random: np.random.Generator, content: bytes) -> bytes:
    """The content with a few bytes changed, lost, doubled or put in."""
    for _ in range(random.integers(1, 6)):
        at, size = int(random.integers(len(content))), int(random.integers(1, 12))
        piece = content[at : at + size]
        other = int(random.integers(len(content)))
        new = [
            b"",
            piece + piece,
            bytes(random.integers(0, 256, size, dtype=np.uint8)),
            content[other : other + size],
            bytes(random.choice(list(b"[]{}:,-&*!|>'\"%@`~#?\n\t 0.e"), size).tolist()),
        ][random.integers(5)]
        content = content[:at] + new + content[at + size :]
    return content


STEP = Step("depart", 0, "b", np.eye(4), [0.0, 0.1], [[1.0], [1.5e-3]], [0.1, 0.1])
PLAN = Plan("c", ("a",), (STEP,), {"b": np.eye(4)})
SPOILT = {
    "cell": (
        read_cell,
        CELL.format(
            robot="", table="", block="", more="", task=TASK, pose="{xyz: [0.5, 0.1, 1.5e-2]}"
        ),
    ),
    "robot": (read_robot, ROBOT),
    "plan": (Plan.load, PLAN.to_json()),
}


@pytest.mark.parametrize("name", SPOILT)
def test_a_spoilt_file_is_read_or_refused_and_nothing_else(name, tmp_path):
    read, text = SPOILT[name]
    (tmp_path / "robot.yaml").write_text("handey_robot: 1\n")
    (tmp_path / "arm.urdf").write_text("<robot/>")
    path, random, refused = tmp_path / "spoilt", np.random.default_rng(8), 0
    for _ in range(1500):
        path.write_bytes(spoilt(random, text.encode()))
        try:
            read(path)
        except InvalidInput as error:
            refused += 1
            assert error.faults and all(fault.code and fault.message for fault in error.faults)
    assert refused > 300
