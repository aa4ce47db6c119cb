"""What `handey inspect` tells of parts, robots and cells, against what is known of them."""

from __future__ import annotations

import base64
import json
import math
import re
import shutil
import time

import numpy as np
import pytest
from hand_made import ROOT

import handey
from handey import _core, cli
from handey.cell_file import load_cell
from handey.errors import InvalidInput
from handey.inspection import inspect_body, inspect_cell, inspect_mesh, inspect_robot
from handey.inspection.page import write_page
from handey.inspection.text import direction, listed, part_lines, robot_lines
from handey.robot_file import load_robot

PARTS, CELLS = ROOT / "models" / "parts", ROOT / "models" / "cells"
ROBOT = ROOT / "models" / "robots" / "puma560" / "robot.yaml"
SHARED = ROOT.parent / "shared" / "data" / "parts"
MM = 1e-3
needs_browser = pytest.mark.skipif(
    not (shutil.which("chromedriver") and (shutil.which("chromium") or shutil.which("chrome"))),
    reason="no chromium, chromedriver",
)


@pytest.fixture(scope="module")
def robot():
    return load_robot(ROBOT)[0]


@pytest.fixture(scope="module")
def bracket(robot):
    return inspect_mesh(PARTS / "bracket.stl", MM, robot)


@pytest.fixture(scope="module")
def demo():
    return inspect_cell(load_cell(CELLS / "demo.yaml"))


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


# -------------------------------------------------------------------------------------------- part


def test_a_box_has_six_ways_to_stand_and_three_pairs_of_faces(tmp_path, robot):
    path = write_obj(tmp_path / "box.obj", box_corners(0.04, 0.06, 0.05), triangles(BOX))
    report = inspect_mesh(path, 1.0, robot)
    assert report.size == pytest.approx([0.04, 0.06, 0.05])
    assert report.volume == pytest.approx(0.04 * 0.06 * 0.05)
    assert report.centre == pytest.approx([0.02, 0.03, 0.025])
    assert report.closed and len(report.faces) == 6
    areas = sorted((face.area for face in report.faces), reverse=True)
    assert areas == pytest.approx([0.003, 0.003, 0.0024, 0.0024, 0.002, 0.002])
    widths = {round(p.width, 6): p.area for p in report.pairs if p.kind.name == "FaceFace"}
    assert widths == pytest.approx({0.04: 0.003, 0.05: 0.0024, 0.06: 0.002})
    assert len(report.rests) == 6
    assert sum(rest.probability for rest in report.rests) == pytest.approx(1.0)
    assert [r.probability for r in report.rests] == sorted(
        (r.probability for r in report.rests), reverse=True
    )
    for rest in report.rests:  # by hand: half the edge that it stands on, over the height
        assert rest.tip_angle == pytest.approx(math.atan2(rest.margin, rest.height))
    assert report.warnings == ()


def test_an_open_mesh_tells_where_it_is_open(tmp_path, robot):
    corners = box_corners(0.04, 0.06, 0.05)
    path = write_obj(tmp_path / "open.obj", corners, triangles([*BOX[:1], *BOX[2:]]))
    report = inspect_mesh(path, 1.0, robot)
    (hole,) = report.surfaces[0].holes
    assert not report.closed and report.volume is None and report.rests == ()
    assert (hole.edges, hole.length) == (4, pytest.approx(0.2))
    assert hole.centre == pytest.approx([0.02, 0.03, 0.05])
    assert {tuple(np.round(p, 6)) for p in hole.segments.reshape(-1, 3)} == set(corners[4:])
    told = "\n".join(part_lines(report))
    assert "NOT closed: 4 open edges" in told
    assert "4 open edges, 200.0 mm long, about (20.0, 30.0, 50.0) mm" in told
    assert told.count("the surface is not closed") == 2


def test_two_holes_are_two_and_the_longer_comes_first(tmp_path):
    faces = triangles([BOX[1], *BOX[2:]])[1:]  # without the bottom, and half of the top
    path = write_obj(tmp_path / "open.obj", box_corners(0.04, 0.06, 0.05), faces)
    surface = inspect_mesh(path).surfaces[0]
    assert [hole.edges for hole in surface.holes] == [4, 3]
    assert surface.open_edges == _core.inspect_surface(_core.load_mesh(path).mesh).open_edges == 7
    assert surface.holes[0].centre[2] == 0.0 and surface.holes[1].centre[2] == pytest.approx(0.05)


