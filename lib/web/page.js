// SPDX-License-Identifier: GPL-3.0-or-later
// The page: takes a scan and options, lets a worker remesh, shows and offers what comes back.
"use strict";

const at = id => document.getElementById(id);
let scan = null;    // {name, bytes}
let worker = null;
let links = [];

function choose(name, bytes) {
  scan = {name, bytes};
  at("chosen").textContent = name + ", " + (bytes.byteLength / 1e6).toPrecision(3) + " MB";
  at("start").disabled = worker !== null;
  showError("");
}

async function take(file) {
  const known = /\.(ply|stl|obj|off)(\.gz)?$/i;
  if (!known.test(file.name)) {
    showError("\"" + file.name + "\" is no mesh that this page reads. Give a .ply, .stl, .obj or .off file, " +
              "also with .gz.");
    return;
  }
  try {
    choose(file.name.replace(/[^\w. -]/g, "_"), await file.arrayBuffer());
  } catch (error) {
    showError("The browser cannot read \"" + file.name + "\": " + error.message + ".");
  }
}

function showError(text) {
  at("error").textContent = text;
  at("error").hidden = text === "";
}

function options() {
  const onScan = at("method").value === "on-scan";
  const values = {method: at("method").value, nodes: at("nodes").value};
  const [placement, radius] = at("placement").value.split(":");
  if (onScan || placement !== "fitted") values.placement = placement;
  if (onScan) values["edge-ratio"] = at("ratio").value;
  if (radius) values["contact-radius"] = radius;
  return values;
}

/// The contact laws by the deepest node want the mesh that is closest to the scan.
function lawChanged() {
  const fits = at("placement").value.startsWith("contact-fit");
  if (fits && at("ratio").value === at("ratio").defaultValue) at("ratio").value = "1.4";
}

function methodChanged() {
  const onScan = at("method").value === "on-scan";
  at("ratio").disabled = !onScan;
  for (const option of at("placement").options) option.disabled = !onScan && option.value.startsWith("contact-fit");
  if (at("placement").selectedOptions[0].disabled) at("placement").value = "fitted";
  at("placement").options[0].textContent =
      onScan ? "none, or the triangles: exact volume" : "none: nodes on the harmonic surface";
}

function stop() {
  if (worker) worker.terminate();
  worker = null;
  at("cancel").hidden = at("progress").hidden = true;
  at("start").disabled = scan === null;
}

function start() {
  stop();
  showError("");
  at("start").disabled = true;
  at("cancel").hidden = at("progress").hidden = false;
  at("progress").value = 0;
  at("stage").textContent = "loading";
  const begun = performance.now();
  worker = new Worker("worker.js");
  worker.onerror = event => {
    stop();
    at("stage").textContent = "";
    showError("The page's program did not start: " + (event.message || "worker.js cannot be loaded") +
              ". Open the page from a web server; a file alone may not start it.");
  };
  worker.onmessage = ({data}) => {
    if (data.stage !== undefined) {
      at("progress").value = data.fraction;
      at("stage").textContent = data.stage;
      return;
    }
    stop();
    if (data.error) {
      at("stage").textContent = "";
      showError(data.error);
    } else {
      at("stage").textContent = "done in " + ((performance.now() - begun) / 1000).toFixed(1) + " s";
      show(data.files);
    }
  };
  // Its own copy: the worker that is ended by Cancel takes it along.
  const copy = scan.bytes.slice(0);
  worker.postMessage({name: scan.name, scan: copy, options: options()}, [copy]);
}

function number(value) {
  if (value === null || value === undefined) return "-";
  if (value === 0) return "0";
  return Math.abs(value) >= 1e-4 && Math.abs(value) < 1e6 ? String(Number(value.toPrecision(6)))
                                                          : value.toExponential(3);
}

function addRow(name, cells) {
  const row = at("rows").insertRow();
  const head = document.createElement("th");
  head.scope = "row";
  head.textContent = name;
  row.append(head);
  for (const cell of cells) row.insertCell().textContent = cell;
}

function show(files) {
  const report = JSON.parse(new TextDecoder().decode(files["report.json"]));
  at("result").hidden = false;
  at("warnings").replaceChildren(...report.warnings.map(text => {
    const item = document.createElement("li");
    item.textContent = "Warning: " + text;
    return item;
  }));
  const name = scan.name.replace(/(\.\w+)(\.gz)?$/i, "");
  at("caption").textContent = name + ": " + report.result.vertices + " nodes, " + report.result.faces +
      " triangles; rms distance " + number(report.rms_distance.percent_of_equivalent_radius) +
      " % of the equivalent radius";
  at("rows").replaceChildren();
  for (const {key, label} of report.descriptor_names) {
    const {scan: before, remesh: after, error_percent: error} = report.descriptors[key];
    const exact = error !== null && Math.abs(error) < 1e-9;
    addRow(label, [number(before), number(after), error === null ? "-" : exact ? "exact" : error.toFixed(3)]);
  }
  const quality = report.quality;
  addRow("smallest angle, degrees", [number(quality.scan.smallest_angle_degrees),
                                     number(quality.remesh.smallest_angle_degrees), "-"]);
  addRow("mean edge ratio", [number(quality.scan.edge_ratio.mean), number(quality.remesh.edge_ratio.mean), "-"]);

  const page = new TextDecoder().decode(files["report.html"]);
  const views = JSON.parse(/<script type="application\/json" id="views">(.*?)<\/script>/s.exec(page)[1]);
  const limit = number(Number((100 * views.views[2].limit / report.input.equivalent_radius).toPrecision(2)));
  at("inside").textContent = "-" + limit + " %";
  at("outside").textContent = "+" + limit + " %";
  at("legend").setAttribute("aria-label", `Colours: blue -${limit} %, white 0, red +${limit} % of the equivalent radius`);
  if (!turnPictures(views)) showError("This browser has no WebGL 2, so there is no picture. The files are whole.");

  links.forEach(link => URL.revokeObjectURL(link.href));
  links = [["remesh.ply", "Mesh (PLY)"], ["remesh.stl", "Mesh (STL)"], ["nodes.csv", "Node table (CSV)"],
           ["report.html", "Report (HTML)"], ["report.json", "Report (JSON)"]].map(([file, label]) => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([files[file]]));
    link.download = name + "_" + file;
    link.textContent = label;
    return link;
  });
  at("downloads").replaceChildren(...links);
  at("made").firstChild.textContent = report.made_by + " is free software under the ";
  at("heading").focus();
}

at("file").addEventListener("change", event => { if (event.target.files[0]) take(event.target.files[0]); });
at("sample").addEventListener("click", async () => {
  try {
    const answer = await fetch("sand_7228.ply.gz");
    if (!answer.ok) throw new Error("the server answers " + answer.status);
    choose("sand_7228.ply.gz", await answer.arrayBuffer());
  } catch (error) {
    showError("The sample grain cannot be loaded: " + error.message + ". Open the page from a web server.");
  }
});
for (const kind of ["dragenter", "dragover", "dragleave", "drop"]) {
  document.addEventListener(kind, event => {
    event.preventDefault();
    at("drop").classList.toggle("over", kind === "dragenter" || kind === "dragover");
    if (kind === "drop" && event.dataTransfer.files[0]) take(event.dataTransfer.files[0]);
  });
}
at("method").addEventListener("change", methodChanged);
at("placement").addEventListener("change", lawChanged);
at("form").addEventListener("submit", event => {
  event.preventDefault();
  if (scan) start();
});
at("cancel").addEventListener("click", () => {
  stop();
  at("stage").textContent = "cancelled";
});
