// SPDX-License-Identifier: GPL-3.0-or-later
// Remeshes in a thread of its own. A message is a scan with its options; the answers are progress, and in the end
// the files or an error. To cancel, the page ends the worker.
importScripts("wscvt.js");

const outputs = ["remesh.ply", "remesh.stl", "nodes.csv", "report.html", "report.json"];

onmessage = async ({data}) => {
  let failure = "";
  let sent = 0;
  try {
    const program = await makeWscvt({
      onProgress: (fraction, stage) => {
        if (performance.now() - sent < 50) return;
        sent = performance.now();
        postMessage({fraction, stage});
      },
      onError: text => { failure = text; },
    });
    program.FS.writeFile(data.name, new Uint8Array(data.scan));
    const words = Object.entries(data.options).map(([name, value]) => name + "=" + value);
    const code = program.callMain([data.name, ...words]);
    if (code !== 0) {
      postMessage({error: failure});
      return;
    }
    const files = {};
    for (const name of outputs) {
      files[name] = program.FS.readFile("/" + name);
      program.FS.unlink("/" + name);
    }
    postMessage({files}, Object.values(files).map(file => file.buffer));
  } catch (error) {
    postMessage({error: failure || "The browser stopped the work: " + error.message + ". A scan of millions of " +
                                   "vertices needs the program, which has no limit of 2 GB."});
  }
};
