"""A real browser without a window, spoken to in the Chrome DevTools Protocol over two pipes: no package, no port."""

from __future__ import annotations

import importlib.util
import json
import os
import shutil
import subprocess
import tempfile
import time
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
QUIET = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage",
)  # fmt: skip
PATIENCE = 60.0
OVERFLOWS = """
[...document.querySelectorAll('main *, header *, nav *')].filter(e => {
  const box = e.getBoundingClientRect();
  if (!box.width || e.closest('svg') && e.tagName !== 'svg') return false;
  for (let p = e.parentElement; p; p = p.parentElement) {
    if (getComputedStyle(p).overflowX !== 'visible') return false;  // scrolls on its own
    const own = p.getBoundingClientRect();
    if (p.tagName === 'BODY') return box.right > document.documentElement.clientWidth + 1;
    if (own.width && (box.right > own.right + 1 || box.left < own.left - 1)
        && !e.closest('.skip') && getComputedStyle(e).display !== 'inline') return true;
  }
  return false;
}).map(e => e.outerHTML.slice(0, 200))
"""
"""Elements wider than what holds them, unless that scrolls."""
DEAD = (
    "[...document.querySelectorAll('a[href^=\"#\"]')].map(a => a.getAttribute('href').slice(1))"
    ".filter(name => !document.getElementById(name))"
)
"""Links within the page that lead nowhere."""
WIDE = "document.documentElement.scrollWidth"
WIDTHS = 390, 768, 1280
"""A phone, a tablet, a desktop [px]."""


def installed() -> str | None:
    """The browser's command, if there is one."""
    return next((path for name in NAMES if (path := shutil.which(name))), None)


class RequestError(AssertionError):
    """The browser has no answer to a request: a script's page is just being left, for instance."""


