// One picture: shadow map, bodies, edges, goals, trace.
let seenBy = IDENTITY;
let now = 0, playing = false, asked = false;
const shown = { trace: true, goals: true, labels: true, joints: innerWidth > 640 && !failed, grasp: true, tried: failed };
const draw = () => { if (!asked) { asked = true; requestAnimationFrame(paint); } };
const sun = (() => {  // from the front, beside the first view, so that the sides seen are lit
  const from = Math.atan2(work.centre[1] - scene.robot.base[13], work.centre[0] - scene.robot.base[12]) || 0;
  return unit([Math.cos(from - 0.25), Math.sin(from - 0.25), 1.25]);
})();
const lightView = (() => {  // orthographic, around everything
  const c = everything.centre, r = everything.radius * 1.02, right = unit(cross([0, 0, 1], sun)), up = cross(sun, right);
  return [right[0] / r, up[0] / r, -sun[0] / r, 0, right[1] / r, up[1] / r, -sun[1] / r, 0, right[2] / r, up[2] / r, -sun[2] / r, 0,
    -dot(right, c) / r, -dot(up, c) / r, dot(sun, c) / r, 1];
})();

const drawFaces = (shapes, pose, program) => {
  for (const shape of shapes) {
    const mesh = meshes[shape.mesh];
    gl.uniformMatrix4fv(program.uniforms.model, false, mul(pose, shape.pose));
    gl.bindVertexArray(mesh.facesArray);
    gl.drawElements(gl.TRIANGLES, mesh.faces.length, gl.UNSIGNED_INT, 0);
  }
};
const spotPoint = triangles([0, 0, 0]);

const drawSpot = (view, place, colour, size) => {
  gl.bindBuffer(gl.ARRAY_BUFFER, spotPoint.points);
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(place), gl.DYNAMIC_DRAW);
  gl.useProgram(spot.program);
  gl.uniformMatrix4fv(spot.uniforms.eye, false, view);
  gl.uniform3fv(spot.uniforms.colour, colour);
  gl.uniform1f(spot.uniforms.size, size);
  gl.bindVertexArray(spotPoint.array);
  gl.disable(gl.DEPTH_TEST);
  gl.drawArrays(gl.POINTS, 0, 1);
};
let last = 0;
const paint = (stamp) => {
  asked = false;
  if (playing) {
    now += Math.min((stamp - last) / 1000, 0.1) * Number($("speed").value);
    last = stamp;
    if (now >= end) { now = end; setPlaying(false); } else draw();
    $("scrub").value = now;
  }
  const ratio = Math.min(devicePixelRatio || 1, 2);
  const [w, h] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  const colours = theme(), step = stepAt(now), row = rowAt(now), poses = bodiesAt(row), parts = partsAt(step, poses);
  const items = scene.robot.bodies.map((body, i) => ({
    name: body.name, shapes: body.shapes, pose: poses[i],
    colour: rgb(scene.robot.fingers.includes(i) ? colours.finger : i === scene.robot.hand ? colours.hand : i % 2 ? colours.link : colours.link2),
  }));
  for (const body of scene.fixtures) items.push({ ...body, colour: rgb(body.support ? colours.support : colours.fixture) });
  scene.parts.forEach((part, i) => items.push({
    name: part.name, shapes: part.shapes, pose: parts[i], colour: rgb(partColour(i)), glow: step && step.held === part.name ? 0.25 : 0,
  }));
  for (const item of items) {  // what the parts stand on is tinged only: it is large, and behind all
    if (!marked.has(item.name)) continue;
    const red = rgb(MARKED), share = item.support ? 0.22 : 1;
    item.colour = item.colour.map((c, k) => c * (1 - share) + red[k] * share);
    item.glow = item.support ? 0 : 0.3;
  }

  gl.enable(gl.DEPTH_TEST);
  gl.enable(gl.POLYGON_OFFSET_FILL);
  gl.bindFramebuffer(gl.FRAMEBUFFER, shadowFrame);
  gl.viewport(0, 0, SHADOW, SHADOW);
  gl.clear(gl.DEPTH_BUFFER_BIT);
  gl.useProgram(flat.program);
  gl.uniformMatrix4fv(flat.uniforms.eye, false, lightView);
  gl.polygonOffset(2, 4);
  for (const item of items) drawFaces(item.shapes, item.pose, flat);

  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.viewport(0, 0, w, h);
  gl.clearColor(...colours.sky, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  const eye = eyePoint();
  const view = mul(perspective(FOV, w / Math.max(h, 1), camera.distance * 0.02, camera.distance * 6 + 20), lookAt(eye, camera.target));
  gl.useProgram(solid.program);
  gl.uniformMatrix4fv(solid.uniforms.eye, false, view);
  gl.uniformMatrix4fv(solid.uniforms.light, false, lightView);
  gl.uniform3fv(solid.uniforms.viewer, eye);
  gl.uniform3fv(solid.uniforms.sun, sun);
  gl.uniform1f(solid.uniforms.ambient, colours.ambient);
  gl.uniform1i(solid.uniforms.shade, 0);
  gl.uniform1f(solid.uniforms.alpha, 1);
  gl.bindTexture(gl.TEXTURE_2D, shadowMap);
  gl.polygonOffset(1, 1);
  // What is marked lets see the hand poses behind it.
  const seenThrough = items.filter((item) => shown.tried && marked.has(item.name) && !item.support);
  const drawSolid = (item) => {
    gl.uniform3fv(solid.uniforms.colour, item.colour);
    gl.uniform1f(solid.uniforms.glow, item.glow || 0);
    drawFaces(item.shapes, item.pose, solid);
  };
  for (const item of items) if (!seenThrough.includes(item)) drawSolid(item);
  if (shown.tried) drawTried();
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  if (shown.tried) drawGhosts();
  gl.uniform1f(solid.uniforms.alpha, 0.32);
  gl.depthMask(false);
  for (const item of seenThrough) drawSolid(item);
  gl.depthMask(true);
  beginLines(view, w, h);
  for (const item of items) drawEdges(item.shapes, item.pose, colours.edge, ratio);
  if (shown.goals) {
    for (const goal of goalPoses) {
      drawEdges(scene.parts[goal.part].shapes, goal.pose, [...rgb(partColour(goal.part)), 1], 1.6 * ratio);
    }
  }
  drawLines(grid, ratio);
  if (shown.trace && traceLine) drawLines(traceLine, 1.8 * ratio);
  if (shown.grasp) drawFrames(handAt(poses), row[width - 1], 2 * ratio);
  if (shown.trace && traceLine) drawSpot(view, handAt(poses).slice(12, 15), rgb(ACTIONS[step.action]), 8 * ratio);
  gl.disable(gl.BLEND);
  seenBy = view;
  labels(view, parts, canvas.clientWidth, canvas.clientHeight);
  readout(step, row);
};
