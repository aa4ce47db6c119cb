// Playing: the steps as blocks, the clock, jumps.
const blocks = plan.steps.map((step) => {
  const block = element("div", step.action, $("steps"));
  block.style.background = ACTIONS[step.action];
  block.style.flex = `${Math.max(step.to - step.from, end * 0.0005)} 0 0`;
  return block;
});
for (const action of Object.keys(ACTIONS)) {
  if (!plan.steps.some((step) => step.action === action)) continue;
  const li = element("li", "", $("legend"));
  element("i", "", li).style.background = ACTIONS[action];
  li.append(action);
  li.title = MEANING[action];
}
const setPlaying = (on) => {
  playing = on;
  if (on && now >= end) now = 0;
  last = performance.now();
  $("play").querySelector("path").setAttribute("d", on ? "M4 2h3v12H4zM9 2h3v12H9z" : "M4 2l10 6-10 6z");
  $("play").setAttribute("aria-label", on ? "Pause" : "Play");
  draw();
};
const seek = (t) => {
  now = Math.min(Math.max(t, 0), end);
  $("scrub").value = now;
  draw();
};
const jump = (way) => {
  const times = [...plan.steps.map((step) => step.from), end];
  seek(way > 0 ? times.find((t) => t > now + 1e-6) ?? end : times.filter((t) => t < now - 1e-6).pop() ?? 0);
};
$("scrub").max = end;
$("scrub").addEventListener("input", () => { setPlaying(false); seek(Number($("scrub").value)); });
$("line").addEventListener("pointermove", (e) => {
  const box = $("line").getBoundingClientRect(), step = stepAt((e.clientX - box.left) / box.width * end);
  if (step) $("scrub").title = `${step.action}, ${(step.to - step.from).toFixed(2)} s`;
});
$("play").addEventListener("click", () => setPlaying(!playing));
$("back").addEventListener("click", () => jump(-1));
$("on").addEventListener("click", () => jump(1));
