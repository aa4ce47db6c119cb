"""The means of the check one by one, against others and against dense sampling."""

from __future__ import annotations

import hand_made
import numpy as np
import pytest
from hand_made import PlanMaker, wall, write_cell

from handey.check import check


def test_agrees_with_another_kinematics(cell):
    pinocchio = pytest.importorskip("pinocchio")
    from handey.check.cell_reader import read_cell
    from handey.check.kinematics import forward

    robot = read_cell(cell).robot
    model = pinocchio.buildModelFromUrdf(str(hand_made.ROBOT.parent / "puma560.urdf"))
    data = model.createData()
    random = np.random.default_rng(3)
    low, high = ([getattr(j, side) for j in robot.joints] for side in ("lower", "upper"))
    q, opening = random.uniform(low, high, (50, 6)), random.uniform(*robot.opening, 50)
    frames = forward(robot, np.eye(4), q, opening)
    for k in range(50):
        state = pinocchio.neutral(model)
        values = dict(zip(robot.joint_names(), q[k], strict=True))
        values |= {finger.name: opening[k] / 2 for finger in robot.fingers}
        for name, value in values.items():
            state[model.joints[model.getJointId(name)].idx_q] = value
        pinocchio.framesForwardKinematics(model, data, state)
        for i, body in enumerate(robot.bodies):
            expected = data.oMf[model.getFrameId(body.name)].homogeneous
            assert np.abs(frames.matrix(i, k) - expected).max() < 1e-12


def random_solid(random, size):
    from handey.check import shapes

    kind = random.integers(4)
    X = np.eye(4)
    X[:3, :3] = hand_made.rpy_matrix(*random.uniform(-3, 3, 3))
    X[:3, 3] = random.uniform(-0.02, 0.02, 3)
    if kind == 0:
        return shapes.box(random.uniform(0.3, 1.0, 3) * size, X)
    if kind == 1:
        return shapes.cylinder(size * random.uniform(0.2, 0.5), size, X)
    if kind == 2:
        return shapes.sphere(size * random.uniform(0.2, 0.5), X)
    pieces = [shapes.box(np.array(s) * size, np.eye(4)) for s in ([1, 0.3, 0.3], [0.3, 0.3, 1.1])]
    vertices = np.vstack([p.vertices for p in pieces])
    faces = np.vstack([pieces[0].faces, pieces[1].faces + 8])
    return shapes.mesh(vertices, faces, X)


def test_distances_never_exceed_those_of_dense_points():
    from handey.check.solids import Engine, Placed, pieces_of

    random, engine = np.random.default_rng(5), Engine()
    for _ in range(40):
        a, b = random_solid(random, 0.1), random_solid(random, 0.15)
        R = hand_made.rpy_matrix(*random.uniform(-3, 3, 3))
        p = random.normal(size=3)
        p *= random.uniform(0.05, 0.3) / np.linalg.norm(p)
        found = min(
            engine.distance(Placed(i, np.eye(3), np.zeros(3)), Placed(j, R, p))
            for i in pieces_of([a])
            for j in pieces_of([b])
        )
        weights = random.dirichlet(np.ones(3), 60)

        def cloud(shape, weights=weights):
            points = np.einsum("wk,fki->fwi", weights, shape.triangles()).reshape(-1, 3)
            return points[:: max(len(points) // 3000, 1)]

        first, second = cloud(a), cloud(b) @ R.T + p
        from scipy.spatial import cKDTree

        nearest = cKDTree(first).query(second)[0].min()
        assert found <= nearest + 1e-6
        assert found > 0 or nearest < 0.06


def test_bounds_on_motion_hold(cell, valid):
    """No point moves further between two samples than the sweep believes."""
    from handey.check.cell_reader import read_cell
    from handey.check.kinematics import forward
    from handey.check.solids import Engine, pieces_of
    from handey.check.sweep import Actor, Job, Samples, Sweep

    content = read_cell(cell)
    random = np.random.default_rng(7)
    robot = content.robot
    q = np.cumsum(np.vstack([robot.home, random.normal(0, 0.05, (40, 6))]), axis=0)
    opening = random.uniform(0, 0.1, 41)
    frames = forward(robot, content.base, q, opening)
    samples = Samples(q, opening, np.arange(41.0), np.zeros(40, int), frames)
    sweep = Sweep(robot, content.base, Engine())
    live = np.ones(40, bool)
    actors = [Actor(b.name, pieces_of(b.shapes), i) for i, b in enumerate(robot.bodies)]
    for a, b in ((0, 8), (2, 8), (7, 8), (3, 6), (1, 2)):
        job = Job(actors[a], actors[b], live, np.zeros(40), live)
        bound = sweep.motion(samples, job)
        points = np.vstack([s.points() for s in robot.bodies[b].shapes])
        for k in range(40):
            s = np.linspace(0, 1, 21)[:, None]
            dense = forward(
                robot, content.base, q[k] * (1 - s) + q[k + 1] * s,
                opening[k] * (1 - s[:, 0]) + opening[k + 1] * s[:, 0],
            )  # fmt: skip
            R, p = dense.R, dense.p
            seen = np.array(
                [((points @ R[b, i].T + p[b, i]) - p[a, i]) @ R[a, i] for i in range(21)]
            )
            moved = np.linalg.norm(np.diff(seen, axis=0), axis=2).sum(axis=0).max()
            assert moved <= bound[k] + 1e-9
            assert bound[k] < 4 * moved + 0.15  # and is of use


def test_misses_no_overlap_that_dense_sampling_finds(cell, tmp_path):
    """Random strides through random obstacles, against the engine at 2000 points of each."""
    from handey.check.cell_reader import read_cell
    from handey.check.kinematics import forward
    from handey.check.solids import Engine, Placed, pieces_of

    random = np.random.default_rng(11)
    engine = Engine()
    verdicts = {True: 0, False: 0}
    for _ in range(12):
        start = read_cell(cell).start
        goal = start + random.uniform(-1.2, 0.8, 6)
        goal[4] = np.clip(goal[4], -1.7, 1.7)
        # Near the hand somewhere on its way.
        halfway = read_cell(cell), start + random.uniform(0.2, 0.8) * (goal - start)
        centre = hand_made.hand_pose(*halfway)[:3, 3] + random.uniform(-0.15, 0.15, 3)
        size = [random.uniform(0.001, 0.08) for _ in range(3)]
        changed = write_cell(tmp_path, finish="anywhere", fixtures=wall(size, centre.tolist()))
        maker = PlanMaker(changed)
        maker.step("transit", [start, goal], [0.1, 0.1])
        report = check(changed, maker.plan())
        found = any(" wall " in f.message for f in report.faults)
        content = read_cell(changed)
        s = np.linspace(0, 1, 2000)[:, None]
        q = content.start * (1 - s) + goal * s
        frames = forward(content.robot, content.base, q, np.full(2000, 0.1))
        obstacle = [
            Placed(piece, body.pose[:3, :3], body.pose[:3, 3])
            for body in content.fixtures
            if body.name == "wall"
            for piece in pieces_of(body.shapes)
        ]
        deepest = min(
            engine.distance(Placed(piece, frames.R[i, k], frames.p[i, k]), other)
            for i, body in enumerate(content.robot.bodies)
            if i
            for piece in pieces_of(body.shapes)
            for k in range(0, 2000, 8)
            for other in obstacle
        )
        if deepest < -2e-5:
            assert found
        elif deepest > 5e-3:
            assert not found
        verdicts[found] += 1
    assert min(verdicts.values()) >= 2
