"use strict";
// Draws what the tables tell: one hidden WebGL canvas renders every picture, which is then copied to its place.
// Flat triangles under a light at the eye, crease edges, and marks (outlines, arrows, holes) as thick lines.
// Matrices are arrays of 16 numbers, column by column; z is up.
(() => {
  const $ = (id) => document.getElementById(id);
  const scene = JSON.parse($("scene").textContent);
  const FOV = 0.6;
  const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
  const FACES = ["#8fb8de", "#f2b880", "#9fd3a8", "#e8a0b4", "#c3b1e1", "#f0d77a", "#8ed1cf", "#d8b48f", "#a9bfa0", "#e3a27f"];
  const PLAIN = rgb("#d3dae1"), INK = rgb("#27313b"), A = rgb("#e8743b"), B = rgb("#2f7fe0"), HOLE = rgb("#d21f3c");

  // ------------------------------------------------------------------------------------ algebra
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
  const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const eyeOf = (c) => add(c.target, [Math.cos(c.turn) * Math.cos(c.tilt), Math.sin(c.turn) * Math.cos(c.tilt), Math.sin(c.tilt)], c.distance);
  const matrixOf = (c, aspect) => {
    const eye = eyeOf(c), back = unit(add(eye, c.target, -1));
    const right = unit(cross([0, 0, 1], back)), up = cross(back, right);
    const look = [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
      -dot(right, eye), -dot(up, eye), -dot(back, eye), 1];
    const near = c.distance * 0.02, far = c.distance * 20, f = 1 / Math.tan(FOV / 2), d = 1 / (near - far);
    // The field of view is that of the shorter side, so that a tall picture shows as much.
    const [fx, fy] = aspect >= 1 ? [f / aspect, f] : [f, f * aspect];
    return mul([fx, 0, 0, 0, 0, fy, 0, 0, 0, 0, (far + near) * d, -1, 0, 0, 2 * far * near * d, 0], look);
  };

  // ------------------------------------------------------------------------------------ drawing
  const glass = document.createElement("canvas");
  const gl = glass.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) { $("broken").hidden = false; $("view").hidden = true; $("hint").hidden = true; }
  const program = gl && (() => {
    const make = (kind, source) => {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      return shader;
    };
    const p = gl.createProgram();
    gl.attachShader(p, make(gl.VERTEX_SHADER, `
      attribute vec3 point, normal, colour; uniform mat4 view; uniform vec2 shift; uniform float pull; uniform vec3 eye;
      varying vec3 shade;
      void main() {
        gl_Position = view * vec4(point, 1.0);
        gl_Position.xy += shift * gl_Position.w;
        gl_Position.z -= pull * gl_Position.w;
        vec3 to = normalize(eye - point);
        float lit = dot(normal, normal) < 0.5 ? 1.0
          : 0.66 + 0.24 * max(dot(normal, to), 0.0) + 0.14 * max(dot(normal, normalize(vec3(0.3, -0.2, 1.0))), 0.0);
        shade = colour * min(lit, 1.06);
      }`));
    gl.attachShader(p, make(gl.FRAGMENT_SHADER, "precision mediump float; varying vec3 shade; void main() { gl_FragColor = vec4(shade, 1.0); }"));
    gl.linkProgram(p);
    gl.useProgram(p);
    for (const name of ["point", "normal", "colour"]) gl.enableVertexAttribArray(gl.getAttribLocation(p, name));
    return p;
  })();
  const buffer = (numbers) => {
    const b = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, b);
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STATIC_DRAW);
    return { b, count: numbers.length / 9 };
  };
  const drop = (b) => gl.deleteBuffer(b.b);
  // A picture is { faces, lines, marks, seen, over } of buffers with nine numbers a point: place, normal, colour.
  // Marks are thick lines; what is seen or over is not hidden by anything, thin and thick.
  const render = (canvas, picture, camera) => {
    if (!gl) return;
    const ratio = Math.min(devicePixelRatio || 1, 2);
    const w = Math.max(2, Math.round(canvas.clientWidth * ratio)), h = Math.max(2, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    if (glass.width !== w || glass.height !== h) [glass.width, glass.height] = [w, h];
    gl.viewport(0, 0, w, h);
    gl.clearColor(0.949, 0.961, 0.973, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.uniformMatrix4fv(gl.getUniformLocation(program, "view"), false, matrixOf(camera, w / h));
    gl.uniform3fv(gl.getUniformLocation(program, "eye"), eyeOf(camera));
    const draw = (what, mode, pull, shift) => {
      if (!what || !what.count) return;
      gl.bindBuffer(gl.ARRAY_BUFFER, what.b);
      ["point", "normal", "colour"].forEach((name, i) => gl.vertexAttribPointer(gl.getAttribLocation(program, name), 3, gl.FLOAT, false, 36, 12 * i));
      gl.uniform1f(gl.getUniformLocation(program, "pull"), pull);
      gl.uniform2f(gl.getUniformLocation(program, "shift"), 2 * shift[0] / w, 2 * shift[1] / h);
      gl.drawArrays(mode, 0, what.count);
    };
    const thick = (what, pull, reach) => {
      for (let x = -reach; x <= reach; x++) for (let y = -reach; y <= reach; y++) draw(what, gl.LINES, pull, [x, y]);
    };
    draw(picture.faces, gl.TRIANGLES, 0, [0, 0]);
    draw(picture.lines, gl.LINES, 2e-4, [0, 0]);
    thick(picture.marks, 6e-4, Math.round(ratio));
    gl.disable(gl.DEPTH_TEST);
    draw(picture.seen, gl.LINES, 0, [0, 0]);
    thick(picture.over, 0, Math.round(ratio));
    canvas.getContext("2d").drawImage(glass, 0, 0);
  };

  // ------------------------------------------------------------------------------------ content
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const meshes = scene.meshes.map((m) => ({
    points: new Float32Array(bytes(m.v)), faces: new Uint32Array(bytes(m.f)), edges: new Uint32Array(bytes(m.e)),
  }));
  const owner = scene.owner ? new Int32Array(bytes(scene.owner)) : null;
  const faceColour = (i) => i < 0 ? PLAIN : rgb(FACES[i % FACES.length]);
  const put = (out, p, n, c) => { out.push(p[0], p[1], p[2], n[0], n[1], n[2], c[0], c[1], c[2]); };
  const NONE = [0, 0, 0];
  const solid = (out, lines, mesh, pose, colour) => {
    const p = (i) => at(pose, mesh.points.subarray(3 * i, 3 * i + 3));
    for (let t = 0; t < mesh.faces.length; t += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => p(mesh.faces[t + k]));
      const n = unit(cross(add(b, a, -1), add(c, a, -1))), shade = typeof colour === "function" ? colour(t / 3) : colour;
      for (const q of [a, b, c]) put(out, q, n, shade);
    }
    for (let e = 0; e < mesh.edges.length; e++) put(lines, p(mesh.edges[e]), NONE, INK);
  };
  const strokes = (out, lines, colour, pose = IDENTITY) => {
    for (const line of lines) for (let i = 0; i + 1 < line.length; i++) {
      put(out, at(pose, line[i]), NONE, colour);
      put(out, at(pose, line[i + 1]), NONE, colour);
    }
  };
  const arrow = (from, to) => {
    const along = add(to, from, -1), length = Math.hypot(...along), u = unit(along);
    const side = unit(cross(u, Math.abs(u[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
    const back = add(to, u, -0.3 * length);
    return [[from, to], [add(back, side, 0.16 * length), to, add(back, side, -0.16 * length)]];
  };
  const build = (choice) => {
    const faces = [], lines = [], marks = [], seen = [], over = [];
    const pose = choice.rest ? choice.rest.pose : IDENTITY;
    for (const body of scene.bodies) {
      let colour = rgb(body.colour);
      if (owner) {
        colour = (t) => {
          const f = owner[t];
          if (choice.face !== undefined) return f === choice.face ? A : PLAIN;
          if (choice.pair) return f >= 0 && f === choice.pair.a ? A : f >= 0 && f === choice.pair.b ? B : PLAIN;
          return faceColour(f);
        };
      } else if (choice.body !== undefined) colour = body.name === choice.body ? A : body.ghost ? rgb("#e9edf1") : PLAIN;
      solid(faces, lines, meshes[body.mesh], mul(pose, body.pose), colour);
      if (choice.body === body.name) {  // its edges shine through what stands before it
        const { points, edges } = meshes[body.mesh];
        for (const e of edges) put(seen, at(body.pose, points.subarray(3 * e, 3 * e + 3)), NONE, A);
      }
    }
    if (choice.pair) {
      strokes(over, choice.pair.onA, rgb("#8c2f00")); strokes(over, choice.pair.onB, rgb("#07336f"));
      const [a, b] = choice.pair.arrows;
      strokes(over, arrow(...a), rgb("#8c2f00")); strokes(over, arrow(...b), rgb("#07336f"));
    }
    if (choice.rest) {
      const r = scene.radius * 1.5;
      const corners = [[-r, -r, 0], [r, -r, 0], [r, r, 0], [-r, r, 0]].map((c) => add(c, [0, 0, -scene.radius * 0.004]));
      for (const i of [0, 1, 2, 0, 2, 3]) put(faces, corners[i], [0, 0, 1], rgb("#e4ddd0"));
      strokes(over, [choice.rest.foot], A);
    }
    for (const goal of scene.goals || []) {
      const chosen = choice.goal === goal.goal;
      strokes(lines, goal.lines, rgb(goal.colour));
      if (chosen) strokes(seen, goal.lines, HOLE);
    }
    strokes(marks, scene.sticks || [], B);
    strokes(over, scene.holes || [], HOLE);
    return Object.fromEntries(Object.entries({ faces, lines, marks, seen, over }).map(([k, v]) => [k, buffer(new Float32Array(v))]));
  };
  const start = () => ({ turn: scene.turn, tilt: 0.45, distance: scene.radius / Math.sin(FOV / 2) * 1.06, target: [...scene.centre] });

  const placeOf = (choice) => {  // middle of a body or of a goal, and how far it is from there to its ends
    const points = [];
    if (choice.goal !== undefined) for (const goal of scene.goals) if (goal.goal === choice.goal) points.push(...goal.lines.flat());
    for (const body of scene.bodies) if (choice.body === body.name) {
      const p = meshes[body.mesh].points;
      for (let i = 0; i < p.length; i += 3) points.push(at(body.pose, p.subarray(i, i + 3)));
    }
    if (!points.length) return null;
    const low = [0, 1, 2].map((i) => points.reduce((m, p) => Math.min(m, p[i]), Infinity));
    const high = [0, 1, 2].map((i) => points.reduce((m, p) => Math.max(m, p[i]), -Infinity));
    return { middle: add(low, high).map((x) => x / 2), size: Math.hypot(...add(high, low, -1)) / 2 };
  };

  // ------------------------------------------------------------------------------------ the view
  const canvas = $("view");
  let choice = {}, picture = gl ? build(choice) : null, camera = start(), waiting = false;
  const draw = () => {
    if (waiting || !gl) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; render(canvas, picture, camera); document.body.dataset.drawn = "1"; });
  };
  const show = (next, words, element) => {
    const again = element && element.getAttribute("aria-selected") === "true";
    for (const e of document.querySelectorAll("[aria-selected]")) e.setAttribute("aria-selected", "false");
    if (element && !again) element.setAttribute("aria-selected", "true");
    const frameOf = (c) => c.rest ? "rest" : c.body !== undefined || c.goal !== undefined ? JSON.stringify(c) : "";
    const before = frameOf(choice);
    choice = again ? {} : next;
    $("shown").textContent = again ? "" : words;
    if (!gl) return;
    if (frameOf(choice) !== before) {
      const turned = camera;
      camera = start();
      const place = placeOf(choice);
      if (choice.rest) camera.target = [0, 0, choice.rest.top / 2];
      if (place) camera = { ...turned, target: place.middle, distance: Math.min(camera.distance, Math.max(0.3 * camera.distance, 5 * place.size)) };
    }
    Object.values(picture).forEach(drop);
    picture = build(choice);
    draw();
  };
  for (const row of document.querySelectorAll("[data-show]")) {
    const [kind, key] = [row.dataset.show.slice(0, row.dataset.show.indexOf(":")), row.dataset.show.slice(row.dataset.show.indexOf(":") + 1)];
    const what = { face: () => ({ face: Number(key) }), pair: () => ({ pair: scene.pairs[Number(key)] }),
      rest: () => ({ rest: scene.rests[Number(key)] }), body: () => ({ body: key }),
      goal: () => ({ goal: Number(key) }) }[kind];
    row.setAttribute("aria-selected", "false");
    if (row.tagName !== "BUTTON") row.tabIndex = 0;
    const act = () => show(what(), row.dataset.words || "", row);
    row.addEventListener("click", act);
    if (row.tagName !== "BUTTON") row.addEventListener("keydown", (e) => { if (e.key === "Enter" || e.key === " ") { e.preventDefault(); act(); } });
  }
  const small = () => {  // placements as small pictures
    for (const button of document.querySelectorAll("#rests button")) {
      const rest = scene.rests[Number(button.dataset.show.split(":")[1])], made = build({ rest });
      render(button.querySelector("canvas"), made, { ...start(), target: [0, 0, rest.top / 2], distance: start().distance * 0.92 });
      Object.values(made).forEach(drop);
    }
  };
  const orbit = (dx, dy) => {
    camera.turn -= dx * 0.008;
    camera.tilt = Math.min(Math.max(camera.tilt + dy * 0.008, -1.5), 1.5);
    draw();
  };
  const zoom = (factor) => {
    camera.distance = Math.min(Math.max(camera.distance * factor, scene.radius * 0.3), scene.radius * 40);
    draw();
  };
  const fingers = new Map();
  canvas.addEventListener("pointerdown", (e) => { canvas.setPointerCapture(e.pointerId); fingers.set(e.pointerId, [e.clientX, e.clientY]); });
  canvas.addEventListener("pointermove", (e) => {
    const old = fingers.get(e.pointerId);
    if (!old) return;
    if (fingers.size === 2) {
      const other = [...fingers.entries()].find(([id]) => id !== e.pointerId)[1];
      const before = Math.hypot(old[0] - other[0], old[1] - other[1]), after = Math.hypot(e.clientX - other[0], e.clientY - other[1]);
      if (after > 1) zoom(before / after);
    } else orbit(e.clientX - old[0], e.clientY - old[1]);
    fingers.set(e.pointerId, [e.clientX, e.clientY]);
  });
  for (const kind of ["pointerup", "pointercancel"]) canvas.addEventListener(kind, (e) => fingers.delete(e.pointerId));
  canvas.addEventListener("wheel", (e) => { e.preventDefault(); zoom(Math.exp(Math.max(-60, Math.min(60, e.deltaY)) * 0.0022)); }, { passive: false });
  canvas.addEventListener("dblclick", () => { camera = start(); draw(); });
  canvas.addEventListener("keydown", (e) => {
    const act = { ArrowLeft: () => orbit(-20, 0), ArrowRight: () => orbit(20, 0), ArrowUp: () => orbit(0, 20), ArrowDown: () => orbit(0, -20),
      "+": () => zoom(0.85), "=": () => zoom(0.85), "-": () => zoom(1 / 0.85) }[e.key];
    if (act) { e.preventDefault(); act(); }
  });
  if (gl) {
    new ResizeObserver(draw).observe(canvas);
    small();
    let last = innerWidth;
    addEventListener("resize", () => { if (innerWidth !== last) { last = innerWidth; small(); } });
  }
  const first = document.querySelector("[data-first]");
  if (first) first.click(); else draw();
})();
