"""The page plays a plan in a real browser: headless Chromium, opened from a file, no network."""

from __future__ import annotations

import json
import re
import time

import numpy as np
import pytest
from browsing import (
    colours,
    needs_browser,
    new_browser,
    no_screen,
    opened,
    overlapping,
    picture,
    screen,
    severe,
    words,
)
from hand_made import ROOT, pick_and_place, write_cell

from handey.errors import InvalidInput
from handey.view import write_page


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("view")
    cell = write_cell(folder, name="a <b> & cell")
    plan = pick_and_place(cell)
    write_page(cell, plan, folder / "page.html")
    return folder, plan


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    driver = new_browser(tmp_path_factory.mktemp("profile"))
    yield driver
    driver.quit()


def seek(browser, t):
    browser.execute_script(
        "const r = document.getElementById('scrub'); r.value = arguments[0];"
        "r.dispatchEvent(new Event('input'));", t,
    )  # fmt: skip
    time.sleep(0.6)


def test_the_page_needs_nothing_else(made):
    text = (made[0] / "page.html").read_text()
    assert not re.search(r"https?://(?!www\.w3\.org)", text)
    assert not re.search(r"<(script|link|img|iframe)[^>]*\b(src|href)\s*=\s*[\"'](?!data:)", text)
    assert "{{" not in text
    assert "a &lt;b&gt; &amp; cell" in text and "<b> &" not in text.split("<script")[0]
    assert len(text) < 200_000


def test_the_page_tells_plans_that_it_cannot_read(made, tmp_path):
    with pytest.raises(InvalidInput, match="steps"):
        write_page(made[0] / "cell.yaml", {**made[1], "steps": None}, tmp_path / "page.html")
    assert list(tmp_path.iterdir()) == []


@needs_browser
def test_the_page_shows_the_cell_and_moves_with_the_time_line(browser, made):
    opened(browser, made[0] / "page.html")
    start = picture(browser)
    assert colours(browser) > 60
    assert browser.title.startswith("a <b> & cell")
    assert words(browser, "action") == "transit"
    names = [
        e.get_property("textContent") for e in browser.find_elements("css selector", "#steps div")
    ]
    assert names == [step["action"] for step in made[1]["steps"]]
    seen = []
    for step in made[1]["steps"]:
        seek(browser, (step["time"][0] + step["time"][-1]) / 2)
        assert words(browser, "action") == step["action"]
        held = step["part"]
        assert (held is None) or held in words(browser, "what")
        seen.append(picture(browser))
    moved = np.abs(seen[4].astype(int) - start).max(axis=2) > 40
    assert 0.01 < moved.mean() < 0.9
    assert (np.abs(seen[2].astype(int) - seen[4]).max(axis=2) > 40).mean() > 0.002
    assert severe(browser) == []


@needs_browser
def test_the_page_shows_joint_values_and_plays(browser, made):
    opened(browser, made[0] / "page.html")
    step = made[1]["steps"][2]
    seek(browser, step["time"][-1])
    rows = browser.find_elements("css selector", "#joints tr")
    values = [row.find_elements("css selector", "td")[0].text for row in rows]
    angles = np.degrees(step["positions"][-1])
    assert [float(v.rstrip("\u00b0")) for v in values[:6]] == pytest.approx(angles, abs=0.06)
    assert values[6] == "40.0 mm"
    seek(browser, 0)
    browser.find_element("id", "play").click()
    time.sleep(1.0)
    browser.find_element("id", "play").click()
    now = float(words(browser, "clock").split("/")[0])
    assert 0.05 < now < 3.0
    browser.execute_script("dispatchEvent(new KeyboardEvent('keydown', {key: 'End'}))")
    time.sleep(0.5)
    end, total = (float(x.split()[0]) for x in words(browser, "clock").split("/"))
    assert end == total == pytest.approx(made[1]["steps"][-1]["time"][-1], abs=0.01)
    assert severe(browser) == []


@needs_browser
@pytest.mark.parametrize(("width", "height"), [(400, 800), (1280, 800)])
def test_nothing_overlaps_on_a_phone_or_a_screen(browser, made, width, height):
    screen(browser, width, height)
    try:
        opened(browser, made[0] / "page.html")
        size = browser.execute_script("return [document.documentElement.scrollWidth, innerWidth]")
        assert size[0] <= size[1] == width
        assert overlapping(browser, "#head, #tools button, #joints, #bar, #controls > *") == []
        assert colours(browser) > 60
        assert severe(browser) == []
    finally:
        no_screen(browser)


@needs_browser
@pytest.mark.parametrize("name", ["demo", "landscape"])
def test_the_page_shows_a_cell_without_a_plan(browser, tmp_path, name):
    write_page(ROOT / "models" / "cells" / f"{name}.yaml", None, tmp_path / "page.html")
    opened(browser, tmp_path / "page.html")
    assert words(browser, "action") == "no plan"
    assert not browser.find_element("id", "bar").is_displayed()
    assert colours(browser) > 60
    assert severe(browser) == []


def test_the_scene_is_plain_json(made):
    text = (made[0] / "page.html").read_text()
    scene = json.loads(re.search(r'id="scene">(.*?)</script>', text, re.S).group(1))
    assert scene["name"] == "a <b> & cell"
    assert [part["name"] for part in scene["parts"]] == ["block", "bystander"]