class Browser:
    """One page in a browser with a profile of its own; collects what the page complains of."""

    def __init__(self) -> None:
        self.complaints: list[str] = []
        self._number = 0
        self._buffer = b""

    def __enter__(self) -> Browser:
        command = installed()
        assert command is not None
        self._profile = tempfile.TemporaryDirectory(prefix="browser-", ignore_cleanup_errors=True)
        to_browser, self._out = os.pipe()
        self._in, from_browser = os.pipe()
        # The browser reads from descriptor 3 and writes to 4.
        run = f'exec "$0" "$@" 3<&{to_browser} 4>&{from_browser}'
        arguments = (*QUIET, "--remote-debugging-pipe", f"--user-data-dir={self._profile.name}", "about:blank")
        self._process = subprocess.Popen(
            ["bash", "-c", run, command, *arguments],
            pass_fds=(to_browser, from_browser),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(to_browser)
        os.close(from_browser)
        os.set_blocking(self._in, False)
        (page,) = [t for t in self.ask("Target.getTargets")["targetInfos"] if t["type"] == "page"]
        attached = self.ask("Target.attachToTarget", targetId=page["targetId"], flatten=True)
        self._session = attached["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.ask(f"{domain}.enable")
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, where: TracebackType | None) -> None:
        os.close(self._out)
        os.close(self._in)
        self._process.terminate()
        self._process.wait(10)
        self._profile.cleanup()

    def open(self, page: Path | str, scripts: bool = True, width: int = 1280) -> None:
        """Load a file from disk, or a page by its address, and wait until it is there."""
        address = page if isinstance(page, str) else page.as_uri()
        self._own = address.partition("#")[0] if isinstance(page, str) else "file:"
        self.ask("Emulation.setScriptExecutionDisabled", value=not scripts)
        self.resize(width)
        self._loaded = False
        self.ask("Page.navigate", url=address)
        until = time.monotonic() + PATIENCE
        while not self._loaded:
            assert time.monotonic() < until, "the page is not there in time"
            self._hear()

    def resize(self, width: int) -> None:
        """Give the window another width [px]."""
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)

    def value(self, script: str) -> Any:
        """What an expression is worth in the page."""
        found = self.ask("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in found, found["exceptionDetails"]
        return found["result"].get("value")

    def soon(self, script: str) -> Any:
        """What an expression is worth once it is worth something; asked again while one page leads to another."""
        until = time.monotonic() + PATIENCE
        while time.monotonic() < until:
            with suppress(RequestError):
                if found := self.value(script):
                    return found
            time.sleep(0.05)
        raise AssertionError(f"never: {script}")

    def middle(self, script: str) -> tuple[float, float]:
        """Where what the expression finds is, once it is in view and stands still: results that arrive above move it,
        and what is scrolled is hit only from the next frame on."""
        x, y = self.value(
            f"(async () => {{ const found = () => {script}, frame = () => new Promise(requestAnimationFrame);"
            " const at = () => { const r = found().getBoundingClientRect();"
            " return [r.x + r.width / 2, r.y + r.height / 2]; };"
            " let before, now = [NaN, NaN];"
            " for (let k = 0, same = 0; k < 120 && same < 3; k++) {"
            "  found().scrollIntoView({block: 'center'}); await frame(); [before, now] = [now, at()];"
            "  same = now.join() === before.join() ? same + 1 : 0; }"
            " return now; })()"
        )
        return x, y

    def click(self, script: str) -> None:
        """A real click of the mouse in the middle of what the expression finds; again where it moved meanwhile, so
        that something else was hit."""
        heard = (
            "window.wasHit = false;"
            f" addEventListener('click', e => {{ window.wasHit ||= {script}?.contains(e.target); }},"
            " {once: true, capture: true})"
        )
        for _ in range(5):
            self.value(heard)
            x, y = self.middle(script)
            for kind in ("mousePressed", "mouseReleased"):
                self.ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
            if self.value("window.wasHit ?? true"):  # another page has been opened by it
                return

    def type(self, text: str) -> None:
        """Keys into what has the focus."""
        self.ask("Input.insertText", text=text)

    def ask(self, method: str, **parameters: Any) -> Any:
        """One request, and its answer."""
        self._number += 1
        request: dict[str, Any] = {"id": self._number, "method": method, "params": parameters}
        if hasattr(self, "_session"):
            request["sessionId"] = self._session
        os.write(self._out, json.dumps(request).encode() + b"\0")
        until = time.monotonic() + PATIENCE
        while time.monotonic() < until:
            answer = self._hear()
            if answer is not None and answer.get("id") == self._number:
                if "error" in answer:
                    raise RequestError(method, answer["error"])
                return answer["result"]
        raise AssertionError(f"no answer to {method}")

    def _hear(self) -> dict[str, Any] | None:
        """The next thing the browser says; None if it says nothing for a moment."""
        if b"\0" not in self._buffer:
            try:
                self._buffer += os.read(self._in, 1 << 20)
            except BlockingIOError:
                time.sleep(0.01)
                return None
            if b"\0" not in self._buffer:
                return None
        line, _, self._buffer = self._buffer.partition(b"\0")
        said: dict[str, Any] = json.loads(line)
        method, told = said.get("method", ""), said.get("params", {})
        if method == "Page.loadEventFired":
            self._loaded = True
        elif method == "Runtime.exceptionThrown":
            self.complaints.append(told["exceptionDetails"]["text"])
        elif method == "Runtime.consoleAPICalled" and told["type"] in ("error", "warning", "assert"):
            self.complaints.append(str(told["args"]))
        elif method == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
            self.complaints.append(told["entry"]["text"])
        elif method == "Network.requestWillBeSent" and not told["request"]["url"].startswith(
            (self._own, "data:", "blob:")
        ):
            self.complaints.append(f"asks the network for {told['request']['url']}")
        return said


def barriers(browser: Browser) -> list[str]:
    """What bars people from the page that is open, by all rules of axe-core."""
    package = importlib.util.find_spec("axe_core_python")
    assert package is not None and package.submodule_search_locations, "axe-core-python, of the extra dev, is missing"
    browser.value((Path(package.submodule_search_locations[0]) / "axe.min.js").read_text(encoding="utf-8") + "; true")
    found: list[str] = browser.value(
        "axe.run().then(r => r.violations.flatMap(v => v.nodes.slice(0, 3).map(n => `${v.impact} ${v.id}: ${n.html}`)))"
    )
    return found


def layout_faults(browser: Browser, page: Path) -> list[str]:
    """What is wrong with a page at the three widths: wider than its window or than what holds it, links that lead
    nowhere, complaints of the browser."""
    faults = []
    browser.open(page)
    for width in WIDTHS:
        browser.resize(width)
        if browser.value(WIDE) > width:
            faults.append(f"{width} px: the page is wider than its window")
        faults += [f"{width} px: {each}" for each in browser.value(OVERFLOWS)]
    return faults + [f"#{name} leads nowhere" for name in browser.value(DEAD)] + browser.complaints
