// Vectors and matrices: a matrix is an array of 16 numbers, column by column; z is up.
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const mul = (a, b) => {
  const c = new Array(16);
  for (let j = 0; j < 4; j++) for (let i = 0; i < 4; i++) {
    c[4 * j + i] = a[i] * b[4 * j] + a[4 + i] * b[4 * j + 1] + a[8 + i] * b[4 * j + 2] + a[12 + i] * b[4 * j + 3];
  }
  return c;
};
const inverse = (m) => {  // of a rigid pose
  const p = [m[12], m[13], m[14]], column = (i) => [m[4 * i], m[4 * i + 1], m[4 * i + 2]];
  return [m[0], m[4], m[8], 0, m[1], m[5], m[9], 0, m[2], m[6], m[10], 0, ...[0, 1, 2].map((i) => -dot(column(i), p)), 1];
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