def test_an_edge_of_four_triangles_is_told(tmp_path):
    first = box_corners(0.04, 0.04, 0.04)
    second = [(x + 0.04, y + 0.04, z) for x, y, z in first]  # they share one edge
    quads = [*BOX, *[tuple(i + 8 for i in quad) for quad in BOX]]
    path = write_obj(tmp_path / "edge.obj", [*first, *second], triangles(quads))
    surface = inspect_mesh(path).surfaces[0]
    assert surface.closed and not surface.manifold
    assert surface.overfull == pytest.approx(np.array([[0.04, 0.04, 0.02]]))


@pytest.mark.parametrize(
    ("scale", "edge", "wanted"),
    [(1.0, 30.0, "0.001"), (1.0, 80.0, "0.001"), (MM, 0.03, "1"), (1e-6, 40.0, "0.001")],
)
def test_a_part_in_another_unit_is_told_with_the_scale_that_helps(tmp_path, scale, edge, wanted):
    path = write_obj(tmp_path / "box.obj", box_corners(edge, edge, edge), triangles(BOX))
    (warning,) = inspect_mesh(path, scale).warnings
    assert f"--scale {wanted} makes it" in warning
    assert inspect_mesh(path, float(wanted)).warnings == ()


def test_what_jaws_do_not_span_is_told_with_how_much_is_missing(robot):
    report = inspect_mesh(PARTS / "big_cube.stl", MM, robot)
    assert report.pairs == [] and len(report.rejected) == 9
    faces = report.rejected[:3]
    assert [str(pair)[:5] for pair in faces] == ["faces"] * 3
    assert [report.short(pair) for pair in faces] == pytest.approx([0.024] * 3)
    assert "faces 0/1: 120.0 mm wide, the jaws open 24.0 mm too little" in "\n".join(
        part_lines(report)
    )


def test_pairs_are_those_that_planning_looks_at(bracket, robot):
    mesh = _core.load_mesh(PARTS / "bracket.stl", scale=MM).mesh
    body = _core.Body(name="p", shapes=[_core.Shape(_core.MeshShape(mesh))])
    found = _core.find_feature_pairs(body, robot.gripper)
    assert [str(pair) for pair in bracket.pairs] == [str(pair) for pair in found.pairs]
    assert bracket.kinds() == {"two faces": 9, "parallel edges": 18}


def test_without_jaws_no_pair_is_told(tmp_path):
    report = inspect_mesh(PARTS / "bracket.stl", MM)
    assert report.features is None and report.as_dict()["jaws"] is None
    assert "--robot ROBOT.yaml" in "\n".join(part_lines(report))


def test_a_part_of_several_shapes_is_one_part(robot):
    half = _core.Box([0.04, 0.04, 0.02])
    X_up, X_down = np.eye(4), np.eye(4)
    X_up[2, 3], X_down[2, 3] = 0.01, -0.01
    body = _core.Body(name="two", shapes=[_core.Shape(half, X_up), _core.Shape(half, X_down)])
    report = inspect_body(body, robot)
    assert report.size == pytest.approx([0.04] * 3) and report.volume == pytest.approx(0.04**3)
    assert len(report.surfaces) == 2 and len(report.rests) == 6 and report.smaller_faces == 0
    assert {round(p.width, 6) for p in report.pairs if p.kind.name == "FaceFace"} == {0.04}


@pytest.mark.parametrize("path", sorted(PARTS.glob("*.stl")), ids=lambda path: path.stem)
def test_the_text_of_a_part_fits_a_screen(path, robot):
    report = inspect_mesh(path, MM, robot)
    lines = part_lines(report)
    assert len(lines) <= 40
    assert max(map(len, lines)) <= 80
    assert len(part_lines(report, verbose=True)) >= len(lines)
    assert sum(r.probability for r in report.rests) == pytest.approx(1.0)


