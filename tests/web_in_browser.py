#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses the page of lib/web in headless Chromium and Firefox as a person does, and compares its files with the program's.

    tests/web_in_browser.py PROGRAM PAGE MESHES FOLDER [chromium] [firefox]

PROGRAM is wscvt, PAGE what lib/web/build.sh made. Pictures of the page, wide and narrow, stay in FOLDER. Needs
chromium-driver, python3-selenium, firefox-esr and python3-numpy; tests/run_all.sh web installs them and runs this.
"""
import base64
import functools
import gzip
import http.server
import json
import pathlib
import shutil
import subprocess
import sys
import threading
import time

import numpy
from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from firefox_remote import Firefox

CASES = [("sand_7228.ply", {"nodes": "1000"}, []),
         ("sand_5658.ply", {"nodes": "300", "placement": "on-surface"}, ["-n", "300", "-p", "on-surface"]),
         ("angular_6000.ply", {"nodes": "500", "placement": "contact-fit:1.3"},
          ["-n", "500", "--edge-ratio", "1.4", "-p", "contact-fit", "--contact-radius", "1.3"]),
         ("elongated_rough_8000.ply", {"nodes": "300", "method": "as-published"},
          ["-n", "300", "--method", "as-published"])]
LARGEST = 1500000


class Handler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def wait(driver, script, seconds, what):
    end = time.time() + seconds
    while time.time() < end:
        if driver.execute_script("return " + script):
            return
        time.sleep(0.1)
    sys.exit(f"After {seconds} s the page does not show: {what}. Its text:\n"
             + driver.find_element(By.TAG_NAME, "main").text)


def at(driver, name):
    return driver.find_element(By.ID, name)


def files_of(driver):
    """The files that the page offers, by the ends of their names."""
    texts = driver.execute_async_script("""
      const done = arguments[arguments.length - 1];
      Promise.all([...document.querySelectorAll('#downloads a')].map(async link => {
        const blob = await (await fetch(link.href)).blob();
        const reader = new FileReader();
        return new Promise(resolve => {
          reader.onload = () => resolve([link.download, reader.result.split(',')[1] || '']);
          reader.readAsDataURL(blob);
        });
      })).then(done);""")
    return {name.rpartition("_")[2]: base64.b64decode(text) for name, text in texts}


def remesh(driver, scan, options, seconds=300):
    """As a person does, except that a choice in a list is set by a script, which is the same in all browsers."""
    for name, value in options.items():
        driver.execute_script(f"""
          const element = document.getElementById({json.dumps(name)});
          element.value = {json.dumps(value)};
          element.dispatchEvent(new Event("change", {{bubbles: true}}));""")
    at(driver, "file").send_keys(str(scan))
    wait(driver, "!document.getElementById('start').disabled", 60, "a button that can be pressed")
    at(driver, "start").click()
    wait(driver, "/^done/.test(document.getElementById('stage').textContent)", seconds, "done")


def compare(program, driver, scan, arguments, folder):
    made = files_of(driver)
    names = {"remesh.ply": "remesh.ply", "nodes.csv": "nodes.csv", "report.json": "report.json",
             "report.html": "report.html", "remesh.stl": "remesh.stl"}
    native = folder / "native"
    shutil.rmtree(native, ignore_errors=True)
    native.mkdir()
    shutil.copy(scan, native)
    for output in ("remesh.ply", "remesh.stl"):
        reports = ["--report", "report.json", "--report", "report.html", "--node-table", "nodes.csv"]
        subprocess.run([program, "remesh", scan.name, output, "-q", *arguments, *(reports if "ply" in output else [])],
                       cwd=native, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    for name in names:
        wanted = (native / name).read_bytes()
        if name.endswith(("json", "html")):
            # Only the program knows the day.
            wanted = undated(wanted)
            made[name] = undated(made[name])
        if wanted != made[name]:
            (folder / ("other_" + name)).write_bytes(made[name])
            sys.exit(f"{scan.name}: the page's {name} is not the program's; see {folder}/other_{name} and {native}.")
    print(f"{scan.name} {' '.join(arguments)}: {len(names)} files have the program's bytes.", flush=True)


def undated(report):
    text = report.decode()
    day = time.strftime("%Y-%m-%d")
    return text.replace(f'"date": "{day}"', '"date": null').replace('"date": ""', '"date": null').replace(f" on {day}", "")


def picture(driver, width, height, path):
    # A window of Chromium is never narrower than 500 pixels, but a telephone is.
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500})
    time.sleep(0.5)
    high = driver.execute_script("return document.documentElement.scrollHeight")
    wide = driver.execute_script("return document.documentElement.scrollWidth")
    if wide > width:
        sys.exit(f"The page is {wide} pixels wide in a window of {width}.")
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": width, "height": high, "deviceScaleFactor": 1, "mobile": width < 500})
    time.sleep(0.5)
    driver.save_screenshot(str(path))


def check_files(driver, address, program, meshes, folder):
    for name, options, arguments in CASES:
        driver.get(address)
        remesh(driver, meshes / name, options)
        compare(program, driver, meshes / name, arguments, folder)


def check_turning(driver):
    view = driver.find_element(By.CSS_SELECTOR, "[data-view='1'] canvas")
    before = view.screenshot_as_png
    view.send_keys(Keys.ARROW_LEFT * 5)
    if view.screenshot_as_png == before:
        sys.exit("The grain does not turn.")


def check_keyboard(driver, address, folder):
    """The sample, by the keyboard alone, and its pictures."""
    driver.get(address)
    at(driver, "sample").send_keys(Keys.ENTER)
    wait(driver, "!document.getElementById('start').disabled", 60, "the sample grain")
    at(driver, "nodes").send_keys(Keys.ENTER)
    wait(driver, "/^done/.test(document.getElementById('stage').textContent)", 300, "done")
    if driver.execute_script("return document.activeElement.id") != "heading":
        sys.exit("The result has not got the focus, so a screen reader does not tell of it.")
    for width, height in ((1366, 768), (420, 800)):
        picture(driver, width, height, folder / f"page-{width}.png")
    driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    check_turning(driver)


def check_cancel(driver, address, meshes, folder):
    """Cancel, another scan after it, and what cannot be read."""
    driver.get(address)
    at(driver, "nodes").clear()
    at(driver, "nodes").send_keys("7000")
    at(driver, "file").send_keys(str(meshes / "sand_7228.ply"))
    wait(driver, "!document.getElementById('start').disabled", 60, "a button that can be pressed")
    at(driver, "start").click()
    wait(driver, "document.getElementById('progress').value > 0", 60, "progress")
    at(driver, "cancel").click()
    wait(driver, "document.getElementById('stage').textContent === 'cancelled'", 5, "cancelled")
    packed = folder / "packed.ply.gz"
    packed.write_bytes(gzip.compress((meshes / "sand_5658.ply").read_bytes()))
    remesh(driver, packed, {"nodes": "100"})
    (folder / "wrong.ply").write_text("no mesh")
    at(driver, "file").send_keys(str(folder / "wrong.ply"))
    time.sleep(0.5)
    at(driver, "start").click()
    wait(driver, "!document.getElementById('error').hidden", 60, "an error")
    print("The page says: " + at(driver, "error").text)

def write_large(path):
    """A bumpy ellipsoid of a million vertices, as binary PLY."""
    rows, columns = 707, 1414
    up, along = numpy.meshgrid((numpy.arange(rows) + 0.5) * numpy.pi / rows,
                               numpy.arange(columns) * 2 * numpy.pi / columns, indexing="ij")
    radius = 1 + 0.04 * numpy.sin(5 * up) * numpy.cos(7 * along) + 0.02 * numpy.cos(11 * up + 3 * along)
    rounds = numpy.stack([1.4 * radius * numpy.sin(up) * numpy.cos(along), radius * numpy.sin(up) * numpy.sin(along),
                          0.9 * radius * numpy.cos(up)], axis=-1).reshape(-1, 3)
    points = numpy.concatenate([rounds, [[0, 0, 0.9], [0, 0, -0.9]]]).astype("<f4")
    row, column = numpy.meshgrid(numpy.arange(rows - 1), numpy.arange(columns), indexing="ij")
    a, b = row * columns + column, row * columns + (column + 1) % columns
    first, second = numpy.stack([a, a + columns, b], -1), numpy.stack([b, a + columns, b + columns], -1)
    edge = numpy.arange(columns)
    after = (edge + 1) % columns
    top = numpy.stack([numpy.full(columns, rows * columns), edge, after], -1)
    last = (rows - 1) * columns
    bottom = numpy.stack([numpy.full(columns, rows * columns + 1), last + after, last + edge], -1)
    corners = numpy.concatenate([first.reshape(-1, 3), second.reshape(-1, 3), top, bottom])
    faces = numpy.zeros(len(corners), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, corners
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\n"
            f"property float y\nproperty float z\nelement face {len(faces)}\n"
            "property list uchar int vertex_indices\nend_header\n")
    path.write_bytes(head.encode() + points.tobytes() + faces.tobytes())


def check_large(driver, address, program, folder):
    large = folder / "million.ply"
    write_large(large)
    driver.get(address)
    remesh(driver, large, {"nodes": "1000"}, 1800)
    print("A million vertices: " + at(driver, "stage").text, flush=True)
    compare(program, driver, large, [], folder)


def check_requests(driver, address):
    foreign = [line for entry in driver.get_log("performance")
               for line in [json.loads(entry["message"])["message"]]
               if line["method"] == "Network.requestWillBeSent"
               and not line["params"]["request"]["url"].startswith((address, "data:", "blob:" + address))]
    if foreign:
        sys.exit(f"The page asks others: {foreign[0]['params']['request']['url']}")


def chromium():
    options = webdriver.ChromeOptions()
    # Without a sandbox, which root cannot have; the page is our own. Graphics by software.
    for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle",
                 "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=1366,768"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"performance": "ALL"})
    driver = webdriver.Chrome(options=options)
    driver.set_script_timeout(600)
    return driver


def use(browser, address, program, meshes, folder):
    print(browser, flush=True)
    driver = chromium() if browser == "chromium" else Firefox(1366, 768)
    try:
        if browser == "chromium":
            check_keyboard(driver, address, folder)
            check_cancel(driver, address, meshes, folder)
        check_files(driver, address, program, meshes, folder)
        if browser == "chromium":
            check_large(driver, address, program, folder)
            check_requests(driver, address)
        elif driver.execute_script("return document.createElement('canvas').getContext('webgl2') !== null"):
            check_turning(driver)
        else:
            # Without a screen Firefox has no graphics on many machines.
            if "no WebGL 2" not in at(driver, "error").text:
                sys.exit("The page does not say that there is no picture.")
            print("This Firefox has no WebGL 2, and the page says so.")
    finally:
        driver.quit()


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    program, page, meshes, folder = (pathlib.Path(argument).resolve() for argument in sys.argv[1:5])
    folder.mkdir(parents=True, exist_ok=True)
    size = sum(len(gzip.compress(file.read_bytes(), 9)) for file in page.iterdir() if file.name != "LICENSE")
    print(f"The page, packed as servers send it, with the sample: {size} bytes.")
    if size > LARGEST:
        sys.exit(f"More than {LARGEST} bytes.")
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=str(page)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        for browser in sys.argv[5:] or ("chromium", "firefox"):
            use(browser, f"http://127.0.0.1:{server.server_port}", program, meshes, folder)
    finally:
        server.shutdown()


main()
