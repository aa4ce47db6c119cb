// The clearance along the plan as a curve under the time line; its least is marked, and leads there.
const clear = scene.clearance && {
  time: new Float32Array(bytes(scene.clearance.time)), distance: new Float32Array(bytes(scene.clearance.distance)),
  between: new Int16Array(bytes(scene.clearance.between)), pairs: scene.clearance.pairs,
};
const FAR = 0.1;  // what is farther is not told apart [m]
const height = (d) => 100 * (1 - Math.sqrt(Math.min(d, FAR) / FAR));  // a root: small clearances have room
const millimetres = (d) => `${(1000 * d).toFixed(d < 0.00995 ? 2 : 1)} mm`;
let leastAt = -1;
const clearanceAt = (t) => {  // the sample that is nearest in time
  let low = 0, high = clear.time.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (clear.time[middle] <= t) low = middle; else high = middle;
  }
  return t - clear.time[low] < clear.time[high] - t ? low : high;
};
const tellClearance = () => {
  if (!clear) return;
  const k = clearanceAt(now), pair = clear.pairs[clear.between[k]];
  $("near").textContent = pair ? `Clearance ${millimetres(clear.distance[k])}: ${pair.join(", ")}` : "Clearance 100 mm or more";
  $("nowMark").style.left = `${100 * now / (end || 1)}%`;
  $("nowMark").style.top = `${height(clear.distance[k])}%`;
};
const goToLeast = () => {
  const on = $("least").getAttribute("aria-pressed") !== "true";
  unpress();
  if (on) {
    $("least").setAttribute("aria-pressed", "true");
    for (const name of clear.pairs[clear.between[leastAt]]) marked.add(name);
    setPlaying(false);
    seek(clear.time[leastAt]);
  }
  markNames();
  draw();
};
if (clear) {
  $("clearance").hidden = false;
  const points = Array.from(clear.time, (t, k) => `${(1000 * t / (end || 1)).toFixed(1)} ${height(clear.distance[k]).toFixed(1)}`);
  const [area, line] = $("curve").querySelectorAll("path");
  line.setAttribute("d", "M" + points.join("L"));
  area.setAttribute("d", `M0 100L${points.join("L")}L1000 100z`);
  for (let k = 0; k < clear.time.length; k++) {
    if (clear.between[k] >= 0 && (leastAt < 0 || clear.distance[k] < clear.distance[leastAt])) leastAt = k;
  }
  if (leastAt < 0) $("least").hidden = $("leastMark").hidden = true;
  else {
    const d = clear.distance[leastAt], mark = $("leastMark");
    $("least").textContent = `Least ${millimetres(d)}: ${clear.pairs[clear.between[leastAt]].join(", ")}`;
    $("least").addEventListener("click", goToLeast);
    mark.style.left = `${100 * clear.time[leastAt] / (end || 1)}%`;
    mark.style.top = `${height(d)}%`;
  }
  const curve = $("curve");
  const seekTo = (e) => {
    const place = curve.getBoundingClientRect(), t = (e.clientX - place.left) / place.width * end;
    const near = leastAt >= 0 && Math.abs(t - clear.time[leastAt]) < 8 / place.width * end;
    seek(near ? clear.time[leastAt] : t);
  };
  curve.addEventListener("pointerdown", (e) => { curve.setPointerCapture(e.pointerId); setPlaying(false); seekTo(e); });
  curve.addEventListener("pointermove", (e) => { if (e.buttons & 1) seekTo(e); });
}
