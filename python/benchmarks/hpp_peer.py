"""HPP (Humanoid Path Planner, PyPI hpp-python) moves one block on a table: a task in, a path out.

Runs in an interpreter that has pyhpp; knows nothing of handey. Standard input is one JSON object,
    {urdf, gripper_link, grasp_frame, fingers, opening, ignore_collisions, home, table, block,
     start, goal, planner, deadline, seed}
(poses 4x4, boxes by their edges), standard output another:
    {message, setup_s, cpu_s, wall_s, shorten_s, raw, shortened}
where message is empty if a path was found, and a path is a list of runs between two events of the
gripper, each [is the block held, rows of arm positions].

What HPP asks of its user is typed below: the gripper and the handles, which faces may touch the
table, what never collides. Handles that leave the turn about the closing axis open would serve all
grasps at once, but with them the block was not turned over within 30 s. So the hand is tilted by 45
degrees to the block's faces, eight ways: of the sets tried the fastest. HPP moves no fingers: they
stand wide open throughout, and the block hangs between them, untouched.
"""

from __future__ import annotations

import ctypes
import json
import os
import sys
import time
import xml.etree.ElementTree as ET
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

CLEARANCE = 0.03  # of gripper and of handle; their sum is the straight run in to a grasp [m]
LIFT = 0.05  # of the straight run up from the table [m]
PLAY = 0.0005  # between the block and the table: HPP calls bodies that touch in collision [m]
ROOM = 1.0  # above the table in which the block may be [m]
CHORD = 0.01  # a row is told between two others where the path leaves their chord by more [rad]
GOOD = 1e-4  # of HPP's projections
MARGIN = 1e-4  # at which HPP's placements hover over the table, its default [m]


def quaternion(turn: np.ndarray) -> list[float]:
    """[x, y, z, w] of a rotation matrix."""
    from pinocchio import Quaternion

    return [float(value) for value in Quaternion(turn).coeffs()]


def w_first(turn: np.ndarray) -> list[float]:
    """[w, x, y, z] of a rotation matrix: the order of HPP's SRDF."""
    x, y, z, w = quaternion(turn)
    return [w, x, y, z]


def numbers(values: Any) -> str:
    """As XML has them."""
    return " ".join(f"{float(value):.12g}" for value in values)


def arm_urdf(given: dict[str, Any]) -> tuple[str, list[tuple[str, str]]]:
    """The arm's URDF for HPP, and the pairs of links of bodies that a joint joins.

    Meshes by absolute paths, each marked convex; the fingers fixed, wide open.
    """
    path = Path(given["urdf"])
    root = ET.parse(path).getroot()
    for link in root.findall("link"):
        marks = ET.SubElement(link, "collision_checking")
        for index, collision in enumerate(link.findall("collision")):
            collision.set("name", f"{link.get('name')}_{index}")
            mesh = collision.find("geometry/mesh")
            if mesh is not None:
                mesh.set("filename", f"file://{path.parent.resolve() / mesh.get('filename', '')}")
                ET.SubElement(marks, "convex", name=collision.get("name", ""))
    body = {link.get("name", ""): link.get("name", "") for link in root.findall("link")}
    joined = []
    for joint in root.findall("joint"):
        parent, child = (joint.find(end).get("link", "") for end in ("parent", "child"))  # type: ignore[union-attr]
        if joint.get("name") in given["fingers"]:
            fix_finger(joint, given["opening"] / 2)
        if joint.get("type") == "fixed":
            top = body[child]
            body = {link: body[parent] if of == top else of for link, of in body.items()}
        else:
            joined.append((parent, child))
    pairs = [
        (a, b)
        for parent, child in joined
        for a, b in product(body, body)
        if body[a] == body[parent] and body[b] == body[child]
    ]
    return ET.tostring(root, encoding="unicode"), pairs


def fix_finger(joint: ET.Element, value: float) -> None:
    """Make a finger's joint fixed at a value; its frame is not turned."""
    origin, axis = joint.find("origin"), joint.find("axis")
    assert origin is not None and axis is not None and "rpy" not in origin.attrib
    xyz, along = (np.array(e.get("xyz", "").split(), dtype=float) for e in (origin, axis))
    origin.set("xyz", numbers(xyz + along * value))
    joint.set("type", "fixed")


def arm_srdf(given: dict[str, Any], joined: list[tuple[str, str]]) -> str:
    """The gripper, which HPP approaches along its x, and the pairs that are never checked."""
    frame = np.asarray(given["grasp_frame"], dtype=float)
    turn = np.column_stack([frame[:3, 2], frame[:3, 1], -frame[:3, 0]])
    off = "".join(
        f'<disable_collisions link1="{a}" link2="{b}"/>'
        for a, b in [*joined, *given["ignore_collisions"]]
    )
    return (
        f'<robot name="arm">{off}<gripper name="jaw" clearance="{CLEARANCE}">'
        f"<position>{numbers([*frame[:3, 3], *w_first(turn)])}</position>"
        f'<link name="{given["gripper_link"]}"/></gripper></robot>'
    )


