"use strict";
// Plays a plan: the robot by forward kinematics from the rows of the plan, parts where each step leaves them.
// Drawn with WebGL 2: flat-shaded triangles, one light with a shadow map, crease edges. Matrices are arrays of
// 16 numbers, column by column; z is up.
(() => {
  const $ = (id) => document.getElementById(id);
  const scene = JSON.parse($("scene").textContent);
  const plan = scene.plan;
  const dark = matchMedia("(prefers-color-scheme: dark)");

  // ------------------------------------------------------------------------------------ colours
  const ACTIONS = {
    transit: "#7a8794", approach: "#0f9d9d", grasp: "#d98200", depart: "#2f9e44", transfer: "#2f6fde",
    deposit: "#7a4fd0", release: "#b8621b", withdraw: "#c2417c",
  };
  const MEANING = {
    transit: "the empty hand travels", approach: "the hand moves in over the part", grasp: "the fingers close",
    depart: "the part leaves its place", transfer: "the part travels", deposit: "the part moves in to its place",
    release: "the fingers open", withdraw: "the hand moves out",
  };
  const PARTS = ["#e8743b", "#2f8fdd", "#3fae5a", "#d9a514", "#b45bd0", "#e0527f", "#14a5a0", "#8a6a48"];
  const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
  const partColour = (i) => PARTS[i % PARTS.length];
  const theme = () => dark.matches
    ? { sky: [0.106, 0.125, 0.149], low: [0.075, 0.086, 0.102], grid: [1, 1, 1, 0.10], edge: [0, 0, 0, 0.55], ambient: 0.50,
        fixture: "#66727f", support: "#7d8894", link: "#d7dade", link2: "#b9bfc6", hand: "#5a646f", finger: "#8d98a5" }
    : { sky: [0.933, 0.949, 0.965], low: [0.85, 0.876, 0.90], grid: [0.1, 0.15, 0.2, 0.13], edge: [0.05, 0.08, 0.11, 0.5], ambient: 0.62,
        fixture: "#9aa7b4", support: "#c9d1d8", link: "#f4f2ee", link2: "#d8d5cf", hand: "#55606b", finger: "#7f8b98" };

  // ------------------------------------------------------------------------------------ algebra
  const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const mul = (a, b) => {
    const c = new Array(16);
    for (let j = 0; j < 4; j++) for (let i = 0; i < 4; i++) {
      c[4 * j + i] = a[i] * b[4 * j] + a[4 + i] * b[4 * j + 1] + a[8 + i] * b[4 * j + 2] + a[12 + i] * b[4 * j + 3];
    }
    return c;
  };
  const at = (m, p) => [0, 1, 2].map((i) => m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i]);
  const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => { const n = Math.hypot(...a) || 1; return a.map((x) => x / n); };
  const turn = ([x, y, z], angle) => {
    const c = Math.cos(angle), s = Math.sin(angle), d = 1 - c;
    return [x * x * d + c, y * x * d + z * s, z * x * d - y * s, 0, x * y * d - z * s, y * y * d + c, z * y * d + x * s, 0,
      x * z * d + y * s, y * z * d - x * s, z * z * d + c, 0, 0, 0, 0, 1];
  };
  const shift = ([x, y, z], s) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x * s, y * s, z * s, 1];
  const lookAt = (eye, target) => {
    const back = unit(add(eye, target, -1));
    const right = unit(Math.abs(back[2]) > 0.9999 ? [-Math.sin(camera.turn), Math.cos(camera.turn), 0] : cross([0, 0, 1], back));
    const up = cross(back, right);
    return [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
      -dot(right, eye), -dot(up, eye), -dot(back, eye), 1];
  };
  const perspective = (fov, aspect, near, far) => {
    const f = 1 / Math.tan(fov / 2), d = 1 / (near - far);
    return [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) * d, -1, 0, 0, 2 * far * near * d, 0];
  };

  // ------------------------------------------------------------------------------------ data
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
  const handAt = (poses) => mul(poses[scene.robot.hand], scene.robot.grasp);
  const partsAt = (step, poses) => scene.parts.map((part) => {
    if (step === null) return plan.start[part.name];
    if (part.name === step.held && step.grip) return mul(handAt(poses), step.grip);
    return step.parts[part.name] || plan.start[part.name];
  });

  // ------------------------------------------------------------------------------------ drawing
  const canvas = $("view");
  const gl = canvas.getContext("webgl2", { antialias: true, alpha: false });
  if (!gl) {
    $("broken").hidden = false;
    $("broken").textContent = "This page needs WebGL 2, which this browser does not offer.";
    return;
  }
  const SHADOW = 2048;
  const compile = (vertex, fragment) => {
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, "#version 300 es\nprecision highp float;\nprecision highp sampler2DShadow;\n" + text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.bindAttribLocation(program, 0, "point");
    gl.bindAttribLocation(program, 1, "tint");
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const uniforms = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const name = gl.getActiveUniform(program, i).name;
      uniforms[name] = gl.getUniformLocation(program, name);
    }
    return { program, uniforms };
  };
  const solid = compile(
    `in vec3 point; uniform mat4 model, eye, light; out vec3 place; out vec3 lit;
     void main() { vec4 w = model * vec4(point, 1.0); place = w.xyz; lit = (light * w).xyz * 0.5 + 0.5; gl_Position = eye * w; }`,
    `in vec3 place; in vec3 lit; uniform vec3 colour, viewer, sun; uniform float ambient, glow; uniform sampler2DShadow shade; out vec4 result;
     void main() {
       vec3 n = normalize(cross(dFdx(place), dFdy(place)));
       vec3 v = normalize(viewer - place);
       if (dot(n, v) < 0.0) n = -n;
       float face = max(dot(n, sun), 0.0);
       float slope = 0.0006 + 0.0022 * (1.0 - face);
       float open = 0.0;
       for (int i = -1; i <= 1; i++) for (int j = -1; j <= 1; j++)
         open += texture(shade, vec3(lit.xy + vec2(i, j) / ${SHADOW}.0, lit.z - slope));
       open = any(lessThan(lit, vec3(0.0))) || any(greaterThan(lit, vec3(1.0))) ? 1.0 : open / 9.0;
       float sky = 0.5 + 0.5 * n.z, fill = max(dot(n, v), 0.0);
       vec3 c = colour * (ambient * (0.62 + 0.25 * sky + 0.13 * fill) + (1.0 - ambient) * 1.25 * face * open);
       c += 0.10 * open * pow(max(dot(n, normalize(v + sun)), 0.0), 40.0);
       result = vec4(mix(c, colour, glow), 1.0);
     }`);
  const flat = compile(
    `in vec3 point; uniform mat4 model, eye; void main() { gl_Position = eye * model * vec4(point, 1.0); }`,
    `uniform vec4 paint; out vec4 result; void main() { result = paint; }`);
  const tinted = compile(
    `in vec3 point; in vec4 tint; uniform mat4 eye; out vec4 paint; void main() { paint = tint; gl_Position = eye * vec4(point, 1.0); gl_PointSize = 7.0; }`,
    `in vec4 paint; out vec4 result; void main() { result = paint; }`);

  const buffer = (kind, data) => {
    const b = gl.createBuffer();
    gl.bindBuffer(kind, b);
    gl.bufferData(kind, data, gl.STATIC_DRAW);
    return b;
  };
  for (const mesh of meshes) {
    const points = buffer(gl.ARRAY_BUFFER, mesh.points);
    for (const key of ["faces", "edges"]) {
      mesh[key + "Array"] = gl.createVertexArray();
      gl.bindVertexArray(mesh[key + "Array"]);
      gl.bindBuffer(gl.ARRAY_BUFFER, points);
      gl.enableVertexAttribArray(0);
      gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
      buffer(gl.ELEMENT_ARRAY_BUFFER, mesh[key]);
    }
  }
  const coloured = (data) => {  // points (x, y, z, r, g, b, a)
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    buffer(gl.ARRAY_BUFFER, new Float32Array(data));
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 28, 0);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 4, gl.FLOAT, false, 28, 12);
    return { array, count: data.length / 7 };
  };
  const shadowMap = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, shadowMap);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.DEPTH_COMPONENT24, SHADOW, SHADOW, 0, gl.DEPTH_COMPONENT, gl.UNSIGNED_INT, null);
  for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
    [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE],
    [gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE]]) gl.texParameteri(gl.TEXTURE_2D, key, value);
  const shadowFrame = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, shadowFrame);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, shadowMap, 0);
  gl.drawBuffers([gl.NONE]);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);

  // ------------------------------------------------------------------------------------ what is there
  const bounds = (items) => {  // of shapes at poses: [{shapes, pose}]
    const low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9];
    for (const { shapes, pose } of items) for (const shape of shapes) {
      const m = mul(pose, shape.pose), p = meshes[shape.mesh].points;
      for (let i = 0; i < p.length; i += 3) {
        const w = at(m, [p[i], p[i + 1], p[i + 2]]);
        for (let k = 0; k < 3; k++) { low[k] = Math.min(low[k], w[k]); high[k] = Math.max(high[k], w[k]); }
      }
    }
    return { low, high, centre: low.map((x, k) => (x + high[k]) / 2), radius: Math.hypot(...add(high, low, -1)) / 2 };
  };
  const startBodies = bodiesAt(rowAt(0));
  const robotItems = scene.robot.bodies.map((body, i) => ({ shapes: body.shapes, pose: startBodies[i] }));
  const everything = bounds([...robotItems, ...scene.fixtures, ...scene.parts]);
  const goalPoses = scene.goals.filter((goal) => goal.at).map((goal) => ({
    part: scene.parts.findIndex((part) => part.name === goal.part), pose: goal.at,
  }));
  const work = bounds([...scene.parts, ...goalPoses.map((goal) => ({ shapes: scene.parts[goal.part].shapes, pose: goal.pose })),
    ...robotItems]);

  const trace = [];
  const tracePoints = [];
  if (!still) {
    for (const step of plan.steps) {
      const c = rgb(ACTIONS[step.action]);
      for (let k = step.row; k < step.row + step.rows; k++) {
        const p = handAt(bodiesAt(Array.from(rows.subarray(k * width, (k + 1) * width)))).slice(12, 15);
        trace.push(...p, ...c, 0.95);
        tracePoints.push(time[k]);
      }
    }
  }
  const traceLine = trace.length ? coloured(trace) : null;
  const grid = (() => {
    const lines = [], z = everything.low[2] - 0.002, [x, y] = [Math.round(everything.centre[0] * 5) / 5, Math.round(everything.centre[1] * 5) / 5];
    const [r, g, b, a] = theme().grid, n = 15;
    for (let i = -n; i <= n; i++) for (const along of [0, 1]) for (let j = -n; j < n; j++) for (const e of [j, j + 1]) {
      const fade = a * Math.max(0, 1 - Math.hypot(i, e) / n);
      const p = along ? [x + i * 0.2, y + e * 0.2] : [x + e * 0.2, y + i * 0.2];
      lines.push(...p, z, r, g, b, fade);
    }
    return coloured(lines);
  })();

  // ------------------------------------------------------------------------------------ camera
  const camera = { turn: 0, tilt: 0, distance: 1, target: [0, 0, 0] };
  const FOV = 0.65;
  // What a framed picture must hold: everything that happens, or (close) only where hand and parts work.
  const corners = ({ low, high }) => [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [0, 1, 2].map((k) => (i >> k & 1 ? high : low)[k]));
  const interest = (() => {
    const places = [...scene.parts, ...goalPoses.map((goal) => ({ shapes: scene.parts[goal.part].shapes, pose: goal.pose }))];
    const close = places.flatMap((item) => corners(bounds([item]))), whole = close.slice();
    for (const item of robotItems) if (item.shapes.length) whole.push(...corners(bounds([item])));
    for (const step of plan.steps) {
      const rowsOfStep = Math.max(Math.floor(step.rows / 12), 1);
      for (let k = step.row; k < step.row + step.rows; k += rowsOfStep) {
        const hand = Array.from(trace.slice(7 * k, 7 * k + 3));
        whole.push(hand);
        if (step.action !== "transit") close.push(hand, add(hand, [0, 0, 0.2]));
      }
    }
    return { whole, close };
  })();
  const frame = (view = 0, points = interest.whole) => {
    const heading = Math.atan2(work.centre[1] - scene.robot.base[13], work.centre[0] - scene.robot.base[12]) || 0;
    [camera.turn, camera.tilt] = [[heading + 0.62, 0.40], [heading, 0.10], [heading - Math.PI / 2, 0.10], [heading + 0.001, 1.56]][view];
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

  // ------------------------------------------------------------------------------------ a picture
  let now = 0, playing = false, asked = false;
  const shown = { trace: true, goals: true, labels: true, joints: innerWidth > 640 };
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

  const drawShapes = (kind, shapes, pose, program) => {
    for (const shape of shapes) {
      const mesh = meshes[shape.mesh];
      gl.uniformMatrix4fv(program.uniforms.model, false, mul(pose, shape.pose));
      gl.bindVertexArray(mesh[kind + "Array"]);
      gl.drawElements(kind === "faces" ? gl.TRIANGLES : gl.LINES, mesh[kind].length, gl.UNSIGNED_INT, 0);
    }
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
      shapes: body.shapes, pose: poses[i],
      colour: rgb(scene.robot.fingers.includes(i) ? colours.finger : i === scene.robot.hand ? colours.hand : i % 2 ? colours.link : colours.link2),
    }));
    for (const body of scene.fixtures) items.push({ ...body, colour: rgb(body.support ? colours.support : colours.fixture) });
    scene.parts.forEach((part, i) => items.push({
      shapes: part.shapes, pose: parts[i], colour: rgb(partColour(i)), glow: step && step.held === part.name ? 0.25 : 0,
    }));

    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.bindFramebuffer(gl.FRAMEBUFFER, shadowFrame);
    gl.viewport(0, 0, SHADOW, SHADOW);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.useProgram(flat.program);
    gl.uniformMatrix4fv(flat.uniforms.eye, false, lightView);
    gl.polygonOffset(2, 4);
    for (const item of items) drawShapes("faces", item.shapes, item.pose, flat);

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
    gl.bindTexture(gl.TEXTURE_2D, shadowMap);
    gl.polygonOffset(1, 1);
    for (const item of items) {
      gl.uniform3fv(solid.uniforms.colour, item.colour);
      gl.uniform1f(solid.uniforms.glow, item.glow || 0);
      drawShapes("faces", item.shapes, item.pose, solid);
    }
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.useProgram(flat.program);
    gl.uniformMatrix4fv(flat.uniforms.eye, false, view);
    gl.uniform4fv(flat.uniforms.paint, colours.edge);
    for (const item of items) drawShapes("edges", item.shapes, item.pose, flat);
    if (shown.goals) {
      for (const goal of goalPoses) {
        gl.uniform4fv(flat.uniforms.paint, [...rgb(partColour(goal.part)), 1]);
        drawShapes("edges", scene.parts[goal.part].shapes, goal.pose, flat);
      }
    }
    gl.useProgram(tinted.program);
    gl.uniformMatrix4fv(tinted.uniforms.eye, false, view);
    gl.bindVertexArray(grid.array);
    gl.drawArrays(gl.LINES, 0, grid.count);
    if (shown.trace && traceLine) {
      gl.bindVertexArray(traceLine.array);
      gl.drawArrays(gl.LINE_STRIP, 0, traceLine.count);
      gl.disable(gl.DEPTH_TEST);
      gl.drawArrays(gl.POINTS, Math.max(tracePoints.findIndex((t) => t >= now), 0), 1);
    }
    gl.disable(gl.BLEND);
    labels(view, parts, canvas.clientWidth, canvas.clientHeight);
    readout(step, row);
  };

  // ------------------------------------------------------------------------------------ words
  const element = (tag, text = "", parent = null) => {
    const e = document.createElement(tag);
    e.textContent = text;
    if (parent) parent.append(e);
    return e;
  };
  const tops = scene.parts.map((part) => bounds([{ shapes: part.shapes, pose: IDENTITY }]));
  const tags = scene.parts.map((part, i) => {
    const tag = element("span", part.name, $("labels"));
    tag.style.setProperty("--c", partColour(i));
    return tag;
  });
  const labels = (view, parts, w, h) => {
    const placed = [];
    tags.map((tag, i) => {
      const p = at(parts[i], tops[i].centre);
      p[2] += tops[i].radius + 0.03;
      const depth = view[3] * p[0] + view[7] * p[1] + view[11] * p[2] + view[15], q = at(view, p);
      tag.hidden = depth <= 0;
      return { tag, x: (0.5 + 0.5 * q[0] / depth) * w, y: (0.5 - 0.5 * q[1] / depth) * h };
    }).sort((a, b) => b.y - a.y).forEach(({ tag, x, y }) => {  // the lower stay, the others make room
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
    const goal = scene.goals[step ? step.goal : 0];
    const aside = step && step.held && goal && step.held !== goal.part ? `${step.held} aside, then ` : "";
    $("task").textContent = goal
      ? `${scene.goals.length > 1 ? `Goal ${(step ? step.goal : 0) + 1} of ${scene.goals.length}: ` : ""}${aside}place ${goal.part}${goal.on ? " on " + goal.on : goal.inside ? " inside " + goal.inside : ""}`
      : "";
    blocks.forEach((block, i) => block.classList.toggle("here", plan.steps[i] === step));
    $("scrub").setAttribute("aria-valuetext", `${now.toFixed(2)} seconds, ${action}`);
  };

  // ------------------------------------------------------------------------------------ time
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

  // ------------------------------------------------------------------------------------ hands
  const toggle = (key) => {
    shown[key] = !shown[key];
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
  canvas.addEventListener("pointerdown", (e) => {
    canvas.setPointerCapture(e.pointerId);
    fingers.set(e.pointerId, [e.clientX, e.clientY]);
  });
  canvas.addEventListener("pointermove", (e) => {
    const old = fingers.get(e.pointerId);
    if (!old) return;
    const dx = e.clientX - old[0], dy = e.clientY - old[1];
    if (fingers.size === 2) {
      const other = [...fingers.entries()].find(([id]) => id !== e.pointerId)[1];
      const before = Math.hypot(old[0] - other[0], old[1] - other[1]), after = Math.hypot(e.clientX - other[0], e.clientY - other[1]);
      if (after > 1) zoom(before / after);
      pan(dx / 2, dy / 2);
    } else if (e.buttons & 6 || e.shiftKey) pan(dx, dy); else orbit(dx, dy);
    fingers.set(e.pointerId, [e.clientX, e.clientY]);
  });
  for (const kind of ["pointerup", "pointercancel"]) canvas.addEventListener(kind, (e) => fingers.delete(e.pointerId));
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("wheel", (e) => {
    e.preventDefault();
    zoom(Math.exp(Math.max(-60, Math.min(60, e.deltaY)) * 0.0022));
  }, { passive: false });
  addEventListener("keydown", (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || e.target.tagName === "SELECT") return;
    if (e.target.tagName === "BUTTON" && (e.key === " " || e.key === "Enter")) return;
    const keys = {
      " ": () => still || setPlaying(!playing), Home: () => seek(0), End: () => seek(end),
      ArrowLeft: () => e.shiftKey ? jump(-1) : seek(now - 0.05), ArrowRight: () => e.shiftKey ? jump(1) : seek(now + 0.05),
      t: () => toggle("trace"), g: () => toggle("goals"), l: () => toggle("labels"), j: () => toggle("joints"), f: reframe,
      "1": () => frame(0), "2": () => frame(1), "3": () => frame(2), "4": () => frame(3), "?": help,
      "+": () => zoom(0.85), "=": () => zoom(0.85), "-": () => zoom(1 / 0.85),
      Escape: () => { if (!$("keys").hidden) help(); },
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
  show();
  frame();
})();
