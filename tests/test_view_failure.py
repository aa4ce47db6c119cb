"""The page of a failure: what it says, and the hand poses in the picture, coloured by stage."""

from __future__ import annotations

import json
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
    share_of,
    words,
)
from hand_made import pick_and_place, wall, write_cell
from told_reports import HIT, LIMIT, STALLED, failure

from handey.cli import main
from handey.errors import InvalidInput
from handey.reporting.goal_report import GoalReport
from handey.reporting.report_file import read_report_file, write_report
from handey.view import write_page

COLOURS = {
    "unobstructed": "#d98200", "reachable": "#c2417c", "approached": "#7a4fd0",
    "connected": "#2f6fde",
}  # fmt: skip


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("failure")
    cell = write_cell(folder, name="no way", fixtures=wall([0.3, 0.02, 0.2], [0.5, -0.06, 0.1]))
    write_report(folder / "report.json", "no way", failure().as_dict())
    write_page(cell, folder / "report.json", folder / "page.html")
    return folder


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    driver = new_browser(tmp_path_factory.mktemp("profile"))
    yield driver
    driver.quit()


def click(browser, selector, index=0):
    browser.execute_script(
        "document.querySelectorAll(arguments[0])[arguments[1]].click()", selector, index
    )
    time.sleep(0.4)


def why(browser, reason):
    """The button of a reason in the funnel."""
    found = browser.find_elements("css selector", ".reasons .why")
    return next(button for button in found if button.get_attribute("data-text") == reason.text)


def reddish(shown):
    """Share of a picture in which red outweighs: what is marked is seen through."""
    red, green, blue = np.moveaxis(shown.astype(int), 2, 0)
    return float((red - np.maximum(green, blue) > 25).mean())


def test_a_report_is_read_back_as_it_was(made):
    told, wanted = read_report_file(made / "report.json"), failure()
    assert (told.verdict, told.wall_s) == (wanted.verdict, wanted.wall_s)
    assert [goal.as_dict() for goal in told.goals] == [goal.as_dict() for goal in wanted.goals]


def test_every_fault_of_a_report_is_told(tmp_path):
    goals = [{"stages": [{"stage": "flown", "entered": -1}], "tried": [{"X_PH": [[1]]}]}]
    (tmp_path / "r.json").write_text(json.dumps({"handey_report": 1, "goals": goals}))
    with pytest.raises(InvalidInput) as error:
        read_report_file(tmp_path / "r.json")
    assert [fault.place for fault in error.value.faults] == [
        "goals[0].stages[0].stage",
        "goals[0].stages[0].entered",
        "goals[0].tried[0].X_PH",
    ]


def test_a_foreign_report_in_a_plan_does_no_harm(tmp_path):
    cell = write_cell(tmp_path)
    plan = pick_and_place(cell) | {"report": {"goals": [{"stages": "all"}]}}
    write_page(cell, plan, tmp_path / "page.html")
    assert 'class="plain untold"' in (tmp_path / "page.html").read_text()


def test_the_words_need_no_script(made):
    text = (made / "page.html").read_text().split("<script")[0]
    for told in (HIT.text, LIMIT.text, "move wall by 60 mm along +y", "fixtures.wall.pose.xyz"):
        assert told in text
    assert "past bystander &lt;b&gt;" in text
    assert text.index("No plan found") < text.index(HIT.text) < text.index('class="funnel"')
    assert text.index('class="funnel"') < text.index('class="advice"') < text.index("<canvas")


@needs_browser
def test_each_stage_has_its_colour_in_the_picture(browser, made):
    opened(browser, made / "page.html")
    chips = browser.find_elements("css selector", "#stages button")
    assert [chip.text.split() for chip in chips] == [
        ["unobstructed", "3"], ["reachable", "15"], ["approached", "4"], ["connected", "1"],
    ]  # fmt: skip
    for index, (stage, colour) in enumerate(COLOURS.items()):
        for other in range(len(chips)):
            if other != index:
                click(browser, "#stages button", other)
        alone = share_of(picture(browser), colour)
        click(browser, "#stages button", index)
        without = share_of(picture(browser), colour)
        assert alone > without + 2e-4, stage
        for chip in range(len(chips)):
            click(browser, "#stages button", chip)
    assert severe(browser) == []


