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

from handey.cell_file import load_cell
from handey.check import CheckReport, check
from handey.check.cell_reader import read_cell
from handey.check.plan_data import load_json, read_plan
from handey.errors import InvalidInput
from handey.view import write_page
from handey.view.clearance import clearance_along
from handey.view.grasp_plane import HandPose, plane_picture


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


@pytest.fixture(scope="module")
def demo(tmp_path_factory):
    """The demonstration, planned."""
    from handey.cli import main

    folder, cell = tmp_path_factory.mktemp("demo"), ROOT / "models" / "cells" / "demo.yaml"
    assert main(["plan", str(cell), "-o", str(folder / "plan.json"), "--quiet"]) == 0
    output = ["-o", str(folder / "page.html"), "--quiet"]
    assert main(["view", str(cell), str(folder / "plan.json"), *output]) == 0
    return folder


def curve_of(cell_file, plan_file):
    cell = read_cell(cell_file)
    plan = read_plan(load_json(plan_file)[0], cell, CheckReport())
    return clearance_along(cell, plan)


def test_the_least_of_the_curve_is_that_of_the_check(demo):
    cell = ROOT / "models" / "cells" / "demo.yaml"
    curve, checked = curve_of(cell, demo / "plan.json"), check(cell, demo / "plan.json")
    k = int(np.argmin(curve.distance))
    # The check proves a bound of 0.9 of what there is; the curve is sampled.
    assert checked.least_clearance <= curve.distance[k] + 1e-5
    assert curve.distance[k] <= checked.least_clearance / 0.9 + 2e-4
    assert curve.pairs[curve.between[k]] == checked.least_clearance_between
    assert curve.time[k] == pytest.approx(checked.least_clearance_time, abs=0.05)


def test_contacts_of_the_work_do_not_count(made):
    curve = curve_of(made[0] / "cell.yaml", made[1])
    assert curve.distance.min() > 1e-3  # though fingers close, and the block leaves the table
    pairs = {frozenset(pair) for pair in curve.pairs}
    assert frozenset(("block", "left_finger")) in pairs  # as the hand comes it counts
    assert frozenset(("block", "table")) not in pairs  # from which it is lifted at once
    assert np.all(np.diff(curve.time) >= 0) and curve.distance.max() <= 0.1


def test_a_page_is_small_enough_to_be_sent(demo):
    assert (demo / "page.html").stat().st_size < 2_000_000


@needs_browser
def test_the_curve_leads_to_the_least_clearance(browser, demo):
    screen(browser, 1280, 800)
    try:
        opened(browser, demo / "page.html")
        least = words(browser, "least")
        assert re.fullmatch(r"Least \d+\.\d\d? mm: \S+, \S+", least)
        browser.find_element("id", "least").click()
        time.sleep(0.5)
        assert words(browser, "near") == least.replace("Least", "Clearance")
        marked = [e.text for e in browser.find_elements("css selector", "#labels .marked")]
        assert 0 < len(marked) <= 2 and all(name in least for name in marked)
        pieces = "#told, #head > *, #tools button, #joints, #bar, #clearance, #line, #controls > *"
        assert overlapping(browser, pieces) == []
        assert severe(browser) == []
    finally:
        no_screen(browser)


@needs_browser
@pytest.mark.parametrize(("width", "height"), [(400, 800), (1000, 700), (1280, 800)])
def test_nothing_overlaps_with_all_that_can_be_shown(browser, demo, width, height):
    screen(browser, width, height)
    try:
        opened(browser, demo / "page.html")
        for key in ("y", "n"):
            browser.execute_script(
                "dispatchEvent(new KeyboardEvent('keydown', {key: arguments[0]}))", key
            )
            time.sleep(0.3)
        assert browser.find_element("id", "picked").is_displayed()
        assert words(browser, "pickedStage") == "the grasp of the plan"
        pieces = "#head > *, #tools button, #joints, #tried > *, #bar, #clearance > *, #line"
        assert overlapping(browser, pieces) == []
        assert severe(browser) == []
    finally:
        no_screen(browser)


@needs_browser
def test_the_hand_follows_the_time_line_in_the_grasp_plane(browser, demo):
    screen(browser, 1280, 800)
    try:
        opened(browser, demo / "page.html")
        plan = json.loads((demo / "plan.json").read_text())
        step = next(step for step in plan["steps"] if step["action"] == "approach")
        hand = browser.find_element("css selector", ".plane .hand")
        places = []
        for t in np.linspace(step["time"][0], step["time"][-1], 4):
            seek(browser, float(t))
            places.append(hand.get_attribute("transform"))
        assert len(set(places)) == 4
        # At the grasp the finger grasp point is on the target, in the middle of the picture.
        assert places[-1].rstrip(")").split(",")[-2:] == ["180", "180"]
        kinds = [e.get_attribute("class") for e in hand.find_elements("css selector", "path")]
        assert kinds.count("piece") >= 2 and sum(kind.startswith("bump") for kind in kinds) >= 8
        assert severe(browser) == []
    finally:
        no_screen(browser)


def test_bump_lines_touch_where_the_hand_is_near():
    cell = load_cell(ROOT / "models" / "cells" / "demo.yaml").cell
    part = cell.part_index("bracket")
    above = np.diag([1.0, -1.0, -1.0, 1.0])
    above[:3, 3] = cell.parts[part].X_WB[:3, 3] + [0, 0, 0.30]
    low = above.copy()
    low[2, 3] = 0.005
    touching = {
        name: plane_picture(cell, part, 0.03, [HandPose(0.0, X)]).touching
        for name, X in (("above", above), ("low", low))
    }
    assert touching["above"] == 0 < touching["low"]


def test_the_scene_is_plain_json(made):
    text = (made[0] / "page.html").read_text()
    scene = json.loads(re.search(r'id="scene">(.*?)</script>', text, re.S).group(1))
    assert scene["name"] == "a <b> & cell"
    assert [part["name"] for part in scene["parts"]] == ["block", "bystander"]
