// Drawing with WebGL 2: flat-shaded triangles, one light with a shadow map.
const canvas = $("view");
const gl = canvas.getContext("webgl2", { antialias: true, alpha: false });
if (!gl) {  // what is told can be read all the same
  $("broken").hidden = false;
  $("broken").textContent = "No picture: it needs WebGL 2, which this browser does not offer.";
  return;
}
const SHADOW = 2048;
const compile = (vertex, fragment, places = ["point", "tint"]) => {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, "#version 300 es\nprecision highp float;\nprecision highp sampler2DShadow;\n" + text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  places.forEach((name, place) => gl.bindAttribLocation(program, place, name));
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
  `in vec3 place; in vec3 lit; uniform vec3 colour, viewer, sun; uniform float ambient, glow, alpha; uniform sampler2DShadow shade; out vec4 result;
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
     result = vec4(mix(c, colour, glow), alpha);
   }`);
const flat = compile(
  `in vec3 point; uniform mat4 model, eye; void main() { gl_Position = eye * model * vec4(point, 1.0); }`,
  `out vec4 result; void main() { result = vec4(0.0); }`);
const spot = compile(
  `in vec3 point; uniform mat4 eye; uniform float size; void main() { gl_Position = eye * vec4(point, 1.0); gl_PointSize = size; }`,
  `uniform vec3 colour; out vec4 result; void main() { if (length(gl_PointCoord - 0.5) > 0.5) discard; result = vec4(colour, 1.0); }`);

const buffer = (kind, data) => {
  const b = gl.createBuffer();
  gl.bindBuffer(kind, b);
  gl.bufferData(kind, data, gl.STATIC_DRAW);
  return b;
};
for (const mesh of meshes) {
  mesh.facesArray = gl.createVertexArray();
  gl.bindVertexArray(mesh.facesArray);
  buffer(gl.ARRAY_BUFFER, mesh.points);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
  buffer(gl.ELEMENT_ARRAY_BUFFER, mesh.faces);
}
const triangles = (points) => {  // of places alone, three by three
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  const kept = buffer(gl.ARRAY_BUFFER, new Float32Array(points));
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
  return { array, points: kept, count: points.length / 3 };
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
