// Where the picture is seen from.
const failed = document.body.classList.contains("failed");
const camera = { turn: 0, tilt: 0, distance: 1, target: [0, 0, 0] };
const FOV = 0.65;
// What a framed picture must hold: everything that happens, or (close) only where hand and parts work.
const corners = ({ low, high }) => [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [0, 1, 2].map((k) => (i >> k & 1 ? high : low)[k]));
// Where the goals that failed begin and end: [goal, pose of its part].
const failedEnds = !failed ? [] : scene.report.filter((goal) => goal.status !== "planned" && goal.status !== "met already")
  .flatMap((goal) => [goal.origin, goal.destination].filter((X) => X).map((X) => [goal, X]));
const interest = (() => {
  const places = [...scene.parts, ...goalPoses.map((goal) => ({ shapes: scene.parts[goal.part].shapes, pose: goal.pose }))];
  const ends = failedEnds.map(([goal, pose]) => ({ shapes: scene.parts[goal.part].shapes, pose }));
  const boxes = (items) => items.flatMap((item) => corners(bounds([item])));
  const close = boxes(ends.length ? ends : places), whole = boxes(places);
  for (const item of robotItems) if (item.shapes.length) whole.push(...corners(bounds([item])));
  for (const step of plan.steps) {
    const rowsOfStep = Math.max(Math.floor(step.rows / 12), 1);
    for (let k = step.row; k < step.row + step.rows; k += rowsOfStep) {
      const hand = Array.from(trace.slice(7 * k, 7 * k + 3));
      whole.push(hand);
      if (step.action !== "transit") close.push(hand, add(hand, [0, 0, 0.2]));
    }
  }
  for (const [goal, X_WP] of failedEnds) {
    for (const pose of goal.tried) close.push(at(mul(X_WP, pose.at), [0, 0, -0.15]));
  }
  return { whole, close };
})();
// From which of some sides fixtures hide the tried poses least; boxes about their shapes are asked.
const screens = scene.fixtures.flatMap((body) => body.shapes.map((shape) => {
  const { low, high } = bounds([{ shapes: [{ ...shape, pose: IDENTITY }], pose: IDENTITY }]);
  return { low, high, into: inverse(mul(body.pose, shape.pose)) };
}));
const isHidden = (eye, p) => screens.some(({ low, high, into }) => {
  const a = at(into, eye), b = at(into, p);
  let from = 0, to = 0.97;
  for (let k = 0; k < 3; k++) {
    const d = b[k] - a[k] || 1e-12, [s, t] = [(low[k] - a[k]) / d, (high[k] - a[k]) / d];
    from = Math.max(from, Math.min(s, t));
    to = Math.min(to, Math.max(s, t));
  }
  return from < to;
});
const openSide = (heading) => {
  const places = failedEnds.flatMap(([goal, X]) => goal.tried.length
    ? goal.tried.map((pose) => at(mul(X, pose.at), [0, 0, -0.05])) : [at(X, [0, 0, 0])]);
  const sides = [0.62, -0.62, 1.2, -1.2, 0.2, 2.2, -2.2].map((offset) => {
    const eye = add(work.centre, [Math.cos(heading + offset), Math.sin(heading + offset), 0.42], 2.5 * work.radius);
    return { offset, count: places.filter((p) => isHidden(eye, p)).length };
  });
  return sides.reduce((best, side) => side.count < best.count ? side : best).offset;
};
const frame = (view = 0, points = interest.whole) => {
  const heading = Math.atan2(work.centre[1] - scene.robot.base[13], work.centre[0] - scene.robot.base[12]) || 0;
  [camera.turn, camera.tilt] = [[heading + openSide(heading), 0.40], [heading, 0.10], [heading - Math.PI / 2, 0.10], [heading + 0.001, 1.56]][view];
  camera.target = work.centre.slice();
  camera.distance = 3 * work.radius;
  const aspect = canvas.clientWidth / Math.max(canvas.clientHeight, 1), up = Math.tan(FOV / 2);
  for (let i = 0; i < 12; i++) {  // centre the points, then come as near as they allow
    const view_ = lookAt(eyePoint(), camera.target);
    const seen = points.map((p) => at(view_, p)).map(([x, y, z]) => [x / -z / (up * aspect), y / -z / up]);
    const [x0, x1, y0, y1] = [Math.min(...seen.map((p) => p[0])), Math.max(...seen.map((p) => p[0])),
      Math.min(...seen.map((p) => p[1])), Math.max(...seen.map((p) => p[1]))];
    const right = [view_[0], view_[4], view_[8]], upward = [view_[1], view_[5], view_[9]], half = camera.distance * up;
    camera.target = add(add(camera.target, right, (x0 + x1) / 2 * half * aspect), upward, ((y0 + y1) / 2 + 0.02) * half);
    camera.distance *= Math.min(Math.max(Math.max(x1 - x0, y1 - y0) / 2 / 0.88, 0.5), 2);
  }
  camera.distance = Math.max(camera.distance, 0.3);
  draw();
};
let framedClose = false;
const reframe = () => {
  framedClose = !framedClose;
  frame(0, framedClose ? interest.close : interest.whole);
};
const eyePoint = () => add(camera.target, [
  Math.cos(camera.tilt) * Math.cos(camera.turn), Math.cos(camera.tilt) * Math.sin(camera.turn), Math.sin(camera.tilt)], camera.distance);