def handles() -> dict[str, np.ndarray]:
    """The handles at the block's middle: closing along x or y, tilted by 45 degrees four ways."""
    named = {}
    for name, closing in (("x", 0), ("y", 1)):
        axes = np.roll(np.eye(3), -closing, axis=0)  # the closing axis and the two across it
        for index, (u, v) in enumerate(product((1, -1), (1, -1))):
            approach = (u * axes[1] + v * axes[2]) / np.sqrt(2)
            turn = np.column_stack([approach, axes[0], np.cross(approach, axes[0])])
            named[f"{name}{index}"] = turn
    return named


def block_files(size: list[float]) -> tuple[str, str]:
    """The block's URDF and SRDF: a box, its handles, its six faces."""
    x, y, z = size
    ixx, iyy, izz = (0.2 / 12 * (a * a + b * b) for a, b in ((y, z), (x, z), (x, y)))
    shape = f'<geometry><box size="{numbers(size)}"/></geometry>'
    urdf = (
        f'<robot name="block"><link name="base_link"><inertial><mass value="0.2"/>'
        f'<inertia ixx="{ixx}" iyy="{iyy}" izz="{izz}" ixy="0" ixz="0" iyz="0"/></inertial>'
        f"<visual>{shape}</visual><collision>{shape}</collision></link></robot>"
    )
    grips = "".join(
        f'<handle name="{name}" clearance="{CLEARANCE}">'
        f"<position>0 0 0 {numbers(w_first(turn))}</position>"
        f'<link name="base_link"/><mask>1 1 1 1 1 1</mask></handle>'
        for name, turn in handles().items()
    )
    corners = np.array(list(product(*([-s / 2, s / 2] for s in size))))
    faces = "4 0 1 3 2 4 4 6 7 5 4 0 4 5 1 4 2 3 7 6 4 0 2 6 4 4 1 5 7 3"
    return urdf, f'<robot name="block">{grips}{contact("faces", corners, faces)}</robot>'


def table_files(size: list[float]) -> tuple[str, str]:
    """The table's URDF and SRDF, in the frame of its middle."""
    x, y, z = (s / 2 for s in size)
    shape = f'<origin xyz="0 0 {-PLAY}"/><geometry><box size="{numbers(size)}"/></geometry>'
    urdf = (
        f'<robot name="table"><link name="base_link"><visual>{shape}</visual>'
        f"<collision>{shape}</collision></link></robot>"
    )
    points = np.array([[-x, -y, z], [x, -y, z], [x, y, z], [-x, y, z]])
    return urdf, f'<robot name="table">{contact("top", points, "4 0 1 2 3")}</robot>'


def contact(name: str, points: np.ndarray, faces: str) -> str:
    """Polygons that may touch."""
    return (
        f'<contact name="{name}"><link name="base_link"/><point>{numbers(points.ravel())}</point>'
        f"<shape>{faces}</shape></contact>"
    )


