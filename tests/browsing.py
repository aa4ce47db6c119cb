"""Pages in headless Chromium, as a user sees them: opened, clicked, looked at."""

from __future__ import annotations

import base64
import shutil
import time
from pathlib import Path

import numpy as np
import pytest

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
DRIVER = shutil.which("chromedriver")
needs_browser = pytest.mark.skipif(not (CHROMIUM and DRIVER), reason="no chromium, chromedriver")


def new_browser(profile: Path):
    """A browser that draws without a graphics card; to be quit."""
    webdriver = pytest.importorskip("selenium.webdriver")
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for flag in (
        "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader", "--disable-gpu-sandbox", "--disable-background-networking",
        "--no-first-run", "--window-size=1100,760", f"--user-data-dir={profile}",
    ):  # fmt: skip
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options, service=Service(DRIVER))


def opened(browser, page: Path | str):
    """The page of a file or an address, drawn."""
    browser.get(page.as_uri() if isinstance(page, Path) else page)
    time.sleep(1.0)
    return browser


def screen(browser, width: int, height: int):
    """A screen of this size; undone by `no_screen`."""
    metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)


def no_screen(browser):
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def picture(browser, name: str = "view") -> np.ndarray:
    """What the browser shows of an element, (rows, columns, 3): its PNG, decoded by itself."""
    png = browser.find_element("id", name).screenshot_as_base64
    width, height, data = browser.execute_async_script(
        """const done = arguments[1], image = new Image();
        image.onload = () => {
          const c = document.createElement("canvas");
          [c.width, c.height] = [image.width, image.height];
          const context = c.getContext("2d");
          context.drawImage(image, 0, 0);
          const bytes = context.getImageData(0, 0, c.width, c.height).data;
          let text = "";
          for (let i = 0; i < bytes.length; i += 8192) {
            text += String.fromCharCode(...bytes.subarray(i, i + 8192));
          }
          done([c.width, c.height, btoa(text)]);
        };
        image.src = "data:image/png;base64," + arguments[0];""",
        png,
    )
    return np.frombuffer(base64.b64decode(data), np.uint8).reshape(height, width, 4)[:, :, :3]


def colours(browser, name: str = "view") -> int:
    """How many colours an element shows."""
    return len(np.unique(picture(browser, name).reshape(-1, 3), axis=0))


def share_of(shown: np.ndarray, colour: str) -> float:
    """Share of a picture that has the hue of a colour, lit or in shadow."""
    wanted = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)], float)
    pixels = shown.reshape(-1, 3).astype(float)
    along = pixels @ wanted / (np.linalg.norm(pixels, axis=1) * np.linalg.norm(wanted) + 1e-9)
    return float((along > 0.997).mean())


def words(browser, name: str) -> str:
    """The visible text of an element."""
    return browser.find_element("id", name).text


def severe(browser) -> list:
    """What the browser complained about since it was last asked."""
    return [
        entry for entry in browser.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")
    ]


def overlapping(browser, selector: str) -> list[tuple[str, str]]:
    """Visible elements that lie on each other, neither within the other."""
    return browser.execute_script(
        """const all = [...document.querySelectorAll(arguments[0])];
        const seen = all.filter((e) => e.checkVisibility());
        const found = [];
        for (const a of seen) for (const b of seen) {
          if (a === b || a.contains(b) || b.contains(a)) continue;
          const p = a.getBoundingClientRect(), q = b.getBoundingClientRect();
          const name = (e) => e.id || e.textContent.slice(0, 20);
          if (p.left < q.right - 1 && q.left < p.right - 1 && p.top < q.bottom - 1
            && q.top < p.bottom - 1) found.push([name(a), name(b)]);
        }
        return found;""",
        selector,
    )
