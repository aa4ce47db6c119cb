// Mouse, fingers, keys and buttons.
const toggle = (key) => {
  shown[key] = !shown[key];
  if (key === "tried") fillLegend();
  show();
  draw();
};
const show = () => {
  for (const button of document.querySelectorAll("[data-toggle]")) button.setAttribute("aria-pressed", String(shown[button.dataset.toggle]));
  for (const key of ["joints", "labels"]) document.body.classList.toggle("no-" + key, !shown[key]);
};
for (const button of document.querySelectorAll("[data-toggle]")) button.addEventListener("click", () => toggle(button.dataset.toggle));
const help = () => {
  $("keys").hidden = !$("keys").hidden;
  $("help").setAttribute("aria-expanded", String(!$("keys").hidden));
};
$("help").addEventListener("click", help);
$("frame").addEventListener("click", reframe);
const hasTold = document.body.classList.contains("told");
const turnTold = () => {
  const off = document.body.classList.toggle("no-told");
  $("report").setAttribute("aria-pressed", String(!off));
};
$("report").addEventListener("click", turnTold);

const orbit = (dx, dy) => {
  camera.turn -= dx * 0.008;
  camera.tilt = Math.min(Math.max(camera.tilt + dy * 0.008, -1.5), 1.56);
  draw();
};
const pan = (dx, dy) => {
  const back = unit(add(eyePoint(), camera.target, -1)), right = unit(cross([0, 0, 1], back)), up = cross(back, right);
  const scale = 2 * camera.distance * Math.tan(FOV / 2) / canvas.clientHeight;
  camera.target = add(add(camera.target, right, -dx * scale), up, dy * scale);
  draw();
};
const zoom = (factor) => {
  camera.distance = Math.min(Math.max(camera.distance * factor, 0.05), 40 * everything.radius);
  draw();
};
const fingers = new Map();
let moved = 0;  // since the button went down [px]
canvas.addEventListener("pointerdown", (e) => {
  canvas.setPointerCapture(e.pointerId);
  moved = fingers.size ? 1e9 : 0;
  fingers.set(e.pointerId, [e.clientX, e.clientY]);
});
canvas.addEventListener("pointermove", (e) => {
  const old = fingers.get(e.pointerId);
  if (!old) return;
  const dx = e.clientX - old[0], dy = e.clientY - old[1];
  moved += Math.hypot(dx, dy);
  if (fingers.size === 2) {
    const other = [...fingers.entries()].find(([id]) => id !== e.pointerId)[1];
    const before = Math.hypot(old[0] - other[0], old[1] - other[1]), after = Math.hypot(e.clientX - other[0], e.clientY - other[1]);
    if (after > 1) zoom(before / after);
    pan(dx / 2, dy / 2);
  } else if (e.buttons & 6 || e.shiftKey) pan(dx, dy); else orbit(dx, dy);
  fingers.set(e.pointerId, [e.clientX, e.clientY]);
});
canvas.addEventListener("pointerup", (e) => {
  const place = canvas.getBoundingClientRect();
  if (moved > 5 || e.button !== 0) return;
  const found = poseNear(e.clientX - place.left, e.clientY - place.top);
  if (found >= 0 || chosen.pose >= 0) choose(found);
});
for (const kind of ["pointerup", "pointercancel"]) canvas.addEventListener(kind, (e) => fingers.delete(e.pointerId));
canvas.addEventListener("contextmenu", (e) => e.preventDefault());
canvas.addEventListener("wheel", (e) => {
  e.preventDefault();
  zoom(Math.exp(Math.max(-60, Math.min(60, e.deltaY)) * 0.0022));
}, { passive: false });
addEventListener("keydown", (e) => {
  if (e.ctrlKey || e.metaKey || e.altKey || ["SELECT", "SUMMARY"].includes(e.target.tagName)) return;
  if (e.target.tagName === "BUTTON" && (e.key === " " || e.key === "Enter")) return;
  const keys = {
    " ": () => still || setPlaying(!playing), Home: () => seek(0), End: () => seek(end),
    ArrowLeft: () => e.shiftKey ? jump(-1) : seek(now - 0.05), ArrowRight: () => e.shiftKey ? jump(1) : seek(now + 0.05),
    t: () => toggle("trace"), g: () => toggle("goals"), l: () => toggle("labels"), j: () => toggle("joints"), f: reframe,
    x: () => toggle("grasp"), y: () => scene.report.length && toggle("tried"), r: () => hasTold && turnTold(),
    c: () => clear && leastAt >= 0 && goToLeast(), n: () => chooseNext(1), p: () => chooseNext(-1),
    "1": () => frame(0), "2": () => frame(1), "3": () => frame(2), "4": () => frame(3), "?": help,
    "+": () => zoom(0.85), "=": () => zoom(0.85), "-": () => zoom(1 / 0.85),
    Escape: () => { if (!$("keys").hidden) help(); else choose(-1); },
  };
  const act = keys[e.key] || keys[e.key.toLowerCase()];
  if (act) { e.preventDefault(); act(); }
});
const fitNames = () => {  // names that do not fit into their block are left to its title
  for (const block of blocks) {
    block.style.fontSize = "";
    block.classList.toggle("narrow", block.firstChild && block.scrollWidth > block.clientWidth + 1);
  }
  draw();
};
new ResizeObserver(fitNames).observe(canvas);
dark.addEventListener("change", draw);

document.body.classList.toggle("still", still);
if (!failed && innerWidth <= 900) turnTold();
show();
fillLegend();
const firstCause = document.querySelector("#told .goal[open] [data-cause]");
if (firstCause) showWhy(firstCause, false);
frame(0, failed ? interest.close : interest.whole);
if (failed) zoom(1.3);  // room for the hand, and for what is about the ends