@pytest.mark.skipif(not SHARED.is_dir(), reason="no shared parts")
@pytest.mark.parametrize("path", sorted(SHARED.glob("*.[so][tb][lj]")), ids=lambda path: path.name)
def test_real_parts_are_told(path, robot, tmp_path):
    report = inspect_mesh(path, MM, robot)
    summary = json.loads(json.dumps(report.as_dict(), allow_nan=False))
    report_closed = _core.load_mesh(path, scale=MM).surface.closed
    assert summary["closed"] == report_closed
    assert summary["closed"] == (summary["surfaces"][0]["open_edges"] == 0)
    if report.rests:
        assert sum(r["probability"] for r in summary["placements"]) == pytest.approx(1.0)
    write_page(report, tmp_path / "page.html")


# ------------------------------------------------------------------------------------------- robot


def test_the_reach_is_where_the_hand_gets(robot):
    report = inspect_robot(robot)
    assert report.objection == "" and report.reach is not None
    solver = _core.SphericalWristSolver(robot)
    row = next(row for row in report.reach.rows if row.height == pytest.approx(0.2))
    ((low, high),) = row.ranges["down"]

    def reaches(radius):
        X_RH = np.diag([1.0, -1.0, -1.0, 1.0])
        X_RH[:3, 3] = [radius, 0.0, 0.2]
        return bool(solver.solve(X_RH).solutions)

    assert reaches((low + high) / 2) and reaches(high) and not reaches(high + 0.02)
    assert 0.1 < low < 0.4 < 0.7 < high < 1.0
    assert report.nearest == ("link3", "link5")
    assert ("link4", "link6") in report.ignored and ("link1", "link2") in report.joined


def test_the_text_of_a_robot_fits_a_screen(robot):
    lines = robot_lines(inspect_robot(robot))
    assert len(lines) <= 40 and max(map(len, lines)) <= 80
    assert any(line.split()[:4] == ["joint1", "-160.0", "160.0", "100.0"] for line in lines)


def test_why_a_robot_cannot_be_planned_for_is_told(tmp_path):
    folder = tmp_path / "puma"
    shutil.copytree(ROBOT.parent, folder)
    urdf = folder / "puma560.urdf"
    origin = '<origin xyz="0.4318 0 0.15005"/>'
    assert urdf.read_text().count(origin) == 1
    turned = origin.replace("/>", ' rpy="0.3 0.2 0.1"/>')
    urdf.write_text(urdf.read_text().replace(origin, turned))
    report = inspect_robot(*load_robot(folder / "robot.yaml"))
    assert "axes 2 and 3" in report.objection and report.reach is None
    assert "NOT supported" in "\n".join(robot_lines(report))
    assert report.as_dict()["inverse_kinematics"]["supported"] is False
    cell = (CELLS / "on_table.yaml").read_text().replace("../robots/puma560", str(folder))
    (tmp_path / "cell.yaml").write_text(cell.replace("../parts", str(PARTS)))
    report = inspect_cell(load_cell(tmp_path / "cell.yaml"))
    assert "axes 2 and 3" in report.objection
    assert [goal.verdict for goal in report.goals] == ["not known", "not known"]
    assert all(figures.held is None and figures.part.pairs for figures in report.parts)
    write_page(report, tmp_path / "page.html")


def test_a_urdf_alone_tells_what_was_taken_for_what(capsys, tmp_path):
    status, out, err = run(capsys, ROBOT.parent / "puma560.urdf", "--json")
    summary = json.loads(out)
    assert (status, err) == (0, "")
    assert [joint["name"] for joint in summary["joints"]] == [f"joint{i}" for i in range(1, 7)]
    assert "no robot file" in summary["warnings"][0]
    assert summary["jaws"]["opening_m"] == [0.0, 0.1]
    bare = tmp_path / "bare.urdf"
    bare.write_text('<robot name="r"><link name="a"/></robot>')
    status, out, err = run(capsys, bare)
    assert (status, out) == (2, "")
    assert err.startswith(f"handey: {bare}: found no single longest chain of revolute joints")


