"""Serves one page on the loopback address, and tells the browser when there is a new one.

Two addresses are served and no others: the page, and a stream of events that says which version of
it there is. Requests that name another host are refused: a foreign page whose name leads to this
address would otherwise be let in.
"""

from __future__ import annotations

import json
import secrets
import threading
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from handey.errors import Fault, InvalidInput

__all__ = ["ADDRESS", "LiveServer"]

ADDRESS = "127.0.0.1"
NAMES = (ADDRESS, "localhost")
STILL_THERE = 10.0  # Choice: so often a browser is asked for a sign of life [s]
PATIENCE = 10.0  # Choice: for a request that comes byte by byte [s]
HEADERS = {
    "Cache-Control": "no-store",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
}


class LiveServer:
    """The server, in threads of its own.

    Attributes:
        port: that it listens at.
    """

    def __init__(self, port: int = 0) -> None:
        """Listens; pages follow by `show`.

        Args:
            port: 0 for any that is free.

        Raises:
            InvalidInput: E_PORT if the port cannot be had.
        """
        self._news = threading.Condition()
        # Not the versions of a server that was here before.
        self._name, self._made, self._version = secrets.token_hex(4), 0, ""
        self._page, self._status, self._ended = "", "planning", False
        try:
            self._http = _Http((ADDRESS, port), _Handler)
        except (OSError, OverflowError) as error:
            reason = getattr(error, "strerror", None) or str(error)
            raise InvalidInput(
                Fault("E_PORT", "--port", f"port {port} cannot be listened at: {reason}")
            ) from error
        self._http.live = self
        self.port = int(self._http.server_address[1])
        self._thread = threading.Thread(
            target=self._http.serve_forever, kwargs={"poll_interval": 0.1}, daemon=True
        )
        self._thread.start()

    @property
    def address(self) -> str:
        """Of the page."""
        return f"http://{ADDRESS}:{self.port}/"

    def next_version(self) -> str:
        """The version that the next page must hold."""
        with self._news:
            self._made += 1
            return f"{self._name}-{self._made}"

    def show(self, page: str, version: str) -> None:
        """A new page."""
        with self._news:
            self._page, self._version, self._status = page, version, "ready"
            self._news.notify_all()

    def tell_planning(self) -> None:
        """A new page is in the making."""
        with self._news:
            self._status = "planning"
            self._news.notify_all()

    def end(self) -> None:
        """Nothing is served any more."""
        with self._news:
            self._ended = True
            self._news.notify_all()
        self._http.shutdown()
        self._http.server_close()
        self._thread.join()

    def page(self) -> str:
        """What there is to see now."""
        with self._news:
            return self._page

    def state(self, but: str = "", wait: float = 0.0) -> str | None:
        """Version and status as JSON; None in the end.

        Args:
            but: waits for another one than this.
            wait: so long at most [s].
        """
        with self._news:
            self._news.wait_for(lambda: self._ended or self._state() != but, wait)
            return None if self._ended else self._state()

    def _state(self) -> str:
        return json.dumps({"version": self._version, "status": self._status})


class _Http(ThreadingHTTPServer):
    daemon_threads = True
    block_on_close = False
    live: LiveServer

    def handle_error(self, request: object, client_address: object) -> None:
        """A browser that went away is nothing to tell of."""


class _Handler(BaseHTTPRequestHandler):
    server: _Http
    server_version, sys_version = "handey", ""
    protocol_version = "HTTP/1.1"
    timeout = PATIENCE

    def do_GET(self) -> None:
        """The page or the news."""
        names = {f"{name}:{self.server.live.port}" for name in NAMES}
        if self.server.live.port == 80:
            names |= set(NAMES)
        if self.headers.get_all("Host", []) not in [[name] for name in names]:
            self._answer(HTTPStatus.MISDIRECTED_REQUEST, "text/plain", "another host is meant\n")
        elif self.path == "/":
            self._answer(HTTPStatus.OK, "text/html", self.server.live.page())
        elif self.path == "/changes":
            self._tell_changes()
        else:
            self._answer(HTTPStatus.NOT_FOUND, "text/plain", "there is only the page /\n")

    def _answer(self, status: HTTPStatus, kind: str, text: str) -> None:
        content = text.encode()
        self._head(status, kind)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def _head(self, status: HTTPStatus, kind: str) -> None:
        self.send_response(status)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        for name, value in HEADERS.items():
            self.send_header(name, value)

    def _tell_changes(self) -> None:
        self.close_connection = True
        self._head(HTTPStatus.OK, "text/event-stream")
        self.send_header("Connection", "close")
        self.end_headers()
        told = ""
        while True:
            state = self.server.live.state(told, STILL_THERE if told else 0.0)
            if state is None:
                return
            line = ": still there" if state == told else f"data: {state}"
            self.wfile.write(f"{line}\n\n".encode())
            self.wfile.flush()
            told = state

    def log_message(self, format: str, *args: object) -> None:
        """Requests are not told of."""
