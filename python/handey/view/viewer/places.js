// Boxes about what is drawn, the trace of the grasp point, and the grid on the ground.
const bounds = (items) => {  // of shapes at poses: [{shapes, pose}]
  const low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9];
  for (const { shapes, pose } of items) for (const shape of shapes) {
    const m = mul(pose, shape.pose), p = meshes[shape.mesh].points;
    for (let i = 0; i < p.length; i += 3) {
      const w = at(m, [p[i], p[i + 1], p[i + 2]]);
      for (let k = 0; k < 3; k++) { low[k] = Math.min(low[k], w[k]); high[k] = Math.max(high[k], w[k]); }
    }
  }
  return { low, high, centre: low.map((x, k) => (x + high[k]) / 2), radius: Math.hypot(...add(high, low, -1)) / 2 };
};
const startBodies = bodiesAt(rowAt(0));
const robotItems = scene.robot.bodies.map((body, i) => ({ shapes: body.shapes, pose: startBodies[i] }));
const everything = bounds([...robotItems, ...scene.fixtures, ...scene.parts]);
const goalPoses = scene.goals.filter((goal) => goal.at).map((goal) => ({
  part: scene.parts.findIndex((part) => part.name === goal.part), pose: goal.at,
}));
const work = bounds([...scene.parts, ...goalPoses.map((goal) => ({ shapes: scene.parts[goal.part].shapes, pose: goal.pose })),
  ...robotItems]);

const trace = [];
const tracePoints = [];
if (!still) {
  for (const step of plan.steps) {
    const c = rgb(ACTIONS[step.action]);
    for (let k = step.row; k < step.row + step.rows; k++) {
      const p = handAt(bodiesAt(Array.from(rows.subarray(k * width, (k + 1) * width)))).slice(12, 15);
      trace.push(...p, ...c, 0.95);
      tracePoints.push(time[k]);
    }
  }
}
const traceLine = trace.length ? coloured(trace, true) : null;
const grid = (() => {
  const lines = [], z = everything.low[2] - 0.002, [x, y] = [Math.round(everything.centre[0] * 5) / 5, Math.round(everything.centre[1] * 5) / 5];
  const [r, g, b, a] = theme().grid, n = 15;
  for (let i = -n; i <= n; i++) for (const along of [0, 1]) for (let j = -n; j < n; j++) for (const e of [j, j + 1]) {
    const fade = a * Math.max(0, 1 - Math.hypot(i, e) / n);
    const p = along ? [x + i * 0.2, y + e * 0.2] : [x + e * 0.2, y + i * 0.2];
    lines.push(...p, z, r, g, b, fade);
  }
  return coloured(lines);
})();