def test_a_urdf_without_fingers_tells_the_kinematics(capsys, tmp_path, robot):
    text = (ROBOT.parent / "puma560.urdf").read_text()
    for finger in ("left_finger", "right_finger"):
        text = re.sub(rf'<joint name="{finger}_joint".*?</joint>', "", text, flags=re.S)
        text = re.sub(rf'<link name="{finger}">.*?</link>', "", text, flags=re.S)
    (tmp_path / "arm.urdf").write_text(text)  # its meshes are not there: shapes are not read
    status, out, err = run(capsys, tmp_path / "arm.urdf", "--json")
    summary = json.loads(out)
    assert (status, err) == (0, "")
    assert [joint["name"] for joint in summary["joints"]] == [f"joint{i}" for i in range(1, 7)]
    lower = [joint["lower_rad"] for joint in summary["joints"]]
    assert lower == pytest.approx([joint.limit.lower for joint in robot.joints])
    assert not any("made_up" in name for name in summary["bodies"])
    assert summary["jaws"] is None and "shapes are not looked at" in summary["warnings"][0]
    assert summary["inverse_kinematics"]["supported"] and len(summary["reach"]["rows"]) >= 4
    assert "jaws      none" in run(capsys, tmp_path / "arm.urdf", "-o", tmp_path / "a.html")[1]
    sticks = scene_of(tmp_path / "a.html")["sticks"]
    assert len(sticks) == 7 and len(sticks[0]) == 8
    (tmp_path / "slow.urdf").write_text(re.sub(r'velocity="[^"]*"', 'velocity="0"', text))
    status, out, err = run(capsys, tmp_path / "slow.urdf")
    assert (status, out) == (2, "")
    assert err.splitlines()[0].startswith(f"handey: {tmp_path / 'slow.urdf'}: joint 'joint1': the")
    (tmp_path / "no.urdf").write_text("<robot")
    assert run(capsys, tmp_path / "no.urdf")[0] == 2
    assert run(capsys, tmp_path / "none.urdf")[0] == 2


def test_verbose_leaves_nothing_out(capsys):
    cell = CELLS / "restack.yaml"
    short, long = (run(capsys, cell, *more)[1].splitlines() for more in ((), ("--verbose",)))
    assert len(short) <= 40 < len(long)
    assert sum("ways, when it falls" in line for line in long) == 5
    robot_lines_ = run(capsys, ROBOT, "--verbose")[1]
    assert "base_link/link1" in robot_lines_


def test_a_cell_that_cannot_be_is_bad_input(capsys):
    status, out, err = run(capsys, CELLS / "bad_start_in_solid.yaml")
    assert (status, out) == (2, "") and "overlap at the start by 80.0 mm" in err


# -------------------------------------------------------------------------------------------- cell


def test_a_cell_tells_what_stands_on_what_and_what_can_be_held(demo):
    on = {figures.part.name: figures.standing.on for figures in demo.parts}
    assert on == {"bracket": ("table",), "block": ("tray",), "hex_peg": ("tray",)}
    assert all(figures.held.legal > 0 for figures in demo.parts)
    assert [goal.verdict for goal in demo.goals] == ["within reach"]
    assert [name for name, _ in demo.supports] == ["table"]
    summary = json.loads(json.dumps(demo.as_dict(), allow_nan=False))
    assert summary["supports"]["table"]["area_m2"] == pytest.approx(1.6 * 1.4)


@pytest.mark.parametrize(
    ("cell", "verdicts"),
    [
        ("impossible_out_of_reach", ["no grasp found there"]),
        ("impossible_too_wide", ["no grasp found where it stands"]),
        ("impossible_closed_box", ["no grasp found where it stands"]),
        ("already_met", ["met already"]),
        ("figure_1", ["by a regrasp at best"]),
        ("on_table", ["within reach", "within reach"]),
    ],
)
def test_the_goals_of_a_cell_are_told(cell, verdicts):
    report = inspect_cell(load_cell(CELLS / f"{cell}.yaml"))
    assert [goal.verdict for goal in report.goals] == verdicts