@needs_browser
def test_a_reason_marks_its_bodies_and_picks_out_its_poses(browser, made):
    opened(browser, made / "page.html")
    # The cause is marked from the beginning.
    names = [e.text for e in browser.find_elements("css selector", "#labels .marked")]
    assert names == ["wall"]
    red = reddish(picture(browser))
    browser.execute_script("arguments[0].click()", why(browser, LIMIT))
    time.sleep(0.5)
    assert browser.find_elements("css selector", "#labels .marked") == []
    assert reddish(picture(browser)) < red - 0.02
    browser.execute_script("document.getElementById('pickedNext').click()")
    assert words(browser, "pickedCount") == "1 of 6"
    assert words(browser, "pickedWhy") == LIMIT.text
    assert severe(browser) == []


@needs_browser
def test_a_click_on_a_hand_pose_shows_why_it_fell_and_the_hand_there(browser, made):
    from selenium.webdriver import ActionChains

    opened(browser, made / "page.html")
    browser.execute_script("arguments[0].click()", why(browser, STALLED))
    time.sleep(0.5)
    shown = picture(browser)
    violet = np.array([0x7A, 0x4F, 0xD0], float)
    pixels = shown.astype(float)
    along = pixels @ violet / (np.linalg.norm(pixels, axis=2) * np.linalg.norm(violet) + 1e-9)
    legend = browser.find_element("id", "filter").rect["y"]  # it has the colour too
    rows, columns = np.nonzero(along[: int(legend) - 2] > 0.998)
    assert len(rows) > 20
    canvas = browser.find_element("id", "view")
    # Selenium counts from the middle of the element.
    across = int(columns[len(columns) // 2]) - shown.shape[1] // 2
    down = int(rows[len(rows) // 2]) - shown.shape[0] // 2
    ActionChains(browser).move_to_element_with_offset(canvas, across, down).click().perform()
    time.sleep(0.5)
    assert words(browser, "pickedStage") == "fell at: approached"
    assert words(browser, "pickedWhy") == STALLED.text
    assert words(browser, "pickedJaws") == "jaws 70.0 mm open, 40.0 mm on the part"
    assert (np.abs(picture(browser).astype(int) - shown).max(axis=2) > 30).mean() > 0.005
    click(browser, "#pickedClose")
    assert not browser.find_element("id", "picked").is_displayed()
    assert severe(browser) == []


@needs_browser
@pytest.mark.parametrize(("width", "height"), [(400, 800), (1280, 800)])
def test_nothing_overlaps(browser, made, width, height):
    screen(browser, width, height)
    try:
        opened(browser, made / "page.html")
        click(browser, "#pickedNext")
        size = browser.execute_script("return [document.documentElement.scrollWidth, innerWidth]")
        assert size[0] <= size[1] == width
        pieces = "#told > *, .goal > *, .stage > *, #tools button, #filter, #picked > *, #stages li"
        assert overlapping(browser, pieces) == []
        assert colours(browser) > 60
        assert severe(browser) == []
    finally:
        no_screen(browser)


def test_a_robot_that_is_not_planned_for_is_shown_with_the_reason(tmp_path):
    cell = write_cell(tmp_path)
    notes = ["No planning for this robot: needs a spherical wrist"]
    write_page(cell, None, tmp_path / "page.html", None, notes)
    text = (tmp_path / "page.html").read_text().split("<script")[0]
    assert f'<p class="warning">{notes[0]}</p>' in text and "<canvas" in text


def test_a_report_of_another_cell_is_told_of(made, tmp_path):
    write_page(write_cell(tmp_path, name="other"), made / "report.json", tmp_path / "page.html")
    assert "This report is of the cell no way." in (tmp_path / "page.html").read_text()
    assert "This report is of the cell" not in (made / "page.html").read_text()


def test_the_goal_that_failed_comes_first(tmp_path):
    cell = write_cell(tmp_path)
    report = failure()
    report.goals.insert(0, GoalReport(0, "bystander somewhere", "planned", grasp="faces 0/1"))
    report.goals[1].goal = 1
    write_page(cell, None, tmp_path / "page.html", report)
    text = (tmp_path / "page.html").read_text()
    assert text.index("Goal 1: place block") < text.index("Goal 0: bystander")


@pytest.mark.parametrize("fail", [True, False])
def test_the_command_shows_what_it_planned(tmp_path, capsys, fail):
    far = [{"place": "block", "at": {"xyz": [2.5, 0.0, 0.025]}}]
    wide = {"far": {"box": [1.0, 1.0, 0.05], "pose": {"xyz": [2.5, 0, -0.025]}}}
    cell = write_cell(tmp_path, **({"task": far, "fixtures": wide} if fail else {}))
    page = tmp_path / "page.html"
    assert main(["view", str(cell), "-o", str(page)]) == 0
    text = page.read_text()
    assert ('class="failed told"' in text) == fail
    assert ("No plan" in text) == fail and len(text) < 1_000_000
