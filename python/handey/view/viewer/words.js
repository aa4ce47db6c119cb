// Names in the picture, joint values, and what happens now.
const element = (tag, text = "", parent = null) => {
  const e = document.createElement(tag);
  e.textContent = text;
  if (parent) parent.append(e);
  return e;
};
// Parts have their names always, fixtures where they stand in the way.
const named = [
  ...scene.parts.map((part, i) => ({ name: part.name, shapes: part.shapes, colour: partColour(i), place: (parts) => parts[i] })),
  ...scene.fixtures.map((body) => ({ name: body.name, shapes: body.shapes, colour: MARKED, place: () => body.pose })),
];
for (const [i, body] of named.entries()) {
  body.top = bounds([{ shapes: body.shapes, pose: IDENTITY }]);
  body.tag = element("span", body.name, $("labels"));
  body.tag.style.setProperty("--c", body.colour);
  body.isPart = i < scene.parts.length;
  if (!body.isPart) body.above = bounds([{ shapes: body.shapes, pose: body.place() }]);
}
const markNames = () => { for (const body of named) body.tag.classList.toggle("marked", marked.has(body.name)); };
const labels = (view, parts, w, h) => {
  const placed = [];
  named.map((body) => {
    const { tag, top, above } = body, p = above ? above.centre.slice() : at(body.place(parts), top.centre);
    p[2] = above ? above.high[2] + 0.01 : p[2] + top.radius + 0.03;
    const depth = view[3] * p[0] + view[7] * p[1] + view[11] * p[2] + view[15], q = at(view, p);
    tag.hidden = depth <= 0 || !(body.isPart || marked.has(body.name));
    const inside = (x, most) => body.isPart ? x : Math.min(Math.max(x, 24), most - 24);
    return { tag, x: inside((0.5 + 0.5 * q[0] / depth) * w, w), y: inside((0.5 - 0.5 * q[1] / depth) * h, h) };
  }).filter(({ tag }) => !tag.hidden).sort((a, b) => b.y - a.y).forEach(({ tag, x, y }) => {  // the lower stay, the others make room
    const half = tag.textContent.length * 3.6 + 14;
    for (const other of placed) {
      if (Math.abs(x - other.x) < half + other.half && Math.abs(y - other.y) < 19) y = other.y - 19;
    }
    placed.push({ x, y, half });
    tag.style.transform = `translate(${x}px, ${y}px) translate(-50%, -100%)`;
  });
};
const table = $("joints").querySelector("tbody");
const lines = [...scene.robot.arm.map((name, i) => {
  const joint = scene.robot.joints.find((j) => j.index === i);
  return { name, index: i, limits: joint.limits, text: (x) => (Math.round(x * 1800 / Math.PI) / 10 + 0).toFixed(1) + "\u00b0" };
}), { name: "opening", index: width - 1, limits: scene.robot.opening, text: (x) => (x * 1000).toFixed(1) + " mm" }].map((line) => {
  const tr = element("tr", "", table);
  element("th", line.name, tr).scope = "row";
  const value = element("td", "", tr), bar = element("div", "", element("td", "", tr));
  bar.className = "range";
  return { ...line, value, mark: element("i", "", bar) };
});
const readout = (step, row) => {
  for (const line of lines) {
    const x = row[line.index], [low, high] = line.limits;
    line.value.textContent = line.text(x);
    line.mark.style.display = low === null ? "none" : "";
    if (low !== null) line.mark.style.left = 100 * Math.min(Math.max((x - low) / (high - low || 1), 0), 1) + "%";
  }
  $("clock").textContent = `${now.toFixed(2)} / ${end.toFixed(2)} s`;
  const action = step ? step.action : plan.note;
  if ($("action").textContent !== action) $("action").textContent = action;
  const doing = step ? `${MEANING[step.action]}${step.held ? ": " + step.held : ""}` : "the cell at its start";
  if ($("what").textContent !== doing) $("what").textContent = doing;
  $("swatch").style.background = step ? ACTIONS[step.action] : "";
  tellClearance();
  drawPlanes();
  if (failed) return;
  const goal = scene.goals[step ? step.goal : 0];
  const aside = step && step.held && goal && step.held !== goal.part ? `${step.held} aside, then ` : "";
  $("task").textContent = goal
    ? `${scene.goals.length > 1 ? `Goal ${(step ? step.goal : 0) + 1} of ${scene.goals.length}: ` : ""}${aside}place ${goal.part}${goal.on ? " on " + goal.on : goal.inside ? " inside " + goal.inside : ""}`
    : "";
  blocks.forEach((block, i) => block.classList.toggle("here", plan.steps[i] === step));
  $("scrub").setAttribute("aria-valuetext", `${now.toFixed(2)} seconds, ${action}`);
};
