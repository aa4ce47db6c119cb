// What is told of the goals, tied to the picture: reasons mark bodies and pick out the poses that fell by
// them; the legend filters by stage; one pose after the other can be looked at.
const legend = $("stages"), card = $("picked");
const choose = (index) => {  // a pose that was tried; -1 for none
  const goal = triedGoal(), pose = goal && goal.tried[index];
  chosen.pose = pose ? index : -1;
  card.hidden = !pose;
  if (pose) {
    const jaws = [[pose.opening, "open"], [pose.width, "on the part"]].filter(([x]) => x > 0);
    const order = shownPoses(), place = order.indexOf(pose);
    $("pickedStage").textContent = pose.stage === "planned" ? "the grasp of the plan" : `fell at: ${pose.stage}`;
    $("pickedStage").style.setProperty("--c", STAGES[pose.stage]);
    $("pickedWhy").textContent = goal.texts[pose.text] || (pose.stage === "planned" ? "It was carried through." : "No reason is told.");
    $("pickedJaws").textContent = jaws.length ? "jaws " + jaws.map(([x, how]) => `${(1000 * x).toFixed(1)} mm ${how}`).join(", ") : "";
    $("pickedCount").textContent = place < 0 ? "" : `${place + 1} of ${order.length}`;
  }
  draw();
};
const chooseNext = (way) => {
  const goal = triedGoal(), order = shownPoses();
  if (!order.length) return;
  if (!shown.tried) toggle("tried");
  const place = order.indexOf(goal.tried[chosen.pose]);
  choose(goal.tried.indexOf(order[place < 0 ? (way > 0 ? 0 : order.length - 1) : (place + way + order.length) % order.length]));
};
const showTried = () => {  // after any change of what is shown
  remakeForks();
  const goal = triedGoal();
  if (goal && chosen.pose >= 0 && !shownPoses().includes(goal.tried[chosen.pose])) choose(-1);
  else if (chosen.pose >= 0) choose(chosen.pose);
  for (const chip of legend.querySelectorAll("button")) {
    const stage = chip.dataset.stage;
    chip.setAttribute("aria-pressed", String(!hidden.has(stage) && (!chosen.only || chosen.only === stage)));
  }
  draw();
};
const fillLegend = () => {
  const goal = triedGoal();
  $("tried").hidden = !goal || !goal.tried.length || !shown.tried;
  legend.textContent = "";
  if (!goal) return;
  for (const stage of Object.keys(STAGES)) {
    const count = goal.tried.filter((pose) => pose.stage === stage).length;
    if (!count) continue;
    const chip = element("button", "", element("li", "", legend));
    chip.type = "button";
    chip.dataset.stage = stage;
    chip.title = stage === "planned" ? "the grasp of the plan" : `hand poses looked at that fell at: ${stage}`;
    chip.style.setProperty("--c", STAGES[stage]);
    element("span", stage, chip);
    element("b", String(count), chip);
    chip.addEventListener("click", () => {
      if (chosen.only) { chosen.only = ""; chosen.text = ""; unpress(); } else if (hidden.has(stage)) hidden.delete(stage); else hidden.add(stage);
      showTried();
    });
  }
  for (const choice of $("ends").querySelectorAll("option")) choice.disabled = choice.value !== "origin" && !goal.destination;
  if (!goal.destination) $("ends").value = chosen.end = "origin";
  showTried();
};
$("ends").addEventListener("change", () => { chosen.end = $("ends").value; showTried(); });

// ---- reasons
const whys = [...document.querySelectorAll("#told .why")];
const unpress = () => {
  for (const why of [...whys, $("least")]) why.setAttribute("aria-pressed", "false");
  marked.clear();
};
const showGoal = (number) => {
  const index = scene.report.findIndex((goal) => goal.goal === number);
  if (index < 0 || index === chosen.goal) return;
  chosen.goal = index;
  choose(-1);
  fillLegend();
};
const showWhy = (why, only) => {
  const again = why.getAttribute("aria-pressed") === "true";
  unpress();
  [chosen.only, chosen.text] = ["", ""];
  if (!again) {
    showGoal(Number(why.dataset.goal));
    why.setAttribute("aria-pressed", "true");
    for (const name of JSON.parse(why.dataset.bodies)) marked.add(name.replace(/^held /, ""));
    const goal = triedGoal();
    if (only && goal && goal.tried.some((pose) => pose.stage === why.dataset.stage)) {
      [chosen.only, chosen.text] = [why.dataset.stage, why.dataset.text];
      if (!shown.tried) toggle("tried");
    }
  }
  markNames();
  showTried();
};
for (const why of whys) why.addEventListener("click", () => showWhy(why, !why.dataset.cause));
for (const goal of document.querySelectorAll("#told .goal")) {
  goal.addEventListener("toggle", () => { if (goal.open) showGoal(Number(goal.dataset.goal)); });
}
for (const stage of document.querySelectorAll("#told .stage")) stage.style.setProperty("--c", STAGES[stage.dataset.stage]);
$("pickedNext").addEventListener("click", () => chooseNext(1));
$("pickedBefore").addEventListener("click", () => chooseNext(-1));
$("pickedClose").addEventListener("click", () => choose(-1));
