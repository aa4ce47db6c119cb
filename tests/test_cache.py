"""Where the tables are kept, as the environment says."""

from __future__ import annotations

from pathlib import Path

import pytest

from handey.cache import table_directory


def test_the_variable_of_handey_comes_first(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", "/var/tmp/cache")
    monkeypatch.setenv("HANDEY_CACHE", "/srv/tables")
    assert table_directory() == "/srv/tables"
    monkeypatch.setenv("HANDEY_CACHE", "")
    assert table_directory() == ""


def test_else_the_cache_of_the_user(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("HANDEY_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", "/var/tmp/cache")
    assert table_directory() == "/var/tmp/cache/handey"
    monkeypatch.setattr(Path, "home", lambda: Path("/home/ann"))
    for ignored in ("", "relative/cache"):
        monkeypatch.setenv("XDG_CACHE_HOME", ignored)
        assert table_directory() == "/home/ann/.cache/handey"


def test_without_a_home_nothing_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless() -> Path:
        raise RuntimeError("could not determine home directory")

    monkeypatch.delenv("HANDEY_CACHE", raising=False)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(Path, "home", homeless)
    assert table_directory() == ""
