"""What the page tells in words: the verdict, the cause, the funnel of each goal, the nearest fix.

HTML that can be read and copied without a script; what can be shown in the picture is a button that
names the bodies, the stage and the text of a reason.
"""

from __future__ import annotations

import html
import json
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from handey.reporting.advice import Advice
from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import STAGES, Reason, Stage
from handey.reporting.report_file import ToldReport

__all__ = ["STAGE_WORDS", "told"]

VERDICTS = {
    "plan": ("Planned", ""),
    "infeasible": ("No plan", "there is none: the proof is below"),
    "unknown": ("No plan found", "there may be one"),
}
STAGE_WORDS = {
    "found": "found on the part",
    "spanned": "spanned by the jaws",
    "unobstructed": "unobstructed at both ends",
    "reachable": "reachable at both ends",
    "approached": "approached, lifted, put down",
    "connected": "connected by gross motions",
}
AT_ONCE = 4  # Choice: reasons of a stage; the others are one click away
MOST_ATTEMPTS = 30


def told(report: ToldReport, planes: Mapping[int, str] | None = None) -> str:
    """The report as HTML, the goals that failed first.

    Args:
        report: what is told.
        planes: pictures of the grasp plane, by goal.
    """
    first = [g for g in report.goals if g.status in ("failed", "stopped")]
    others = [g for g in report.goals if g not in first]
    several = len(report.goals) > 1
    sections = [_goal(g, several, True, (planes or {}).get(g.goal, "")) for g in first]
    sections += [
        _goal(g, several, not first and not several, (planes or {}).get(g.goal, "")) for g in others
    ]
    return "\n".join([_verdict(report), *sections])


def _verdict(report: ToldReport) -> str:
    word, meaning = VERDICTS[report.verdict]
    if report.stopped and report.verdict != "plan":
        meaning = report.stopped
    when = "" if report.wall_s is None else f"; {_seconds(report.wall_s)} of planning"
    lines = [
        f'<p id="verdict" data-verdict="{report.verdict}"><b>{word}</b>'
        f"<span>{_text(meaning)}{_text(when) if report.verdict != 'plan' else ''}</span></p>"
    ]
    lines += [f'<p class="warning">{_text(note)}</p>' for note in report.notes]
    return "\n".join(lines)


def _seconds(seconds: float) -> str:
    return f"{1e3 * seconds:.0f} ms" if seconds < 1 else f"{seconds:.1f} s"


def _goal(goal: GoalReport, several: bool, is_open: bool, plane: str) -> str:
    title = f"Goal {goal.goal}: {goal.text}" if several else goal.text
    content = [
        *_cause(goal),
        f'<p class="proof"><b>Proof:</b> {_text(_sentence(goal.proof))}</p>' if goal.proof else "",
        *_planned(goal),
        *_funnel(goal),
        *_advice(goal.advice),
        plane,
        *_more("What was looked at", goal.covered),
        *_more("Attempts", _attempts(goal)),
    ]
    head = f'<span class="status" data-status="{_text(goal.status)}">{_text(goal.status)}</span>'
    return "\n".join(
        [
            f'<details class="goal" data-goal="{goal.goal}"{" open" if is_open else ""}>',
            f"<summary><h2>{_text(title)}</h2> {head}</summary>",
            *(line for line in content if line),
            "</details>",
        ]
    )


def _cause(goal: GoalReport) -> list[str]:
    if goal.cause is None:
        return []
    words = _sentence(goal.cause.text)
    return [
        f'<p class="cause"><button type="button" class="why" aria-pressed="false" data-cause="1" '
        f"{_shown(goal.goal, goal.cause)}>{_text(words)}</button></p>"
    ]


def _sentence(words: str) -> str:
    """With a full stop; what begins with a name keeps its small letter."""
    return words if words.endswith((".", "!", "?")) else words + "."


def _planned(goal: GoalReport) -> list[str]:
    if goal.status != "planned":
        return []
    facts = [("grasp", goal.grasp)] if goal.grasp else []
    if "open" in goal.jaws and "closed" in goal.jaws:
        widths = f"come {1e3 * goal.jaws['open']:.1f} mm open, close to "
        facts.append(("jaws", widths + f"{1e3 * goal.jaws['closed']:.1f} mm"))
    if goal.aside:
        facts.append(("moved aside", ", ".join(goal.aside)))
    return [_facts(facts)] if facts else []