class Peer:
    """HPP's model of the cell and its constraint graph."""

    def __init__(self, given: dict[str, Any]) -> None:
        """Build all that does not depend on where the block starts and ends."""
        from pinocchio import SE3
        from pyhpp.core import Dichotomy, Straight
        from pyhpp.manipulation import Device, Graph, Problem, ProgressiveProjector, urdf

        self.given, self.dof = given, len(given["home"])
        self.robot = Device("cell")
        table, at = given["table"], SE3(np.asarray(given["table"]["pose"], dtype=float))
        arm, joined = arm_urdf(given)
        load, identity = urdf.loadModelFromString, SE3.Identity()
        load(self.robot, 0, "arm", "anchor", arm, arm_srdf(given, joined), identity)
        load(self.robot, 0, "table", "anchor", *table_files(table["box"]), at)
        load(self.robot, 0, "block", "freeflyer", *block_files(given["block"]), identity)
        half = np.array(table["box"]) / 2
        low, high = at.translation - half, at.translation + half
        place = [low[0], high[0], low[1], high[1], high[2] - 0.01, high[2] + ROOM]
        self.robot.setJointBounds("block/root_joint", [*place, *[-1.0001, 1.0001] * 4])
        self.problem = Problem(self.robot)
        self.problem.clearConfigValidations()
        for name in ("CollisionValidation", "JointBoundValidation"):
            self.problem.addConfigValidation(name)
        self.graph = Graph("graph", self.robot, self.problem)
        self.build_graph()
        self.problem.steeringMethod(Straight(self.problem))
        self.problem.pathValidation(Dichotomy(self.robot, 0.0))
        self.problem.pathProjector(
            ProgressiveProjector(self.problem.distance(), self.problem.steeringMethod(), 0.05)
        )
        self.graph.initialize()
        self.problem.constraintGraph(self.graph)

    def build_graph(self) -> None:
        """States and transitions, from the names of gripper, handles and faces."""
        from pyhpp.manipulation.constraint_graph_factory import ConstraintGraphFactory

        self.graph.maxIterations(40)
        self.graph.errorThreshold(GOOD)
        names = [f"block/{name}" for name in handles()]
        factory = ConstraintGraphFactory(self.graph, {})
        factory.setGrippers(["arm/jaw"])
        factory.environmentContacts(["table/top"])
        factory.setObjects(["block"], [names], [["block/faces"]])
        factory.setPossibleGrasps({"arm/jaw": names})
        factory.setPreplacementDistance("block", LIFT)
        factory.generate()

    def configuration(self, pose: Any) -> np.ndarray:
        """The arm at home, the block at a pose on the table."""
        matrix = np.asarray(pose, dtype=float)
        block = [*(matrix[:3, 3] + [0, 0, MARGIN]), *quaternion(matrix[:3, :3])]
        free = self.graph.getState("free")
        found, q, _ = self.graph.applyStateConstraints(
            free, np.array([*self.given["home"], *block])
        )
        if not found:
            raise RuntimeError("the block does not lie on the table")
        valid, why = self.problem.isConfigValid(q)
        if not valid:
            raise RuntimeError(why)
        return np.asarray(q)

    def planner(self) -> Any:
        """The planner asked for, at its defaults or those of its own examples."""
        from pyhpp.manipulation import ManipulationPlanner, StatesPathFinder

        if self.given["planner"] == "StatesPathFinder":
            for name, value in (
                ("innerPlannerTimeOut", 0.0),
                ("innerPlannerMaxIterations", 100),
                ("nTriesUntilBacktrack", 3),
            ):
                self.problem.setParameter(f"StatesPathFinder/{name}", value)
            return StatesPathFinder(self.problem)
        return ManipulationPlanner(self.problem)

    def solve(self) -> dict[str, Any]:
        """Plan the task, shorten the path."""
        from pyhpp.manipulation import GraphRandomShortcut

        self.problem.initConfig(self.configuration(self.given["start"]))
        self.problem.resetGoalConfigs()
        self.problem.addGoalConfig(self.configuration(self.given["goal"]))
        planner = self.planner()
        planner.maxIterations(10**6)
        planner.timeOut(float(self.given["deadline"]))
        clocks = time.process_time(), time.perf_counter()
        told: dict[str, Any] = {"message": ""}
        try:
            path = planner.solve()
        except Exception as failure:  # whatever pyhpp raises is what its user is told
            told["message"] = str(failure) or repr(failure)
        told["cpu_s"] = time.process_time() - clocks[0]
        told["wall_s"] = time.perf_counter() - clocks[1]
        if told["message"]:
            return told
        begin = time.process_time()
        shortened = GraphRandomShortcut(self.problem).optimize(path)
        told["shorten_s"] = time.process_time() - begin
        return {**told, "raw": self.runs(path), "shortened": self.runs(shortened)}

    def runs(self, path: Any) -> list[tuple[bool, list[list[float]]]]:
        """The path cut where the gripper closes or opens."""
        from pyhpp.core import path as paths
        from pyhpp.manipulation import Graph

        flat = paths.Vector(path.outputSize(), path.outputDerivativeSize())
        path.flatten(flat)
        runs: list[tuple[bool, list[list[float]]]] = []
        passed = 0.0
        for rank in range(flat.numberPaths()):
            piece = flat.pathAtRank(rank)
            span = piece.timeRange()
            length = span.second - span.first
            transition = Graph.transitionAtParam(flat, passed + length / 2)
            held = self.graph.getContainingNode(transition) != "free"
            passed += length
            times = [span.first, *self.between(piece, span.first, span.second), span.second]
            rows = [[float(v) for v in piece.eval(t)[0][: self.dof]] for t in times]
            if runs and runs[-1][0] == held:
                runs[-1][1].extend(rows[1:])
            else:
                runs.append((held, rows))
        return runs

    def between(self, piece: Any, begin: float, end: float) -> list[float]:
        """Where rows are needed that the chords stay close to a curved piece."""
        middle = (begin + end) / 2
        a, m, b = (piece.eval(t)[0][: self.dof] for t in (begin, middle, end))
        if end - begin < GOOD or np.abs(m - (a + b) / 2).max() < CHORD:
            return []
        return [*self.between(piece, begin, middle), middle, *self.between(piece, middle, end)]


def main() -> None:
    """One task."""
    given = json.load(sys.stdin)
    # pyhpp prints; only the answer goes to standard output.
    answer = os.dup(1)
    os.dup2(2, 1)
    try:
        import pyhpp.manipulation  # noqa: F401
    except ImportError as missing:
        told: dict[str, Any] = {"message": f"not installed: {missing}"}
    else:
        ctypes.CDLL(None).srand(given["seed"])
        begin = time.process_time()
        peer = Peer(given)
        setup = time.process_time() - begin
        told = {"setup_s": setup, **peer.solve()}
    os.write(answer, json.dumps(told).encode())
    # pyhpp's objects do not always survive the end of the interpreter.
    os._exit(0)


if __name__ == "__main__":
    main()