def test_what_the_planner_grasps_with_is_among_the_legal_grasps():
    """Each end of a plan's grasp is legal by itself; a goal that is planned is within reach."""
    file = load_cell(CELLS / "open_table.yaml")
    report = inspect_cell(file)
    (goal,) = report.goals
    assert goal.verdict == "within reach"
    assert 0 < goal.both.legal <= min(goal.here.legal, goal.there.legal)
    assert goal.here.legal == report.parts[0].held.legal
    assert handey.plan(file).plan is not None


def test_reasons_are_told_where_no_grasp_is_legal(capsys):
    out_of_reach = run(capsys, CELLS / "impossible_out_of_reach.yaml")[1]
    assert "beyond reach" in out_of_reach
    too_wide = run(capsys, CELLS / "impossible_too_wide.yaml")[1]
    assert "the jaws open 24.0 mm too little" in too_wide
    closed_box = run(capsys, CELLS / "impossible_closed_box.yaml")[1]
    assert "where it stands: none of" in closed_box and "hand hits box" in closed_box


def test_the_share_that_was_not_measured_is_told():
    report = inspect_cell(load_cell(CELLS / "depth_map.yaml"))
    heap = np.load(CELLS / "depth" / "heap.npy")
    unmeasured = {entry.name: entry.unmeasured for entry in report.depth_maps}
    assert set(unmeasured) == {"camera", "heap"}
    assert unmeasured["heap"] == pytest.approx(np.isnan(heap).mean())
    assert 0 < unmeasured["camera"] < 0.05


# ----------------------------------------------------------------------------------------- command


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["nowhere.stl"], "nowhere.stl: no such file"),
        (["nowhere.yaml"], "nowhere.yaml: cannot be read: No such file or directory"),
        ([ROBOT, "--part", "x"], f"{ROBOT}: --part: belongs to a cell file"),
        (
            [PARTS / "block.stl", "--robot", CELLS / "demo.yaml"],
            f"{CELLS / 'demo.yaml'}: --robot: expected a robot file, found a cell",
        ),
        ([ROBOT, "--scale", "2"], f"{ROBOT}: --scale: belongs to a mesh file"),
        (
            [f"{CELLS / 'stack.yaml'}:bass"],
            f"{CELLS / 'stack.yaml'}: parts: no part 'bass'; the cell has: "
            "stepped_block, block, base",
        ),
    ],
)
def test_bad_input_is_one_line_and_status_2(capsys, arguments, message):
    status, out, err = run(capsys, *arguments)
    assert (status, out, err) == (2, "", f"handey: {message}\n")


def test_a_yaml_that_is_neither_is_refused(capsys, tmp_path):
    (tmp_path / "a.yaml").write_text("name: a\n")
    status, _, err = run(capsys, tmp_path / "a.yaml")
    assert status == 2 and "handey_cell" in err and "handey_robot" in err and err.count("\n") == 1


def test_a_page_does_not_replace_what_is_read(capsys, tmp_path):
    mesh = tmp_path / "bracket.stl"
    shutil.copy(PARTS / "bracket.stl", mesh)
    before = mesh.read_bytes()
    status, _, err = run(capsys, mesh, "-o", mesh)
    assert status == 2 and "the output needs another name" in err
    assert mesh.read_bytes() == before
    assert run(capsys, mesh, "-o", tmp_path / "none" / "page.html")[0] == 2


def test_the_json_of_a_part_has_its_keys(capsys):
    told = run(capsys, PARTS / "bracket.stl", "--scale", MM, "--robot", ROBOT, "--json")
    summary = json.loads(told[1])
    assert told[0] == 0 and told[2] == ""
    assert summary["kind"] == "part" and summary["file"].endswith("bracket.stl")
    assert {
        "size_m", "volume_m3", "centre_of_mass_m", "closed", "surfaces", "faces", "jaws", "pairs",
        "pairs_by_kind", "rejected", "placements", "warnings",
    } <= set(summary)  # fmt: skip
    assert summary["size_m"] == pytest.approx([0.07, 0.06, 0.07])
    assert set(summary["placements"][0]) == {
        "probability", "tip_angle_rad", "margin_m", "height_m", "top_m", "up", "pose",
    }  # fmt: skip


