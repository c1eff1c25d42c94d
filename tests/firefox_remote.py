# SPDX-License-Identifier: GPL-3.0-or-later
"""Firefox without a window, by its own protocol (Marionette): Debian 12 has no geckodriver for Selenium.

Firefox has the methods of Selenium's drivers that web_in_browser.py uses.
"""
import base64
import json
import pathlib
import shutil
import socket
import subprocess
import tempfile
import time

REFERENCE = "element-6066-11e4-a52e-4f735466cecf"


class Element:
    def __init__(self, driver, reference):
        self.driver = driver
        self.reference = reference

    def send_keys(self, text):
        self.driver.ask("WebDriver:ElementSendKeys", id=self.reference, text=text)

    def click(self):
        self.driver.ask("WebDriver:ElementClick", id=self.reference)

    def clear(self):
        self.driver.ask("WebDriver:ElementClear", id=self.reference)

    @property
    def text(self):
        return self.driver.ask("WebDriver:GetElementText", id=self.reference)["value"]

    @property
    def screenshot_as_png(self):
        return base64.b64decode(self.driver.ask("WebDriver:TakeScreenshot", id=self.reference)["value"])


class Firefox:
    def __init__(self, width, height):
        self.home = pathlib.Path(tempfile.mkdtemp(prefix="wscvt_firefox_"))
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        # No questions, no updates, no reports; drawn by the processor, which this machine always has.
        preferences = {"marionette.port": port, "webgl.force-enabled": True, "app.update.enabled": False,
                       "browser.shell.checkDefaultBrowser": False, "datareporting.policy.dataSubmissionEnabled": False,
                       "toolkit.telemetry.enabled": False, "app.normandy.enabled": False}
        (self.home / "user.js").write_text("".join(f"user_pref({json.dumps(name)}, {json.dumps(value)});\n"
                                                   for name, value in preferences.items()))
        self.process = subprocess.Popen(
            ["firefox-esr", "--headless", "--marionette", "--no-remote", "--profile", self.home,
             f"--width={width}", f"--height={height}", "about:blank"],
            env={"HOME": str(self.home), "PATH": "/usr/bin:/bin", "MOZ_HEADLESS": "1"},
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.number = 0
        try:
            self.connection = self.connect(port)
            self.receive()
            self.ask("WebDriver:NewSession", capabilities={"alwaysMatch": {"timeouts": {"script": 600000}}})
        except BaseException:
            self.quit()
            raise

    def connect(self, port):
        end = time.time() + 120
        while True:
            try:
                return socket.create_connection(("127.0.0.1", port), timeout=600)
            except OSError:
                if time.time() > end or self.process.poll() is not None:
                    raise
                time.sleep(0.5)

    def receive(self):
        """A message: its length in digits, a colon, JSON."""
        size = b""
        while (byte := self.connection.recv(1)) != b":":
            if not byte:
                raise ConnectionError("Firefox has ended.")
            size += byte
        text = b""
        while len(text) < int(size):
            text += self.connection.recv(int(size) - len(text))
        return json.loads(text)

    def ask(self, command, **parameters):
        self.number += 1
        message = json.dumps([0, self.number, command, parameters]).encode()
        self.connection.sendall(str(len(message)).encode() + b":" + message)
        _, _, error, result = self.receive()
        if error:
            raise RuntimeError(f"{command}: {error['error']}: {error['message']}")
        return result

    def get(self, address):
        self.ask("WebDriver:Navigate", url=address)

    def execute_script(self, script):
        return self.ask("WebDriver:ExecuteScript", script=script, args=[])["value"]

    def execute_async_script(self, script):
        return self.ask("WebDriver:ExecuteAsyncScript", script=script, args=[])["value"]

    def find_element(self, kind, text):
        using, text = ("css selector", "#" + text) if kind == "id" else (kind, text)
        return Element(self, self.ask("WebDriver:FindElement", using=using, value=text)["value"][REFERENCE])

    def quit(self):
        self.process.terminate()
        self.process.wait()
        shutil.rmtree(self.home, ignore_errors=True)
