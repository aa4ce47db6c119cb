"""The pages of `handey inspect`, in text and in a browser."""

from __future__ import annotations

import base64
import re
import shutil
import time

import numpy as np
import pytest
from inspected import BOX, box_corners, scene_of, triangles, write_obj

from handey import _core
from handey.errors import InvalidInput
from handey.inspection import inspect_body, inspect_mesh, inspect_robot
from handey.inspection.page import write_page

needs_browser = pytest.mark.skipif(
    not (shutil.which("chromedriver") and (shutil.which("chromium") or shutil.which("chrome"))),
    reason="no chromium, chromedriver",
)


def written(report, folder):
    path = folder / "page.html"
    write_page(report, path)
    return path


def test_the_pages_need_nothing_else(bracket, demo, robot, tmp_path):
    for report in (bracket, demo, inspect_robot(robot, picture=True)):
        text = written(report, tmp_path).read_text()
        assert not re.search(r"https?://(?!www\.w3\.org)", text)
        assert not re.search(
            r"<(script|link|img|iframe)[^>]*\b(src|href)\s*=\s*[\"'](?!data:)", text
        )
        assert "{{" not in text and len(text) < 200_000


def test_names_cannot_become_markup(tmp_path, robot):
    body = _core.Body(name="a</script><b>{{scene}}", shapes=[_core.Shape(_core.Box([0.05] * 3))])
    text = written(inspect_body(body, robot), tmp_path).read_text()
    assert "</script><b>" not in text
    assert "a&lt;/script&gt;&lt;b&gt;{{scene}}" in text


def test_every_face_of_a_part_owns_its_triangles(bracket, tmp_path):
    scene = scene_of(written(bracket, tmp_path))
    owner = np.frombuffer(base64.b64decode(scene["owner"]), "<i4")
    a, b, c = (bracket.vertices[bracket.triangles[:, i]] for i in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    for index, face in enumerate(bracket.faces):
        assert areas[owner == index].sum() == pytest.approx(face.area, rel=1e-6)


def test_arrows_of_a_pair_end_on_its_features(bracket, tmp_path):
    scene = scene_of(written(bracket, tmp_path))
    for pair, drawn in zip(bracket.pairs, scene["pairs"], strict=True):
        (_, on_a), (_, on_b) = np.array(drawn["arrows"])
        along = np.asarray(pair.X_PG)[:3, 2]
        assert (on_a - on_b) @ along == pytest.approx(pair.width, abs=2e-3)


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    webdriver = pytest.importorskip("selenium.webdriver")
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium") or shutil.which("chrome")
    for flag in (
        "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader", "--disable-gpu-sandbox", "--disable-background-networking",
        "--no-first-run", "--window-size=1200,800",
        f"--user-data-dir={tmp_path_factory.mktemp('profile')}",
    ):  # fmt: skip
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
    yield driver
    driver.quit()


def opened(browser, path):
    browser.get(path.as_uri())
    for _ in range(50):
        time.sleep(0.1)
        if browser.execute_script("return document.body.dataset.drawn"):
            break
    time.sleep(0.2)


def pixels(browser, selector="#view"):
    """What a canvas holds, every few pixels, (n, 4)."""
    data = browser.execute_script(
        """const from = document.querySelector(arguments[0]), to = document.createElement("canvas");
        to.width = Math.min(from.width, 320);
        to.height = Math.round(to.width * from.height / from.width);
        const context = to.getContext("2d");
        context.imageSmoothingEnabled = false;
        context.drawImage(from, 0, 0, to.width, to.height);
        const bytes = context.getImageData(0, 0, to.width, to.height).data;
        return btoa(Array.from(bytes, (x) => String.fromCharCode(x)).join(""));""",
        selector,
    )
    return np.frombuffer(base64.b64decode(data), np.uint8).reshape(-1, 4)


def colours(picture):
    return len(np.unique(picture, axis=0))


def severe(browser):
    return [e for e in browser.get_log("browser") if e["level"] in ("SEVERE", "WARNING")]


def choose(browser, selector):
    browser.execute_script("document.querySelector(arguments[0]).click()", selector)
    time.sleep(0.4)


@needs_browser
def test_the_page_of_a_part_shows_what_is_chosen(browser, bracket, tmp_path):
    opened(browser, written(bracket, tmp_path))
    assert browser.find_element("id", "shown").text == "faces 0/1: 10.0 mm wide"
    first = pixels(browser)
    assert colours(first) > 40
    choose(browser, "[data-show='pair:2']")
    assert browser.find_element("id", "shown").text == "faces 4/5: 60.0 mm wide"
    second = pixels(browser)
    assert (first != second).any(axis=1).mean() > 0.01
    choose(browser, "[data-show='face:0']")
    assert (pixels(browser) != second).any(axis=1).mean() > 0.01
    choose(browser, "[data-show='rest:0']")
    assert browser.find_element("id", "shown").text.startswith("stands so 25.4 times of 100")
    assert (pixels(browser) != first).any(axis=1).mean() > 0.05
    rests = browser.find_elements("css selector", "#rests canvas")
    assert len(rests) == len(bracket.rests)
    small = [pixels(browser, f"#rests button:nth-child({i + 1}) canvas") for i in range(len(rests))]
    assert all(colours(picture) > 20 for picture in small)
    assert all((small[0] != picture).any() for picture in small[1:])
    choose(browser, "[data-show='rest:0']")  # once more: nothing is chosen
    assert browser.find_element("id", "shown").text == ""
    assert severe(browser) == []


@needs_browser
def test_the_page_of_an_open_part_shows_its_holes(browser, tmp_path):
    corners = box_corners(0.04, 0.06, 0.05)
    path = write_obj(tmp_path / "open.obj", corners, triangles([*BOX[:1], *BOX[2:]]))
    opened(browser, written(inspect_mesh(path), tmp_path))
    picture = pixels(browser).astype(int)
    red = (picture[:, 0] > 180) & (picture[:, 1] < 60) & (picture[:, 2] < 90)
    assert red.sum() > 20
    assert severe(browser) == []


@needs_browser
def test_the_pages_of_robot_and_cell_are_drawn(browser, robot, demo, tmp_path):
    opened(browser, written(inspect_robot(robot, picture=True), tmp_path))
    assert colours(pixels(browser)) > 40
    assert browser.find_element("css selector", "figure svg").size["width"] > 200
    opened(browser, written(demo, tmp_path))
    before = pixels(browser)
    assert colours(before) > 40
    choose(browser, "[data-show='body:hex_peg']")
    assert browser.find_element("id", "shown").text == "hex_peg"
    after = pixels(browser)
    assert (after != before).any(axis=1).mean() > 0.01
    choose(browser, "[data-show='goal:0']")
    assert browser.find_element("id", "shown").text == f"goal 0: {demo.goals[0].goal}"
    assert (pixels(browser) != after).any(axis=1).mean() > 0.0005
    assert severe(browser) == []


@needs_browser
def test_the_pages_fit_a_phone(browser, bracket, demo, robot, tmp_path):
    metrics = {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    try:
        for report in (bracket, demo, inspect_robot(robot, picture=True)):
            opened(browser, written(report, tmp_path))
            size = browser.execute_script("return [document.body.scrollWidth, innerWidth]")
            assert size[0] <= size[1] == 390
            assert colours(pixels(browser)) > 40
        assert severe(browser) == []
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_a_page_that_cannot_be_written_is_told(bracket, tmp_path):
    with pytest.raises(InvalidInput, match="cannot be written"):
        write_page(bracket, tmp_path / "none" / "page.html")