def test_a_part_of_a_cell_is_told_by_either_name(capsys):
    by_colon = run(capsys, f"{CELLS / 'stack.yaml'}:base", "--json")
    by_option = run(capsys, CELLS / "stack.yaml", "--part", "base", "--json")
    assert by_colon == by_option
    summary = json.loads(by_colon[1])
    assert (summary["name"], summary["kind"]) == ("base", "part")
    assert summary["jaws"]["robot"] == "puma560" and summary["pairs_by_kind"] == {"two faces": 1}


def test_quiet_prints_nothing_and_still_writes_the_page(capsys, tmp_path):
    page = tmp_path / "page.html"
    assert run(capsys, PARTS / "wedge.stl", "--scale", MM, "-o", page, "--quiet") == (0, "", "")
    assert page.stat().st_size > 5000


def test_directions_have_names():
    assert direction(np.array([0.0, 0.0, -1.0])) == "-z"
    assert direction(np.array([0.6, 0.8, -1e-9])) == "(0.60, 0.80, 0.00)"
    assert listed(["one", "two", "three"], 12, "a: ") == ["a: one, two,", "   three"]


# -------------------------------------------------------------------------------------------- page


def written(report, folder):
    path = folder / "page.html"
    write_page(report, path)
    return path


def scene_of(path):
    return json.loads(re.search(r'id="scene">(.*?)</script>', path.read_text(), re.S).group(1))


def test_the_pages_need_nothing_else(bracket, demo, robot, tmp_path):
    for report in (bracket, demo, inspect_robot(robot, picture=True)):
        text = written(report, tmp_path).read_text()
        assert not re.search(r"https?://(?!www\.w3\.org)", text)
        assert not re.search(
            r"<(script|link|img|iframe)[^>]*\b(src|href)\s*=\s*[\"'](?!data:)", text
        )
        assert "{{" not in text and len(text) < 200_000


def test_names_cannot_become_markup(tmp_path, robot):
    body = _core.Body(name="a</script><b>{{scene}}", shapes=[_core.Shape(_core.Box([0.05] * 3))])
    text = written(inspect_body(body, robot), tmp_path).read_text()
    assert "</script><b>" not in text
    assert "a&lt;/script&gt;&lt;b&gt;{{scene}}" in text


