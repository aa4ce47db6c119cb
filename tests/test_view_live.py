"""The live page: on the loopback address alone, anew when a file is saved, ended by Ctrl-C."""

from __future__ import annotations

import http.client
import os
import shutil
import signal
import socket
import subprocess
import sys
import time

import pytest
from browsing import needs_browser, new_browser, opened, severe
from hand_made import ROBOT, write_cell

from handey.cli import main
from handey.commands.ending import interrupts
from handey.view.watch import Watch, files_of

PATIENCE = 30.0  # s; for a machine that does other things too


@pytest.fixture
def served(tmp_path):
    """A cell that is served: its file, the port, the process."""
    cell = write_cell(tmp_path, name="served")
    process = subprocess.Popen(
        [sys.executable, "-m", "handey", "view", str(cell), "--serve", "--no-advice"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=tmp_path,
    )  # fmt: skip
    line = process.stdout.readline()
    assert line.startswith("page: http://127.0.0.1:")
    yield cell, int(line.split(":")[3].split("/")[0]), process
    process.kill()
    process.wait()


def get(port, path="/", host=None, method="GET"):
    """Status and text."""
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
    connection.putrequest(method, path, skip_host=True)
    connection.putheader("Host", f"127.0.0.1:{port}" if host is None else host)
    connection.endheaders()
    answer = connection.getresponse()
    text = answer.read().decode()
    connection.close()
    return answer.status, text


def wait_for(there):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if found := there():
            return found
        time.sleep(0.1)
    raise AssertionError("waited in vain")


def has(port, text):
    return lambda: text in get(port)[1]


def test_only_the_page_is_served_and_only_to_who_means_this_host(served):
    cell, port, _ = served
    assert get(port, host=f"localhost:{port}")[0] == 200
    for host in ("evil.example", f"evil.example:{port}", "127.0.0.1", "", f"127.0.0.1:{port + 1}"):
        status, text = get(port, host=host)
        assert status == 421 and "<html" not in text
    for path in ("/cell.yaml", "/../cell.yaml", f"/{cell}", "/?a", "/changes/", "/%2e%2e/"):
        assert get(port, path)[0] == 404
    assert get(port, method="POST")[0] == 501
    with socket.socket() as other, pytest.raises(OSError):
        other.connect(("127.0.0.2", port))  # this machine too, by another address


def test_a_save_is_shown_a_broken_file_as_its_faults(served):
    cell, port, process = served
    wait_for(has(port, "Planned"))
    text = cell.read_text()
    cell.write_text(text.replace("name: served", "name: saved"))
    wait_for(has(port, "<title>saved - handey</title>"))
    cell.write_text(text.replace("box:", "bax:", 1))
    wait_for(has(port, "bax"))
    broken = get(port)[1]
    assert "This cannot be read:" in broken and "unknown key" in broken
    # Saved as editors do: another file takes the name.
    other = cell.with_name("other.yaml")
    far = "task:\n- place: block\n  at:\n    xyz: [1.25, 0, 0.025]\n"
    other.write_text(text.split("task:")[0] + far)
    os.replace(other, cell)
    wait_for(has(port, "No plan"))
    process.send_signal(signal.SIGINT)
    begin = time.monotonic()
    assert process.wait(PATIENCE) == 0
    assert time.monotonic() - begin < PATIENCE / 2
    told = process.stderr.read()
    assert "Traceback" not in told
    assert told.splitlines()[0].endswith("cell.yaml: planned")


def test_ctrl_c_ends_it_while_a_browser_listens(served):
    _, port, process = served
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
    connection.request("GET", "/changes")
    news = connection.getresponse()
    assert news.getheader("Content-Type").startswith("text/event-stream")
    assert b'"status"' in news.readline()
    process.send_signal(signal.SIGINT)
    assert process.wait(PATIENCE) == 0
    with pytest.raises(OSError):
        get(port)


def test_a_port_that_is_taken_is_told(tmp_path, capsys):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        assert main(["view", str(write_cell(tmp_path)), "--serve", "--port", str(port)]) == 2
    assert f"port {port} cannot be listened at" in capsys.readouterr().err
    assert main(["view", str(tmp_path / "cell.yaml"), "--serve", "-o", "x.html"]) == 2
    assert main(["view", str(tmp_path / "cell.yaml"), "--port", "8000"]) == 2


def test_all_that_a_cell_names_is_watched(tmp_path):
    shutil.copytree(ROBOT.parent, tmp_path / "robot")
    cell = write_cell(tmp_path, robot={"file": "robot/robot.yaml"})
    text = cell.read_text().replace("fixtures:", "fixtures:\n  tray: {mesh: tray.stl}")
    cell.write_text(text)
    names = {path.name for path in files_of(cell)}
    assert {"cell.yaml", "robot.yaml", "tray.stl"} <= names
    assert any(name.endswith(".urdf") for name in names)
    watch = Watch(cell)
    assert watch.changed() and not watch.changed()
    (tmp_path / "tray.stl").write_bytes(b"solid")  # was missing
    assert watch.changed() and not watch.changed()
    (tmp_path / "robot" / "robot.yaml").touch()
    assert watch.changed()
    cell.write_text("{")  # names nothing any more; what it named stays watched
    assert watch.changed() and not watch.changed()
    (tmp_path / "tray.stl").unlink()
    assert watch.changed() and not watch.changed()


@needs_browser
def test_the_browser_comes_anew_and_keeps_the_camera(served, tmp_path):
    cell, port, process = served
    browser = new_browser(tmp_path / "profile")
    try:
        wait_for(has(port, "Planned"))
        opened(browser, f"http://127.0.0.1:{port}/")
        for key in ("4", "+"):
            browser.execute_script(
                "dispatchEvent(new KeyboardEvent('keydown', {key: arguments[0]}))", key
            )

        def told(name="told"):
            script = "return (document.getElementById(arguments[0]) || {}).innerText || ''"
            return browser.execute_script(script, name)

        kept = "return sessionStorage.getItem('handey view')"
        text = cell.read_text()
        # The words of the page change; the title, by which the camera is kept, does not.
        cell.write_text(text.replace("-0.15", "-0.1"))
        wait_for(lambda: "-0.100" in told())
        first = browser.execute_script(kept)
        assert '"tilt":1.56' in first
        cell.write_text(text.replace("box:", "bax:", 1))
        wait_for(lambda: told("words"))
        cell.write_text(text)
        wait_for(lambda: "-0.150" in told())
        time.sleep(0.5)
        cell.write_text(text.replace("-0.15", "-0.2"))
        wait_for(lambda: "-0.200" in told())
        assert '"tilt":1.56' in browser.execute_script(kept)
        assert severe(browser) == []
        process.send_signal(signal.SIGINT)
        wait_for(lambda: "ended" in told("live"))
    finally:
        browser.quit()


def test_ctrl_c_is_noted_where_an_exception_would_be_lost():
    before = signal.getsignal(signal.SIGINT)
    with interrupts() as pressed:
        assert not pressed.is_set()
        os.kill(os.getpid(), signal.SIGINT)
        assert pressed.wait(5.0)
    assert signal.getsignal(signal.SIGINT) is before
