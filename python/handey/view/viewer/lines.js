// Lines of a width in pixels, as quads: the thin lines of WebGL are faint on fine screens, and some renderers
// lose parts of them. One quad for each line; its corners come from the vertex' number.
const stroke = compile(
  `in vec3 start, stop; in vec4 tint; uniform mat4 model, eye; uniform vec2 screen; uniform float width; out vec4 paint;
   void main() {
     vec4 a = eye * model * vec4(start, 1.0), b = eye * model * vec4(stop, 1.0);
     const float near = 1e-3;  // what is behind the eye is cut off
     if (a.w < near && b.w > near) a = mix(a, b, (near - a.w) / (b.w - a.w));
     else if (b.w < near && a.w > near) b = mix(b, a, (near - b.w) / (a.w - b.w));
     vec2 along = (b.xy / b.w - a.xy / a.w) * screen;
     along = dot(along, along) > 1e-8 ? normalize(along) : vec2(1.0, 0.0);
     vec4 p = gl_VertexID > 1 ? b : a;
     float side = (gl_VertexID & 1) == 1 ? 1.0 : -1.0;
     p.xy += side * width / screen * vec2(-along.y, along.x) * p.w;
     paint = tint;
     gl_Position = p;
   }`,
  `in vec4 paint; out vec4 result; void main() { result = paint; }`, ["start", "stop", "tint"]);
const TINT = 2;
const rowOf = (place, size, stride, offset) => {
  gl.enableVertexAttribArray(place);
  gl.vertexAttribPointer(place, size, gl.FLOAT, false, stride, offset);
  gl.vertexAttribDivisor(place, 1);
};
for (const mesh of meshes) {
  const ends = new Float32Array(3 * mesh.edges.length);
  mesh.edges.forEach((vertex, i) => ends.set(mesh.points.subarray(3 * vertex, 3 * vertex + 3), 3 * i));
  mesh.edgesArray = gl.createVertexArray();
  gl.bindVertexArray(mesh.edgesArray);
  buffer(gl.ARRAY_BUFFER, ends);
  rowOf(0, 3, 24, 0);
  rowOf(1, 3, 24, 12);
}
// Points (x, y, z, r, g, b, a): every two of them a line, or each with the one before it.
const coloured = (data, joined = false) => {
  const array = gl.createVertexArray(), stride = joined ? 28 : 56;
  gl.bindVertexArray(array);
  const points = buffer(gl.ARRAY_BUFFER, new Float32Array(data));
  rowOf(0, 3, stride, 0);
  rowOf(1, 3, stride, 28);
  rowOf(TINT, 4, stride, 12);
  return { array, points, count: joined ? Math.max(data.length / 7 - 1, 0) : data.length / 14 };
};
const recoloured = (made, data) => {
  gl.bindBuffer(gl.ARRAY_BUFFER, made.points);
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(data), gl.DYNAMIC_DRAW);
  made.count = data.length / 14;
};
const beginLines = (view, w, h) => {
  gl.useProgram(stroke.program);
  gl.uniformMatrix4fv(stroke.uniforms.eye, false, view);
  gl.uniform2f(stroke.uniforms.screen, w, h);
};
const drawLines = (made, width) => {
  gl.uniformMatrix4fv(stroke.uniforms.model, false, IDENTITY);
  gl.uniform1f(stroke.uniforms.width, width);
  gl.bindVertexArray(made.array);
  gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, made.count);
};
const drawEdges = (shapes, pose, paint, width) => {
  gl.uniform1f(stroke.uniforms.width, width);
  gl.vertexAttrib4f(TINT, ...paint);
  for (const shape of shapes) {
    const mesh = meshes[shape.mesh];
    gl.uniformMatrix4fv(stroke.uniforms.model, false, mul(pose, shape.pose));
    gl.bindVertexArray(mesh.edgesArray);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, mesh.edges.length / 2);
  }
};
