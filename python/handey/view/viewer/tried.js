// The hand poses that were tried, as small forks in the colour of the stage at which each fell; the one
// that is chosen as a ghost of the hand, with its grasp frame and pads, where its part stands and is to go.
const chosen = { goal: scene.report.findIndex((goal) => goal.status !== "planned"), pose: -1, only: "", end: "both", text: "" };
if (chosen.goal < 0) chosen.goal = scene.report.length ? 0 : -1;
const hidden = new Set();  // stages that are not shown
const marked = new Set();  // names of bodies that stand in the way
const triedGoal = () => scene.report[chosen.goal] || null;
const endsOf = (goal) => [["origin", goal.origin], ["destination", goal.destination]]
  .filter(([name, pose]) => pose && (chosen.end === "both" || chosen.end === name)).map(([, pose]) => pose);
const openingOf = (pose) => pose.opening || pose.width;  // where it fell before an opening was chosen: as closed
const isShown = (pose) => !hidden.has(pose.stage) && (!chosen.only || pose.stage === chosen.only);
// Where a reason is chosen, poses that fell by the very same are shown alone, if there are any.
const shownPoses = () => {
  const goal = triedGoal();
  if (!goal) return [];
  const poses = goal.tried.filter(isShown), same = poses.filter((pose) => chosen.text && goal.texts[pose.text] === chosen.text);
  return same.length ? same : poses;
};

const FORK = { finger: 0.030, stem: 0.034, half: 0.0011 };  // Choice: like a hand, but small [m]
const box = (low, high) => {  // 12 triangles
  const p = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]]);
  return [[0, 2, 1, 3], [4, 5, 6, 7], [0, 1, 4, 5], [2, 6, 3, 7], [0, 4, 2, 6], [1, 3, 5, 7]]
    .flatMap(([a, b, c, d]) => [p[a], p[b], p[c], p[c], p[b], p[d]]);
};
const fork = (opening) => {
  const h = FORK.half, y = Math.max(opening / 2, 2 * h), z = -FORK.finger;
  return [
    ...box([-h, y - h, z], [h, y + h, 0.006]), ...box([-h, -y - h, z], [h, -y + h, 0.006]),
    ...box([-h, -y, z - h], [h, y, z + h]), ...box([-h, -h, z - FORK.stem], [h, h, z]),
  ];
};
let forks = [];  // per stage: {colour, array, count}
const remakeForks = () => {
  for (const made of forks) { gl.deleteVertexArray(made.array); gl.deleteBuffer(made.points); }
  const goal = triedGoal(), points = {};
  if (goal) {
    for (const pose of shownPoses()) {
      const shape = fork(openingOf(pose)), list = points[pose.stage] ||= [];
      for (const X_WP of endsOf(goal)) {
        const X_WH = mul(X_WP, pose.at);
        for (const p of shape) list.push(...at(X_WH, p));
      }
    }
  }
  forks = Object.entries(points).map(([stage, list]) => ({ colour: rgb(STAGES[stage]), ...triangles(list) }));
};
const drawTried = () => {
  gl.uniformMatrix4fv(solid.uniforms.model, false, IDENTITY);
  gl.uniform1f(solid.uniforms.glow, 0.35);
  for (const made of forks) {
    gl.uniform3fv(solid.uniforms.colour, made.colour);
    gl.bindVertexArray(made.array);
    gl.drawArrays(gl.TRIANGLES, 0, made.count);
  }
};

const ghostPlaces = () => {
  const goal = triedGoal(), pose = goal && goal.tried[chosen.pose];
  return pose ? endsOf(goal).map((X_WP) => ({ X_WP, X_WH: mul(X_WP, pose.at), pose, goal })) : [];
};
const drawGhosts = () => {
  for (const { X_WP, X_WH, pose, goal } of ghostPlaces()) {
    gl.uniform1f(solid.uniforms.alpha, 0.55);
    gl.uniform1f(solid.uniforms.glow, 0.2);
    gl.uniform3fv(solid.uniforms.colour, rgb(STAGES[pose.stage]));
    for (const [body, X_WB] of handBodiesAt(X_WH, openingOf(pose))) drawFaces(scene.robot.bodies[body].shapes, X_WB, solid);
    gl.uniform1f(solid.uniforms.alpha, 0.35);
    gl.uniform3fv(solid.uniforms.colour, rgb(partColour(goal.part)));
    if (X_WP === goal.destination) drawFaces(scene.parts[goal.part].shapes, X_WP, solid);
  }
};

// ---- grasp frames and pads
const frameLines = coloured([]);
const frameOf = (X_WH, opening, list, length = 0.05) => {
  const line = (a, b, colour) => { for (const p of [a, b]) list.push(...at(X_WH, p), ...colour, 1); };
  line([0, 0, 0], [length, 0, 0], [0.90, 0.28, 0.30]);
  line([0, 0, 0], [0, length, 0], [0.19, 0.62, 0.27]);
  line([0, 0, 0], [0, 0, length], [0.18, 0.44, 0.87]);
  const [w, l] = scene.robot.pad.map((x) => x / 2), ink = dark.matches ? [1, 1, 1] : [0.1, 0.13, 0.17];
  for (const y of [-opening / 2, opening / 2]) {
    const p = [[-w, y, -l], [w, y, -l], [w, y, l], [-w, y, l]];
    p.forEach((a, i) => line(a, p[(i + 1) % 4], ink));
  }
};
const drawFrames = (X_WH, opening, width) => {
  const list = [], ghosts = shown.tried ? ghostPlaces() : [];
  if (ghosts.length) for (const place of ghosts) frameOf(place.X_WH, openingOf(place.pose), list);
  else frameOf(X_WH, opening, list);
  recoloured(frameLines, list);
  gl.disable(gl.DEPTH_TEST);
  drawLines(frameLines, width);
};

// ---- which one is meant by a click
const NEAR = 14;  // Choice: a finger's breadth [px]
const onScreen = (p) => {  // [px], or null behind the eye
  const depth = seenBy[3] * p[0] + seenBy[7] * p[1] + seenBy[11] * p[2] + seenBy[15], q = at(seenBy, p);
  return depth > 0 ? [(0.5 + 0.5 * q[0] / depth) * canvas.clientWidth, (0.5 - 0.5 * q[1] / depth) * canvas.clientHeight] : null;
};
const offSegment = ([x, y], [ax, ay], [bx, by]) => {
  const [dx, dy] = [bx - ax, by - ay], s = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1), t = Math.min(Math.max(s, 0), 1);
  return Math.hypot(ax + t * dx - x, ay + t * dy - y);
};
const poseNear = (x, y) => {
  const goal = triedGoal();
  if (!goal || !shown.tried) return -1;
  let best = NEAR, found = -1;
  for (const pose of shownPoses()) for (const X_WP of endsOf(goal)) {
    const X_WH = mul(X_WP, pose.at), half = openingOf(pose) / 2, z = -FORK.finger;
    const points = [[0, half, 0], [0, half, z], [0, -half, z], [0, -half, 0], [0, 0, z - FORK.stem], [0, 0, z]].map((p) => onScreen(at(X_WH, p)));
    if (points.includes(null)) continue;
    for (const [a, b] of [[0, 1], [1, 2], [2, 3], [4, 5]]) {
      const off = offSegment([x, y], points[a], points[b]);
      if (off < best) { best = off; found = goal.tried.indexOf(pose); }
    }
  }
  return found;
};
