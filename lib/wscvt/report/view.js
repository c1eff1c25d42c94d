// SPDX-License-Identifier: GPL-3.0-or-later
// Draws a mesh by WebGL, without a library: it turns with the mouse, a finger or the arrow keys.
"use strict";

const vertexShader = `#version 300 es
in vec3 place;
in vec3 normal;
in float distance;
uniform mat3 turn;
uniform vec3 scale;
out vec3 facing;
out float colour;
void main() {
  facing = turn * normal;
  colour = distance;
  gl_Position = vec4(turn * place * scale, 1.0);
}`;
const fragmentShader = `#version 300 es
precision highp float;
in vec3 facing;
in float colour;
uniform float limit;  // distance of the full colour; 0: grey, below 0: an edge, above 1e6: numbers of parts
out vec4 pixel;
void main() {
  if (limit < 0.0) {
    pixel = vec4(0.08, 0.08, 0.1, 1.0);
    return;
  }
  vec3 base = vec3(0.78);
  if (limit > 1e6) {
    base = 0.65 + 0.3 * cos(2.4 * colour + vec3(0.0, 2.1, 4.2));
  } else if (limit > 0.0) {
    float share = clamp(colour / limit, -1.0, 1.0);
    vec3 end = share < 0.0 ? vec3(0.12, 0.31, 0.67) : vec3(0.75, 0.12, 0.18);
    base = mix(vec3(0.96), end, abs(share));
  }
  float light = dot(normalize(facing), normalize(vec3(-0.35, 0.45, 0.82)));
  pixel = vec4(base * (0.4 + 0.6 * max(light, 0.0)), 1.0);
}`;

function compile(gl) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  return program;
}

/// Sums of the faces' normals at the points; the shader makes them unit vectors.
function normalsOf({positions: p, corners}) {
  const normals = new Float32Array(p.length);
  for (let f = 0; f < corners.length; f += 3) {
    const [a, b, c] = [3 * corners[f], 3 * corners[f + 1], 3 * corners[f + 2]];
    const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
    const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const at of [a, b, c]) for (let k = 0; k < 3; ++k) normals[at + k] += n[k];
  }
  return normals;
}

/// Views that turn together share their state: {turn, zoom, views}.
class View {
  /// size: the distance from the middle that is just seen. Without WebGL, `gl` is null.
  constructor(canvas, shared, size) {
    this.canvas = canvas;
    this.shared = shared;
    this.size = size;
    this.mesh = null;
    this.gl = canvas.getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
    if (!this.gl) return;
    this.program = compile(this.gl);
    this.listen();
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  /// A mesh: {positions, corners, distances, limit, edges}; the last three may be missing.
  show(mesh) {
    const gl = this.gl;
    if (this.mesh) {
      gl.deleteVertexArray(this.mesh.array);
      for (const buffer of this.mesh.buffers) gl.deleteBuffer(buffer);
    }
    const buffers = [];
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const fill = (kind, values) => {
      const buffer = gl.createBuffer();
      buffers.push(buffer);
      gl.bindBuffer(kind, buffer);
      gl.bufferData(kind, values, gl.STATIC_DRAW);
      return buffer;
    };
    for (const [name, values, width] of [["place", mesh.positions, 3], ["normal", normalsOf(mesh), 3],
                                         ["distance", mesh.distances, 1]]) {
      const at = gl.getAttribLocation(this.program, name);
      if (!values || at < 0) continue;
      fill(gl.ARRAY_BUFFER, values);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, width, gl.FLOAT, false, 0, 0);
    }
    this.mesh = {array, buffers, faces: fill(gl.ELEMENT_ARRAY_BUFFER, mesh.corners), corners: mesh.corners.length,
                 edges: mesh.edges ? fill(gl.ELEMENT_ARRAY_BUFFER, mesh.edges) : null,
                 ends: mesh.edges ? mesh.edges.length : 0, limit: mesh.limit || 0};
    this.draw();
  }

  draw() {
    const [gl, canvas, mesh] = [this.gl, this.canvas, this.mesh];
    if (!mesh) return;
    const density = Math.min(devicePixelRatio || 1, 2);
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * density));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * density));
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(this.program);
    const {turn, zoom} = this.shared;
    gl.uniformMatrix3fv(gl.getUniformLocation(this.program, "turn"), false, new Float32Array(turn));
    const scale = zoom * Math.min(canvas.width, canvas.height) / this.size;
    gl.uniform3f(gl.getUniformLocation(this.program, "scale"), scale / canvas.width, scale / canvas.height,
                 -0.5 / this.size);
    const limit = gl.getUniformLocation(this.program, "limit");
    gl.bindVertexArray(mesh.array);
    gl.uniform1f(limit, mesh.limit);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, mesh.faces);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    gl.drawElements(gl.TRIANGLES, mesh.corners, gl.UNSIGNED_INT, 0);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    if (!mesh.edges) return;
    gl.uniform1f(limit, -1);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, mesh.edges);
    gl.drawElements(gl.LINES, mesh.ends, gl.UNSIGNED_INT, 0);
  }

  rotate(across, upward) {
    this.shared.turn = multiply(turnAbout(2, across), multiply(turnAbout(1, upward), this.shared.turn));
    for (const view of this.shared.views) view.draw();
  }

  enlarge(factor) {
    this.shared.zoom = Math.min(Math.max(this.shared.zoom * factor, 0.5), 20);
    for (const view of this.shared.views) view.draw();
  }

  listen() {
    const canvas = this.canvas;
    canvas.tabIndex = 0;
    canvas.title = "Drag to turn. After a click the wheel, + and - enlarge.";
    canvas.style.touchAction = "none";
    canvas.addEventListener("pointerdown", event => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", event => {
      if (event.buttons !== 0) this.rotate(event.movementX * 0.01, event.movementY * 0.01);
    });
    canvas.addEventListener("wheel", event => {
      if (!event.ctrlKey && document.activeElement !== canvas) return;  // the page scrolls
      event.preventDefault();
      this.enlarge(Math.exp(-0.001 * event.deltaY));
    }, {passive: false});
    const keys = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]};
    canvas.addEventListener("keydown", event => {
      if (keys[event.key]) this.rotate(...keys[event.key]);
      else if (event.key === "+") this.enlarge(1.15);
      else if (event.key === "-") this.enlarge(1 / 1.15);
      else return;
      event.preventDefault();
    });
  }
}

// Matrices of three by three, column by column, as WebGL takes them.
function multiply(a, b) {
  const c = new Array(9).fill(0);
  for (let i = 0; i < 3; ++i) {
    for (let j = 0; j < 3; ++j) {
      for (let k = 0; k < 3; ++k) c[3 * j + i] += a[3 * k + i] * b[3 * j + k];
    }
  }
  return c;
}

/// A turn about the x axis (1) or the y axis (2) of the picture.
function turnAbout(axis, angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return axis === 1 ? [1, 0, 0, 0, c, s, 0, -s, c] : [c, 0, -s, 0, 1, 0, s, 0, c];
}
