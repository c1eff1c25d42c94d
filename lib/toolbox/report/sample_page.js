// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the figures of a sample's HTML report from the JSON in its element "data". Loads no other files.
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
// A single sample is named by the page.
const nameOf = sample => data.samples.length > 1 ? sample.name : "";
const headed = (sample, caption) => data.samples.length > 1 ? sample.name + ": " + caption :
    caption[0].toUpperCase() + caption.slice(1);
const colours = ["#0a58b4", "#c2570c"];
const width = 460, height = 330, left = 62, right = 14, top_ = 14, bottom = 48;
const escaped = text => String(text).replace(/[&<>"]/g, c => "&#" + c.charCodeAt(0) + ";");
const shown = value => value === null || !isFinite(value) ? "-" : String(+value.toPrecision(4));
const heading = column => column.unit ? column.words + ", " + column.unit : column.words;
// Words for a column, with its unit.
const wordsOf = name => {
  const column = data.samples[0].columns.find(one => one.name === name);
  return column ? heading(column) : name;
};
const found = value => value !== null && isFinite(value);
function values(sample, name) {
  const k = sample.columns.findIndex(column => column.name === name);
  return k < 0 ? null : sample.values[k];
}
function weightsOf(sample, weighting) {
  return weighting === "mass" ? sample.mass : sample.size.map(() => 1);
}

// Files that a reader saves.
function save(name, text, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], {type: type}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
function csv(rows) {
  const field = cell => {
    const text = cell === null || cell === undefined ? "" : String(cell);
    return /[",\n\r]/.test(text) ? '"' + text.replace(/"/g, '""') + '"' : text;
  };
  return rows.map(row => row.map(field).join(",")).join("\r\n") + "\r\n";
}

// A figure: draw() gives {svg, rows}; rows are its data. Returns a function that draws it again.
function figure(place, name, caption, draw) {
  const box = document.createElement("figure");
  const picture = box.appendChild(document.createElement("div"));
  const below = box.appendChild(document.createElement("figcaption"));
  below.append(caption + " ");
  let drawn = null;
  const button = (label, action) => {
    const one = below.appendChild(document.createElement("button"));
    one.type = "button";
    one.textContent = label;
    one.setAttribute("aria-label", label + " of " + name);
    one.onclick = action;
  };
  button("SVG", () => save(name + ".svg", drawn.svg, "image/svg+xml"));
  button("CSV", () => save(name + ".csv", csv(drawn.rows), "text/csv"));
  document.getElementById(place).append(box);
  const redraw = () => {
    drawn = draw();
    picture.innerHTML = drawn.svg;
  };
  redraw();
  return redraw;
}
function svgOf(body) {
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" ` +
      `font-family="sans-serif" font-size="12"><rect width="${width}" height="${height}" ` +
      `fill="#fff"/>${body}</svg>`;
}
const at = value => value.toFixed(1);
function text(x, y, words, more) {
  return `<text x="${at(x)}" y="${at(y)}" ${more || ""}>${escaped(words)}</text>`;
}
function line(x1, y1, x2, y2, colour, more) {
  return `<line x1="${at(x1)}" y1="${at(y1)}" x2="${at(x2)}" y2="${at(y2)}" ` +
      `stroke="${colour}" ${more || ""}/>`;
}
function path(points, colour, more) {
  return `<polyline points="${points.map(p => at(p[0]) + "," + at(p[1])).join(" ")}" ` +
      `fill="none" stroke="${colour}" stroke-width="1.8" ${more || ""}/>`;
}
function names(drawnSamples) {
  return drawnSamples.map((sample, k) => text(left + 8, top_ + 14 + 15 * k, nameOf(sample),
      `fill="${colours[k]}"`)).join("");
}

// Axes: numbers at 1, 2 and 5 times powers of ten.
function ticks(low, high, logarithmic) {
  const list = [];
  if (logarithmic) {
    const wide = high / low > 300;
    for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high) + 1; ++e) {
      for (const m of wide ? [1] : [1, 2, 5]) {
        const v = m * 10 ** e;
        if (v >= low * 0.999 && v <= high * 1.001) list.push(v);
      }
    }
    if (list.length > 1) return list;
    list.length = 0;  // less than a decade: even steps
  }
  const rough = (high - low) / 6;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map(m => m * power).find(s => s >= rough) || rough;
  for (let v = Math.ceil(low / step) * step; v <= high + step * 1e-9; v += step) list.push(v);
  return list;
}
function axes(x, y) {  // of each: low, high, label; log; at: the places of the numbers
  const map = (axis, from, to) => {
    const f = axis.log ? Math.log10 : v => v;
    const a = f(axis.low), b = f(axis.high);
    return v => from + (f(v) - a) / (b - a || 1) * (to - from);
  };
  const px = map(x, left, width - right), py = map(y, height - bottom, top_);
  let body = "";
  for (const v of x.at || ticks(x.low, x.high, x.log)) {
    body += line(px(v), top_, px(v), height - bottom, "#ddd");
    body += text(px(v), height - bottom + 16, shown(v), 'text-anchor="middle"');
  }
  for (const v of ticks(y.low, y.high, y.log)) {
    body += line(left, py(v), width - right, py(v), "#ddd");
    body += text(left - 6, py(v) + 4, shown(v), 'text-anchor="end"');
  }
  body += text((left + width - right) / 2, height - 10, x.label, 'text-anchor="middle"');
  const middle = (top_ + height - bottom) / 2;
  body += text(14, middle, y.label, `text-anchor="middle" transform="rotate(-90 14 ${middle})"`);
  return {px: px, py: py, body: body};
}
function range(lists) {
  let low = Infinity, high = -Infinity;
  for (const list of lists) {
    for (const v of list) {
      if (!found(v)) continue;
      low = Math.min(low, v);
      high = Math.max(high, v);
    }
  }
  if (!(low < high)) {
    const size = Math.abs(low) || 1;
    return [low - 0.01 * size, low + 0.01 * size];
  }
  return [low, high];
}

// Share of the weight below each size: half of a grain's own counts.
function smaller(sample, weighting) {
  const weights = weightsOf(sample, weighting);
  const order = sample.size.map((_, k) => k).sort((a, b) => sample.size[a] - sample.size[b]);
  const total = weights.reduce((sum, w) => sum + w, 0);
  let below = 0;
  const points = order.map(k => {
    below += weights[k];
    return [sample.size[k], 100 * (below - 0.5 * weights[k]) / total];
  });
  const step = Math.max(1, Math.floor(points.length / 400));
  return points.filter((_, k) => k % step === 0 || k === points.length - 1);
}
function sizeCurve() {
  const [low, high] = range(data.samples.map(sample => sample.size));
  const label = data.samples[0].sizeName;
  const a = axes({low: low, high: high, log: true, label: label},
                 {low: 0, high: 100, label: "smaller, %"});
  let body = a.body;
  const rows = [["sample", "weighting", label, "smaller_percent"]];
  data.samples.forEach((sample, s) => {
    for (const weighting of ["mass", "number"]) {
      const points = smaller(sample, weighting);
      body += path(points.map(p => [a.px(p[0]), a.py(p[1])]), colours[s],
                   weighting === "mass" ? "" : 'stroke-dasharray="5 4"');
      for (const p of points) rows.push([sample.name, weighting, p[0], p[1]]);
    }
  });
  return {svg: svgOf(body + names(data.samples)), rows: rows};
}

// Weights in the cells of a grid as colours, the fullest cell darkest.
function shade(share) {
  const part = Math.sqrt(share);
  const mixed = (from, to) => Math.round(from + part * (to - from));
  return `rgb(${mixed(240, 8)},${mixed(245, 48)},${mixed(252, 107)})`;
}
function axesOf(sample) {
  for (const kind of ["box", "inertia"]) {
    const found_ = ["s", "i", "l"].map(name => values(sample, "axis_" + name + "_" + kind));
    if (found_.every(list => list)) return {kind: kind, s: found_[0], i: found_[1], l: found_[2]};
  }
  return null;
}
function zingg(sample, weighting) {
  const form = axesOf(sample);
  const weights = weightsOf(sample, weighting);
  const cells = 25, counts = new Map();
  const rows = [["grain", "S/I", "I/L", "weight"]];
  let fullest = 0;
  sample.grains.forEach((grain, k) => {
    const x = form.s[k] / form.i[k], y = form.i[k] / form.l[k];
    if (!found(x) || !found(y)) return;
    rows.push([grain, x, y, weights[k]]);
    const cell = Math.min(cells - 1, Math.floor(x * cells)) * cells +
        Math.min(cells - 1, Math.floor(y * cells));
    counts.set(cell, (counts.get(cell) || 0) + weights[k]);
    fullest = Math.max(fullest, counts.get(cell));
  });
  const a = axes({low: 0, high: 1, label: "flatness S / I (" + form.kind + ")"},
                 {low: 0, high: 1, label: "elongation I / L"});
  let body = a.body;
  for (const [cell, weight] of counts) {
    const x = Math.floor(cell / cells) / cells, y = (cell % cells) / cells;
    const w = a.px(x + 1 / cells) - a.px(x), h = a.py(y) - a.py(y + 1 / cells);
    body += `<rect x="${at(a.px(x))}" y="${at(a.py(y + 1 / cells))}" width="${at(w)}" ` +
        `height="${at(h)}" fill="${shade(weight / fullest)}"/>`;
  }
  const limit = 2 / 3;
  body += line(a.px(limit), a.py(0), a.px(limit), a.py(1), "#333", 'stroke-dasharray="4 3"');
  body += line(a.px(0), a.py(limit), a.px(1), a.py(limit), "#333", 'stroke-dasharray="4 3"');
  for (const [word, x, y] of [["discs", 0.02, 0.94], ["spheres", 0.98, 0.94],
                              ["blades", 0.02, 0.03], ["rods", 0.98, 0.03]]) {
    body += text(a.px(x), a.py(y), word,
                 `fill="#333" text-anchor="${x < 0.5 ? "start" : "end"}" ` +
                 'stroke="#fff" stroke-width="3" paint-order="stroke"');
  }
  return {svg: svgOf(body), rows: rows};
}
function sneedFolk(sample, weighting) {
  const form = axesOf(sample);
  const weights = weightsOf(sample, weighting);
  const levels = 25, counts = new Map();
  const rows = [["grain", "S/L", "(L-I)/(L-S)", "weight"]];
  let fullest = 0;
  // Cells of equal area: fewer beside each other the narrower the triangle is.
  const beside = row => Math.max(1, Math.round(levels * (1 - (row + 0.5) / levels)));
  sample.grains.forEach((grain, k) => {
    const y = form.s[k] / form.l[k];
    const range_ = form.l[k] - form.s[k];
    const t = range_ > 0 ? (form.l[k] - form.i[k]) / range_ : 0.5;
    if (!found(y) || !found(t)) return;
    rows.push([grain, y, t, weights[k]]);
    const row = Math.min(levels - 1, Math.floor(y * levels)), many = beside(row);
    const cell = row * levels + Math.min(many - 1, Math.floor(t * many));
    counts.set(cell, (counts.get(cell) || 0) + weights[k]);
    fullest = Math.max(fullest, counts.get(cell));
  });
  const side = 310, x0 = (width - side) / 2, base = height - 44, tall = side * Math.sqrt(3) / 2;
  const corner = (y, t) => [x0 + side * (0.5 * y + t * (1 - y)), base - tall * y];
  const polygon = (points, fill, stroke) =>
      `<polygon points="${points.map(p => at(p[0]) + "," + at(p[1])).join(" ")}" ` +
      `fill="${fill}" stroke="${stroke}"/>`;
  let body = "";
  for (const [cell, weight] of counts) {
    const row = Math.floor(cell / levels), many = beside(row), k = cell % levels;
    const y = row / levels, next = (row + 1) / levels;
    body += polygon([corner(y, k / many), corner(y, (k + 1) / many), corner(next, (k + 1) / many),
                     corner(next, k / many)], shade(weight / fullest), "none");
  }
  body += polygon([corner(0, 0), corner(0, 1), corner(1, 0)], "none", "#333");
  for (const y of [0.3, 0.5, 0.7]) {
    const [a, b] = [corner(y, 0), corner(y, 1)];
    body += line(a[0], a[1], b[0], b[1], "#333", 'stroke-dasharray="4 3"');
    body += text(a[0] - 6, a[1] + 4, "S/L " + y, 'text-anchor="end" fill="#333"');
  }
  for (const [t, name] of [[1 / 3, "1/3"], [2 / 3, "2/3"]]) {
    const [a, b] = [corner(0, t), corner(0.7, t)];
    body += line(a[0], a[1], b[0], b[1], "#333", 'stroke-dasharray="4 3"');
    body += text(a[0], base + 16, name, 'text-anchor="middle" fill="#333"');
  }
  body += text(width / 2 + 10, base - tall + 6, "compact", 'fill="#333"');
  body += text(x0, base + 16, "platy", 'text-anchor="middle" fill="#333"');
  body += text(x0 + side, base + 16, "elongated", 'text-anchor="middle" fill="#333"');
  body += text(width / 2, base + 34, "(L - I) / (L - S), axes of the " + form.kind,
               'text-anchor="middle"');
  return {svg: svgOf(body), rows: rows};
}

function histogram(name, weighting) {
  const lists = data.samples.map(sample => values(sample, name) || []);
  const [low, high] = range(lists);
  const most = Math.max(...lists.map(list => list.length));
  const bins = Math.round(Math.min(60, Math.max(8, Math.sqrt(most))));
  const step = (high - low) / bins;
  const rows = [["sample", "from", "to", "percent_by_" + weighting]];
  let highest = 0;
  const bars = data.samples.map((sample, s) => {
    const weights = weightsOf(sample, weighting), counts = new Array(bins).fill(0);
    let total = 0;
    lists[s].forEach((v, k) => {
      if (!found(v) || !found(weights[k])) return;
      counts[Math.min(bins - 1, Math.max(0, Math.floor((v - low) / step)))] += weights[k];
      total += weights[k];
    });
    return counts.map((count, b) => {
      const percent = total > 0 ? 100 * count / total : 0;
      rows.push([sample.name, low + b * step, low + (b + 1) * step, percent]);
      highest = Math.max(highest, percent);
      return percent;
    });
  });
  const a = axes({low: low, high: high, label: wordsOf(name)},
                 {low: 0, high: highest * 1.15 || 1, label: "grains by " + weighting + ", %"});
  let body = a.body;
  bars.forEach((percents, s) => {
    const points = [[a.px(low), a.py(0)]];
    percents.forEach((percent, b) => points.push(
        [a.px(low + b * step), a.py(percent)], [a.px(low + (b + 1) * step), a.py(percent)]));
    points.push([a.px(high), a.py(0)]);
    body += path(points, colours[s]);
  });
  return {svg: svgOf(body + names(data.samples)), rows: rows};
}
function againstSize(name) {
  // A little beyond the outermost grains, so that none lies on the edge.
  const [low, high] = range(data.samples.map(sample => sample.size));
  const [from, to] = range(data.samples.map(sample => values(sample, name) || []));
  const beyond = (high / low) ** 0.03, above = 0.03 * (to - from);
  const a = axes({low: low / beyond, high: high * beyond, log: true,
                  label: data.samples[0].sizeName},
                 {low: from - above, high: to + above, label: wordsOf(name)});
  const rows = [["sample", "grain", "size", name]];
  let body = a.body;
  data.samples.forEach((sample, s) => {
    const list = values(sample, name) || [];
    const step = Math.max(1, Math.floor(list.length / 2000));
    const radius = list.length < 200 ? 3 : 1.6;
    list.forEach((v, k) => {
      if (!found(v)) return;
      rows.push([sample.name, sample.grains[k], sample.size[k], v]);
      if (k % step !== 0) return;
      body += `<circle cx="${at(a.px(sample.size[k]))}" cy="${at(a.py(v))}" r="${radius}" ` +
          `fill="${colours[s]}" fill-opacity="0.45"/>`;
    });
  });
  return {svg: svgOf(body + names(data.samples)), rows: rows};
}
function againstVoxels(sample, name) {
  const raw = values(sample, name) || [];
  const corrected = sample.corrected[sample.resolved.indexOf(name)] || [];
  const [low, high] = range([sample.across, [data.leastAcross]]);
  const [from, to] = range([raw, corrected]);
  const beyond = (high / low) ** 0.03, above = 0.03 * (to - from);
  const a = axes({low: low / beyond, high: high * beyond, log: true, label: "voxels across"},
                 {low: from - above, high: to + above, label: wordsOf(name)});
  const limit = a.px(data.leastAcross);
  const words = (x, place, text_) => text(x, top_ + 14, text_, `text-anchor="${place}" fill="#333"`);
  let body = `<rect x="${at(limit)}" y="${top_}" width="${at(width - right - limit)}" ` +
      `height="${height - bottom - top_}" fill="#e8f3e8"/>` + a.body +
      line(limit, top_, limit, height - bottom, "#333", 'stroke-dasharray="4 3"') +
      words(limit + 5, "start", "from " + data.leastAcross + " voxels");
  const rows = [["grain", "voxels_across", "raw", "corrected"]];
  const step = Math.max(1, Math.floor(raw.length / 2000));
  const radius = raw.length < 200 ? 3 : 1.6;
  sample.across.forEach((voxels, k) => {
    if (!found(voxels)) return;
    rows.push([sample.grains[k], voxels, raw[k], corrected[k]]);
    if (k % step !== 0) return;
    const mark = (v, more) => found(v) ? `<circle cx="${at(a.px(voxels))}" cy="${at(a.py(v))}" ` +
        `r="${radius}" ${more}/>` : "";
    body += mark(raw[k], 'fill="none" stroke="#888"');
    body += mark(corrected[k], `fill="${colours[0]}" fill-opacity="0.6"`);
  });
  return {svg: svgOf(body), rows: rows};
}
function median(list) {
  const sorted = list.filter(found).sort((a, b) => a - b), n = sorted.length;
  return n > 0 ? (sorted[n - 1 >> 1] + sorted[n >> 1]) / 2 : null;
}
// Of the median grain: the error of its voxels in %, and the nodes that they resolve.
function byVoxels(name) {
  const sample = data.samples[0], across = sample.across || [];
  const corrected = (sample.corrected || [])[sample.resolved.indexOf(name)] || [];
  const raw = values(sample, name) || [], area = values(sample, "area") || [];
  const diameter = values(sample, "equivalent_diameter") || [];
  return [median(corrected.map((v, k) => found(v) ? 100 * Math.abs(raw[k] / v - 1) : null)),
          median(across.map((n, k) => found(n) && found(diameter[k]) && found(area[k]) ?
              data.nodesOfFace * area[k] * (n / diameter[k]) ** 2 : null))];
}
function errors(name) {
  const levels = data.levels;
  const row = levels.rows.find(one => one.name === name);
  const [voxelError, enough] = byVoxels(name);
  const all = row.median.concat(row.percent_90, voxelError).filter(v => found(v) && v > 0);
  const marks = row.unit === "%" ? [levels.mark] : [];  // the mark is in %
  const [least, most] = all.length ? range([all.concat(marks)]) : [0.1, 10];
  const [first, last] = range([levels.nodes.concat(enough)]);
  const a = axes({low: first * 0.9, high: last * 1.1, log: true, at: levels.nodes,
                  label: "number of nodes N"},
                 {low: least * 0.8, high: most * 1.25, log: true,
                  label: "error, " + row.unit +
                      (/^(rms_distance|contact_(?!normal))/.test(name) ?
                      " of the equivalent radius" : "")});
  const curve = list => levels.nodes.map((n, k) => [n, list[k]])
      .filter(p => found(p[1]) && p[1] > 0).map(p => [a.px(p[0]), a.py(p[1])]);
  let body = a.body;
  for (const mark of marks) body += line(left, a.py(mark), width - right, a.py(mark), "#a00");
  body += path(curve(row.percent_90), colours[0]);
  body += path(curve(row.median), colours[0], 'stroke-dasharray="5 4"');
  for (const p of curve(row.percent_90).concat(curve(row.median))) {
    body += `<circle cx="${at(p[0])}" cy="${at(p[1])}" r="3" fill="${colours[0]}"/>`;
  }
  if (voxelError > 0) {
    body += line(left, a.py(voxelError), width - right, a.py(voxelError), "#333",
                 'stroke-dasharray="4 3"') +
        text(width - right - 4, a.py(voxelError) - 4, "error of the voxels", 'text-anchor="end"');
  }
  if (enough > 0) {
    const x = a.px(enough), onRight = x > width / 2;
    body += line(x, top_, x, height - bottom, "#333", 'stroke-dasharray="4 3"') +
        text(x + (onRight ? -4 : 4), top_ + 12, "nodes that the voxels resolve",
             `text-anchor="${onRight ? "end" : "start"}"`);
  }
  const rows = [["nodes", "median_percent", "percent_90", "voxels_median_percent",
                 "nodes_resolved"]];
  const resolved = found(enough) ? Math.round(enough) : null;
  levels.nodes.forEach((n, k) =>
      rows.push([n, row.median[k], row.percent_90[k], voxelError, resolved]));
  return {svg: svgOf(body), rows: rows};
}

// Controls.
function choice(place, label, options, chosen, changed) {
  const box = document.createElement("label");
  box.append(label + " ");
  const select = box.appendChild(document.createElement("select"));
  for (const [value, words] of options) {
    const one = select.appendChild(document.createElement("option"));
    one.value = value;
    one.textContent = words;
    one.selected = value === chosen;
  }
  select.onchange = () => changed(select.value);
  const where = document.getElementById(place);
  where.append(box, " ");
  return select;
}
const weightings = [["mass", "by mass"], ["number", "by number"]];
const columnChoices = data.samples[0].columns.map(column => [column.name, heading(column)]);
const first = ["sphericity_wadell", "convexity"].find(name => values(data.samples[0], name)) ||
    columnChoices[0][0];

figure("curves", "size", "Fraction of the sample that is smaller. Line: by mass. Dashed: by number.",
       sizeCurve);
let formWeighting = "number";
const forms = [];
data.samples.forEach(sample => {
  if (!axesOf(sample)) return;
  forms.push(figure("forms", "zingg", headed(sample, "form after Zingg (1935), darker: more."),
                    () => zingg(sample, formWeighting)));
  forms.push(figure("forms", "sneed_folk",
                    headed(sample, "form after Sneed and Folk (1958), darker: more."),
                    () => sneedFolk(sample, formWeighting)));
});
if (forms.length > 0) {
  choice("forms-choice", "Weight of a grain", weightings, formWeighting, value => {
    formWeighting = value;
    forms.forEach(redraw => redraw());
  });
}
let shownColumn = first, shownWeighting = "number";
const distributions = [
  figure("distributions", "histogram", "Distribution of the descriptor.",
         () => histogram(shownColumn, shownWeighting)),
  figure("distributions", "size_correlation", "The descriptor against the size.",
         () => againstSize(shownColumn)),
];
choice("distributions-choice", "Descriptor", columnChoices, first, value => {
  shownColumn = value;
  distributions.forEach(redraw => redraw());
});
choice("distributions-choice", "Weight of a grain", weightings, shownWeighting, value => {
  shownWeighting = value;
  distributions.forEach(redraw => redraw());
});
const scanned = data.samples.filter(sample => sample.resolved.length > 0);
if (scanned.length > 0) {
  const names_ = scanned[0].resolved;
  let shownVoxels = names_.includes(first) ? first : names_[0];
  const caption = "against the voxels across. Ring: raw. Dot: corrected. Green: can be trusted.";
  const redraws = scanned.map(sample => figure("voxels", "voxels_across", headed(sample, caption),
                                               () => againstVoxels(sample, shownVoxels)));
  choice("voxels-choice", "Descriptor", names_.map(name => [name, wordsOf(name)]), shownVoxels, value => {
    shownVoxels = value;
    redraws.forEach(redraw => redraw());
  });
}
if (data.levels) {
  let shownLevel = data.levels.rows[0].name;
  const caption = "Line: 90 % of the grains have a smaller error. Dashed: median. Red: mark." +
      (scanned.length > 0 ? " Grey, of the median grain: below the error of the voxels, and beyond " +
          "the nodes that they resolve, more nodes tell nothing of the grain." : "");
  const redraw = figure("levels", "levels", caption, () => errors(shownLevel));
  choice("levels-choice", "Error of", data.levels.rows.map(row => [row.name, row.words]), shownLevel,
         value => {
           shownLevel = value;
           redraw();
         });
}

// Grains that a wanted interval needs.
function needed() {
  const percent = Number(document.getElementById("wanted").value);
  const body = document.getElementById("needed");
  body.textContent = "";
  for (const row of data.needed) {
    const reach = (row.upper - row.lower) / 2 / Math.abs(row.value);
    const count = percent > 0 && found(reach) ?
        Math.ceil(data.samples[0].count * (100 * reach / percent) ** 2) : null;
    const cells = [row.name, shown(row.value), found(reach) ? shown(100 * reach) : "-",
                   count === null ? "-" : String(count)];
    const line_ = body.insertRow();
    for (const cell of cells) line_.insertCell().textContent = cell;
  }
}
document.getElementById("wanted").oninput = needed;
needed();

// Thumbnails by a column.
const thumbs = [];
data.samples.forEach((sample, s) => {
  for (const [row, picture] of Object.entries(sample.thumbs)) {
    thumbs.push({sample: sample, row: Number(row), picture: picture, colour: colours[s]});
  }
});
if (thumbs.length > 0) {
  let key = "size", up = "up";
  const place = document.getElementById("thumbs");
  const value = one => key === "size" ? one.sample.size[one.row] :
      (values(one.sample, key) || [])[one.row];
  const show = () => {
    const sign = up === "up" ? 1 : -1;
    thumbs.sort((a, b) => {
      const [va, vb] = [value(a), value(b)];
      if (!found(va) || !found(vb)) return (found(va) ? 0 : 1) - (found(vb) ? 0 : 1);
      return sign * (va - vb);
    });
    place.textContent = "";
    for (const one of thumbs) {
      const box = place.appendChild(document.createElement("figure"));
      const image = box.appendChild(document.createElement("img"));
      image.src = one.picture;
      image.alt = image.title = one.sample.grains[one.row];
      const words = box.appendChild(document.createElement("figcaption"));
      words.textContent = shown(value(one));
      words.style.color = one.colour;
    }
  };
  choice("thumb-choice", "Sorted by", [["size", "size"]].concat(columnChoices), key, chosen => {
    key = chosen;
    show();
  });
  choice("thumb-choice", "", [["up", "smallest first"], ["down", "largest first"]], up, chosen => {
    up = chosen;
    show();
  });
  show();
}

// The day of the file. Who serves it without a date would show today's.
const written = new Date(document.lastModified);
if (Date.now() - written > 10000) {
  const two = number => String(number).padStart(2, "0");
  document.getElementById("date").textContent = " File of " + written.getFullYear() + "-" +
      two(written.getMonth() + 1) + "-" + two(written.getDate()) + ".";
}
// In print, all is seen.
window.onbeforeprint = () => document.querySelectorAll("details").forEach(one => one.open = true);
