// What the page holds, and where everything is at a time: rows of the plan, forward kinematics, parts.
const $ = (id) => document.getElementById(id);
const scene = JSON.parse($("scene").textContent);
const plan = scene.plan;
const dark = matchMedia("(prefers-color-scheme: dark)");

const ACTIONS = {
  transit: "#7a8794", approach: "#0f9d9d", grasp: "#d98200", depart: "#2f9e44", transfer: "#2f6fde",
  deposit: "#7a4fd0", release: "#b8621b", withdraw: "#c2417c",
};
const MEANING = {
  transit: "the empty hand travels", approach: "the hand moves in over the part", grasp: "the fingers close",
  depart: "the part leaves its place", transfer: "the part travels", deposit: "the part moves in to its place",
  release: "the fingers open", withdraw: "the hand moves out",
};
// The stages of the funnel; a hand pose that was tried has the colour of the one at which it fell.
const STAGES = {
  found: "#7a8794", spanned: "#9a6a3a", unobstructed: "#d98200", reachable: "#c2417c", approached: "#7a4fd0", connected: "#2f6fde",
  planned: "#2f9e44",
};
const MARKED = "#e5484d";  // what stands in the way
const PARTS = ["#e8743b", "#2f8fdd", "#3fae5a", "#d9a514", "#b45bd0", "#e0527f", "#14a5a0", "#8a6a48"];
const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
const partColour = (i) => PARTS[i % PARTS.length];
const theme = () => dark.matches
  ? { sky: [0.106, 0.125, 0.149], low: [0.075, 0.086, 0.102], grid: [1, 1, 1, 0.10], edge: [0, 0, 0, 0.55], ambient: 0.50,
      fixture: "#66727f", support: "#7d8894", link: "#d7dade", link2: "#b9bfc6", hand: "#5a646f", finger: "#8d98a5" }
  : { sky: [0.933, 0.949, 0.965], low: [0.85, 0.876, 0.90], grid: [0.1, 0.15, 0.2, 0.13], edge: [0.05, 0.08, 0.11, 0.5], ambient: 0.62,
      fixture: "#9aa7b4", support: "#c9d1d8", link: "#f4f2ee", link2: "#d8d5cf", hand: "#55606b", finger: "#7f8b98" };

const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
const time = new Float64Array(bytes(plan.time));
const rows = new Float32Array(bytes(plan.rows));
const width = scene.robot.arm.length + 1;
const end = time[time.length - 1];
const still = plan.steps.length === 0;
const meshes = scene.meshes.map((m) => ({
  points: new Float32Array(bytes(m.v)), faces: new Uint32Array(bytes(m.f)), edges: new Uint32Array(bytes(m.e)),
}));

const stepAt = (t) => {
  if (still) return null;
  let found = plan.steps[0];
  for (const step of plan.steps) if (step.from <= t + 1e-9) found = step;
  return found;
};
const rowAt = (t) => {  // joint values and opening, straight between two rows
  let low = 0, high = time.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (time[middle] <= t) low = middle; else high = middle;
  }
  const span = time[high] - time[low];
  const s = span > 0 ? Math.min(Math.max((t - time[low]) / span, 0), 1) : 1;
  return Array.from({ length: width }, (_, i) => rows[low * width + i] * (1 - s) + rows[high * width + i] * s);
};
const bodiesAt = (row) => {
  const poses = [scene.robot.base];
  for (const joint of scene.robot.joints) {
    const motion = joint.slides ? shift(joint.axis, row[width - 1] / 2) : turn(joint.axis, row[joint.index]);
    poses[joint.child] = mul(mul(poses[joint.parent], joint.origin), motion);
  }
  return poses;
};
const backFromGrasp = inverse(scene.robot.grasp);
const handBodiesAt = (X_WH, opening) => {  // hand and fingers alone, by the grasp frame: [body, pose]
  const poses = new Map([[scene.robot.hand, mul(X_WH, backFromGrasp)]]);
  for (const joint of scene.robot.joints) {
    if (joint.slides && poses.has(joint.parent)) {
      poses.set(joint.child, mul(mul(poses.get(joint.parent), joint.origin), shift(joint.axis, opening / 2)));
    }
  }
  return [...poses];
};
const handAt = (poses) => mul(poses[scene.robot.hand], scene.robot.grasp);
const partsAt = (step, poses) => scene.parts.map((part) => {
  if (step === null) return plan.start[part.name];
  if (part.name === step.held && step.grip) return mul(handAt(poses), step.grip);
  return step.parts[part.name] || plan.start[part.name];
});