def _facts(rows: Iterable[tuple[str, str]]) -> str:
    written = "".join(f"<dt>{_text(a)}</dt><dd>{_text(b)}</dd>" for a, b in rows)
    return f"<dl>{written}</dl>"


# ------------------------------------------------------------------------------------------ funnel


def _funnel(goal: GoalReport) -> list[str]:
    if goal.stages:
        items = "\n".join(_stage(goal.goal, stage) for stage in goal.stages)
        return [f'<ol class="funnel" aria-label="Funnel of grasps">\n{items}\n</ol>']
    lines = [f"{count} {name}" for name, count in goal.counts.items()] + goal.reasons
    return (
        [f'<ul class="plain">{"".join(f"<li>{_text(x)}</li>" for x in lines)}</ul>']
        if lines
        else []
    )


def _stage(goal: int, stage: Stage) -> str:
    unit, words = STAGES[stage.name], STAGE_WORDS[stage.name]
    share = 100 * stage.passed / stage.entered if stage.entered else 0.0
    told = [
        f'<li class="stage" data-stage="{stage.name}">',
        f'<p><span class="name">{_text(words)}</span> '
        f'<span class="count"><b>{stage.passed}</b> of {stage.entered} {unit}</span></p>',
        f'<div class="bar{"" if stage.entered else " none"}" role="img" '
        f'aria-label="{stage.passed} of {stage.entered} passed">'
        f'<i style="width:{share:.2f}%"></i></div>',
    ]
    if stage.reasons:
        entries = [_reason(goal, reason) for reason in stage.reasons]
        first = AT_ONCE if len(entries) > AT_ONCE + 1 else len(entries)
        further = entries[first:]
        told.append(f'<ul class="reasons">{"".join(entries[:first])}</ul>')
        if further:
            more = f"<summary>{len(further)} more reasons</summary>"
            rest = f'<ul class="reasons">{"".join(further)}</ul>'
            told.append(f'<details class="more">{more}{rest}</details>')
    return "\n".join([*told, "</li>"])


def _reason(goal: int, reason: Reason) -> str:
    proved = ' <span class="tag">certain</span>' if reason.proved else ""
    return (
        f'<li><button type="button" class="why" aria-pressed="false" {_shown(goal, reason)}>'
        f'<span class="times">{reason.count}</span><span>{_text(reason.text)}{proved}</span>'
        "</button></li>"
    )


def _shown(goal: int, reason: Reason) -> str:
    """What the picture shows of a reason, as attributes."""
    bodies = json.dumps([*reason.bodies, *([reason.mover] if reason.mover else [])])
    return (
        f'data-goal="{goal}" data-stage="{reason.stage}" data-end="{_text(reason.end)}" '
        f'data-bodies="{_text(bodies)}" data-text="{_text(reason.text)}"'
    )


# ------------------------------------------------------------------------------------- what is more


def _advice(advice: Advice | None) -> list[str]:
    if advice is None:
        return []
    rows = "".join(
        f"<li><code>{_text(edit.place)}: {_text(json.dumps(edit.value))}</code>"
        f' <span class="note">in {_text(edit.file)}</span></li>'
        for edit in advice.edits
    )
    how = "planned with this change" if advice.verified else "not planned with"
    return [
        '<section class="advice"><h3>The nearest fix</h3>',
        f"<p>{_text(_sentence(advice.text))}</p>",
        f"<ul>{rows}</ul>" if rows else "",
        f'<p class="note">{how}</p></section>',
    ]


def _attempts(goal: GoalReport) -> list[str]:
    if goal.status == "planned" and len(goal.attempts) < 2:
        return []
    counted = Counter((a.grasp, a.stage, a.reason) for a in goal.attempts)
    lines = []
    for (grasp, stage, reason), count in list(counted.items())[:MOST_ATTEMPTS]:
        times = f" ({count} times)" if count > 1 else ""
        lines.append(f"{grasp}: {stage}{': ' + reason if reason else ''}{times}")
    more = len(counted) - MOST_ATTEMPTS
    return lines + ([f"and {more} more"] if more > 0 else [])


def _more(title: str, lines: Sequence[str]) -> list[str]:
    if not lines:
        return []
    items = "".join(f"<li>{_text(line)}</li>" for line in lines)
    written = f'<summary>{_text(title)}</summary><ul class="plain">{items}</ul>'
    return [f'<details class="more">{written}</details>']


def _text(words: str) -> str:
    """As HTML, with what cannot be printed made visible."""
    return html.escape("".join(c if c.isprintable() else "?" for c in words))
