// SPDX-License-Identifier: GPL-3.0-or-later
// Puts a view that turns in the place of each picture of a page. Without WebGL the pictures stay.
function numbersOf(text, kind) {
  return new kind(Uint8Array.from(atob(text), letter => letter.charCodeAt(0)).buffer);
}

/// Cuts each face into parts * parts: {positions, corners} with points of their own for each face, row by row
/// from its first side to its third corner. turning_view.cpp measures distances in the same order.
function divided({positions, corners}, parts) {
  const points = [];
  const faces = [];
  for (let f = 0; f < corners.length; f += 3) {
    const first = points.length / 3;
    for (let i = 0; i <= parts; ++i) {
      for (let j = 0; j <= parts - i; ++j) {
        for (let k = 0; k < 3; ++k) {
          const [a, b, c] = [0, 1, 2].map(n => positions[3 * corners[f + n] + k]);
          points.push(a + (b - a) * j / parts + (c - a) * i / parts);
        }
      }
    }
    let row = first;
    for (let i = 0; i < parts; ++i) {
      const length = parts - i + 1;
      for (let j = 0; j < parts - i; ++j) {
        faces.push(row + j, row + j + 1, row + length + j);
        if (j + 1 < parts - i) faces.push(row + j + 1, row + length + j + 1, row + length + j);
      }
      row += length;
    }
  }
  return {positions: new Float32Array(points), corners: new Uint32Array(faces)};
}

/// The ends of each edge, once: the two faces of an edge of a closed mesh go along it in opposite directions.
function edgesOf(corners) {
  const ends = [];
  for (let f = 0; f < corners.length; f += 3) {
    const [a, b, c] = corners.slice(f, f + 3);
    if (a < b) ends.push(a, b);
    if (b < c) ends.push(b, c);
    if (c < a) ends.push(c, a);
  }
  return new Uint32Array(ends);
}

/// Shows meshes, as turning_view.cpp writes them, each in the element whose data-view is its place. An element may
/// hold a picture, which is hidden, and is used again for the next meshes.
function turnPictures({turn, meshes, views}) {
  const shapes = meshes.map(({points, faces}) => ({
    positions: Float32Array.from(numbersOf(points, Int16Array), x => x / 32767),
    corners: numbersOf(faces, Uint32Array),
  }));
  const shared = {turn, zoom: 1, views: []};
  for (const {place, mesh, parts, distances, edges, colours} of views) {
    const holder = document.querySelector(`[data-view="${place}"]`);
    if (!holder.view) {
      const canvas = document.createElement("canvas");
      const picture = holder.querySelector("img");
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", (picture ? picture.alt : holder.title) + " It turns with the arrow keys.");
      holder.prepend(canvas);
      holder.view = new View(canvas, shared, 1);
      if (!holder.view.gl) {
        canvas.remove();
        delete holder.view;
        return false;
      }
      holder.classList.add("turns");
    }
    holder.view.shared = shared;
    shared.views.push(holder.view);
    const shape = shapes[mesh];
    if (distances) {
      holder.view.show({...divided(shape, parts), limit: 127,
                        distances: Float32Array.from(numbersOf(distances, Int8Array))});
    } else if (colours) {
      // Each face has points of its own, three of one colour.
      const numbers = numbersOf(colours, Uint8Array);
      holder.view.show({...divided(shape, 1), limit: 1e9,
                        distances: Float32Array.from({length: 3 * numbers.length}, (_, k) => numbers[Math.floor(k / 3)])});
    } else {
      holder.view.show({...shape, edges: edges ? edgesOf(shape.corners) : null});
    }
  }
  return true;
}

if (document.getElementById("views")) turnPictures(JSON.parse(document.getElementById("views").textContent));
