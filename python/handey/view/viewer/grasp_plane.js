// The hand in the pictures of grasp planes follows the time line; of several approaches of a goal, the one
// that is on or next is shown.
const planes = [...document.querySelectorAll(".plane")].map((figure) => {
  const svg = figure.querySelector("svg");
  return {
    figure, step: figure.dataset.step === undefined ? null : plan.steps[Number(figure.dataset.step)],
    poses: JSON.parse(svg.dataset.poses), hand: svg.querySelector(".hand"), bumps: [...svg.querySelectorAll(".bump")],
    goal: figure.closest(".goal"), at: -1,
  };
});
const drawPlanes = () => {
  for (const plane of planes) {
    if (!plane.step) continue;
    const own = planes.filter((other) => other.goal === plane.goal);
    const next = own.find((other) => now <= other.step.to + 1e-9) || own[own.length - 1];
    plane.figure.hidden = plane !== next;
    if (plane !== next) continue;
    // Before and after the approach the hand is shown at the grasp.
    let best = plane.poses.length - 1;
    if (now >= plane.step.from - 1e-3 && now <= plane.step.to + 1e-3) {
      plane.poses.forEach(([t], k) => { if (Math.abs(t - now) < Math.abs(plane.poses[best][0] - now)) best = k; });
    }
    if (best === plane.at) continue;
    plane.at = best;
    plane.hand.setAttribute("transform", plane.poses[best][1]);
    plane.bumps.forEach((bump, k) => bump.classList.toggle("hit", plane.poses[best][2][k] === "1"));
  }
};