def test_every_face_of_a_part_owns_its_triangles(bracket, tmp_path):
    scene = scene_of(written(bracket, tmp_path))
    owner = np.frombuffer(base64.b64decode(scene["owner"]), "<i4")
    a, b, c = (bracket.vertices[bracket.triangles[:, i]] for i in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    for index, face in enumerate(bracket.faces):
        assert areas[owner == index].sum() == pytest.approx(face.area, rel=1e-6)


def test_arrows_of_a_pair_end_on_its_features(bracket, tmp_path):
    scene = scene_of(written(bracket, tmp_path))
    for pair, drawn in zip(bracket.pairs, scene["pairs"], strict=True):
        (_, on_a), (_, on_b) = np.array(drawn["arrows"])
        along = np.asarray(pair.X_PG)[:3, 2]
        assert (on_a - on_b) @ along == pytest.approx(pair.width, abs=2e-3)


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    webdriver = pytest.importorskip("selenium.webdriver")
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium") or shutil.which("chrome")
    for flag in (
        "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader", "--disable-gpu-sandbox", "--disable-background-networking",
        "--no-first-run", "--window-size=1200,800",
        f"--user-data-dir={tmp_path_factory.mktemp('profile')}",
    ):  # fmt: skip
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
    yield driver
    driver.quit()


def opened(browser, path):
    browser.get(path.as_uri())
    for _ in range(50):
        time.sleep(0.1)
        if browser.execute_script("return document.body.dataset.drawn"):
            break
    time.sleep(0.2)


def pixels(browser, selector="#view"):
    """What a canvas holds, every few pixels, (n, 4)."""
    data = browser.execute_script(
        """const from = document.querySelector(arguments[0]), to = document.createElement("canvas");
        to.width = Math.min(from.width, 320);
        to.height = Math.round(to.width * from.height / from.width);
        const context = to.getContext("2d");
        context.imageSmoothingEnabled = false;
        context.drawImage(from, 0, 0, to.width, to.height);
        const bytes = context.getImageData(0, 0, to.width, to.height).data;
        return btoa(Array.from(bytes, (x) => String.fromCharCode(x)).join(""));""",
        selector,
    )
    return np.frombuffer(base64.b64decode(data), np.uint8).reshape(-1, 4)


def colours(picture):
    return len(np.unique(picture, axis=0))


def severe(browser):
    return [e for e in browser.get_log("browser") if e["level"] in ("SEVERE", "WARNING")]


def choose(browser, selector):
    browser.execute_script("document.querySelector(arguments[0]).click()", selector)
    time.sleep(0.4)


@needs_browser
def test_the_page_of_a_part_shows_what_is_chosen(browser, bracket, tmp_path):
    opened(browser, written(bracket, tmp_path))
    assert browser.find_element("id", "shown").text == "faces 0/1: 10.0 mm wide"
    first = pixels(browser)
    assert colours(first) > 40
    choose(browser, "[data-show='pair:2']")
    assert browser.find_element("id", "shown").text == "faces 4/5: 60.0 mm wide"
    second = pixels(browser)
    assert (first != second).any(axis=1).mean() > 0.01
    choose(browser, "[data-show='face:0']")
    assert (pixels(browser) != second).any(axis=1).mean() > 0.01
    choose(browser, "[data-show='rest:0']")
    assert browser.find_element("id", "shown").text.startswith("stands so 25.4 times of 100")
    assert (pixels(browser) != first).any(axis=1).mean() > 0.05
    rests = browser.find_elements("css selector", "#rests canvas")
    assert len(rests) == len(bracket.rests)
    small = [pixels(browser, f"#rests button:nth-child({i + 1}) canvas") for i in range(len(rests))]
    assert all(colours(picture) > 20 for picture in small)
    assert all((small[0] != picture).any() for picture in small[1:])
    choose(browser, "[data-show='rest:0']")  # once more: nothing is chosen
    assert browser.find_element("id", "shown").text == ""
    assert severe(browser) == []


@needs_browser
def test_the_page_of_an_open_part_shows_its_holes(browser, tmp_path):
    corners = box_corners(0.04, 0.06, 0.05)
    path = write_obj(tmp_path / "open.obj", corners, triangles([*BOX[:1], *BOX[2:]]))
    opened(browser, written(inspect_mesh(path), tmp_path))
    picture = pixels(browser).astype(int)
    red = (picture[:, 0] > 180) & (picture[:, 1] < 60) & (picture[:, 2] < 90)
    assert red.sum() > 20
    assert severe(browser) == []


@needs_browser
def test_the_pages_of_robot_and_cell_are_drawn(browser, robot, demo, tmp_path):
    opened(browser, written(inspect_robot(robot, picture=True), tmp_path))
    assert colours(pixels(browser)) > 40
    assert browser.find_element("css selector", "figure svg").size["width"] > 200
    opened(browser, written(demo, tmp_path))
    before = pixels(browser)
    assert colours(before) > 40
    choose(browser, "[data-show='body:hex_peg']")
    assert browser.find_element("id", "shown").text == "hex_peg"
    after = pixels(browser)
    assert (after != before).any(axis=1).mean() > 0.01
    choose(browser, "[data-show='goal:0']")
    assert browser.find_element("id", "shown").text == f"goal 0: {demo.goals[0].goal}"
    assert (pixels(browser) != after).any(axis=1).mean() > 0.0005
    assert severe(browser) == []


@needs_browser
def test_the_pages_fit_a_phone(browser, bracket, demo, robot, tmp_path):
    metrics = {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    try:
        for report in (bracket, demo, inspect_robot(robot, picture=True)):
            opened(browser, written(report, tmp_path))
            size = browser.execute_script("return [document.body.scrollWidth, innerWidth]")
            assert size[0] <= size[1] == 390
            assert colours(pixels(browser)) > 40
        assert severe(browser) == []
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_a_page_that_cannot_be_written_is_told(bracket, tmp_path):
    with pytest.raises(InvalidInput, match="cannot be written"):
        write_page(bracket, tmp_path / "none" / "page.html")
