"""A page of one file: its head, and how what it holds is put into it.

No network and no server: style, script and data are in the page, and its policy forbids it to ask
for more than the address that it came from.
"""

from __future__ import annotations

import html
import json
from collections.abc import Mapping, Sequence
from importlib import resources
from typing import Any

__all__ = ["asset", "filled", "html_page", "script_of"]

HEAD = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1, viewport-fit=cover">
<meta name="color-scheme" content="{{scheme}}">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; connect-src {{connect}}; base-uri 'none'; form-action 'none'">
<title>{{title}} - handey</title>
<link rel="icon" href="data:,">
<style>
{{style}}
</style>
</head>
{{body}}
{{data}}<script>
{{script}}
</script>
</body>
</html>
"""  # noqa: E501


def html_page(
    title: str,
    style: str,
    body: str,
    script: str,
    scene: Mapping[str, Any] | None = None,
    *,
    dark: bool = False,
    live: bool = False,
) -> str:
    """The whole page.

    Args:
        title: as text.
        style: of the page.
        body: from `<body>` on, not closed.
        script: runs when all is there.
        scene: the data that the script finds in the element `scene`.
        dark: the page has colours for dark screens too.
        live: the page asks the server that it came from for news.
    """
    data = ""
    if scene is not None:
        written = json.dumps(scene, separators=(",", ":"), allow_nan=False)
        written = written.replace("<", "\\u003c")
        data = f'<script type="application/json" id="scene">{written}</script>\n'
    parts = {
        "title": html.escape(title),
        "scheme": "light dark" if dark else "light",
        "connect": "'self'" if live else "'none'",
        "style": style.strip(),
        "body": body.strip(),
        "data": data,
        "script": script.strip(),
    }
    return filled(HEAD, parts)


def filled(template: str, parts: Mapping[str, str]) -> str:
    """The template with its {{names}} replaced, in one pass: a part with braces stays as it is."""
    pieces = template.split("{{")
    result = [pieces[0]]
    for piece in pieces[1:]:
        key, _, rest = piece.partition("}}")
        result += [parts[key], rest]
    return "".join(result)


def asset(package: str, name: str) -> str:
    """The text of a file that lies beside the modules of a package."""
    return resources.files(package).joinpath(name).read_text(encoding="utf-8")


def script_of(package: str, names: Sequence[str]) -> str:
    """Scripts one after the other in one function: each knows the names of those before it."""
    return "\n".join(['"use strict";', "(() => {", *(asset(package, n) for n in names), "})();"])
