"""Explanations as one HTML page, without a script or anything from elsewhere."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from pathlib import Path

from ros2cc_extract.extract.live.hang_analysis.formats import (
    MEANS,
    does,
    ready,
    resource,
    shared_deadlocks,
    title,
)
from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind
from ros2cc_extract.extract.live.hang_analysis.samples import Frame, Look
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Explanation, Standing, Verdict
from ros2cc_extract.files import read_regular
from ros2cc_extract.text_escaping import one_line

_STYLE = """
:root { --paper: #f6f7f9; --card: #fff; --ink: #1b2430; --soft: #5b6675; --line: #d9dee6;
  --bad: #c62828; --open: #b26a00; --good: #2e7d32; --code: #f1f3f7; }
@media (prefers-color-scheme: dark) { :root { --paper: #14181f; --card: #1d232d; --ink: #e4e9f0;
  --soft: #98a4b5; --line: #333c4a; --bad: #ff7b72; --open: #e3a64b; --good: #6cc070;
  --code: #171c24; } }
body { margin: 0 auto; padding: 0 24px 64px; max-width: 1180px; background: var(--paper);
  color: var(--ink); font: 15px/1.5 system-ui, sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 22px; } h2 { font-size: 18px; margin: 32px 0 4px; }
.deadlock { color: var(--bad); } .open { color: var(--open); }
.good { color: var(--good); } .quiet { color: var(--soft); }
.chain { display: flex; flex-wrap: wrap; align-items: center; gap: 8px; margin: 12px 0; }
.chain > div { background: var(--card); border: 1px solid var(--line); border-radius: 8px;
  padding: 8px 12px; flex: 0 1 auto; max-width: 100%; }
.chain > .never { border-color: var(--bad); }
@media (min-width: 900px) { .chain { flex-wrap: nowrap; } .chain > span { flex: none; } }
.chain > span { color: var(--soft); }
pre { background: var(--code); margin: 4px 0 0; padding: 4px 8px; white-space: pre-wrap; }
ul { margin: 0; padding-left: 18px; }
"""
_MOST_SOURCE_BYTES = 5_000_000
_BAD = (
    Verdict.DEADLOCK,
    Verdict.NEVER_SPUN,
    Verdict.IN_NO_EXECUTOR,
    Verdict.ASLEEP,
    Verdict.OUTSIDE,
)


def as_html(explanations: Sequence[Explanation]) -> str:
    """Give a whole page: of each process the verdict, and the wait-for graph as chains."""
    shared = ''.join(
        f'<p class="deadlock"><b>{_text(each)}</b></p>\n'
        for each in shared_deadlocks(explanations)
    )
    body = ''.join(''.join(_of_process(each)) for each in explanations)
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<title>Why it hangs</title><style>{_STYLE}</style></head>\n'
        f'<body><h1>Why it hangs</h1>\n{shared}{body}</body></html>\n'
    )


def _of_process(explanation: Explanation) -> Iterator[str]:
    verdict = explanation.verdict
    colour = 'deadlock' if verdict in _BAD else 'open'
    if verdict in (Verdict.BUSY, Verdict.HEALTHY):
        colour = 'good'
    yield f'<h2>{_text(title(explanation))}</h2>\n'
    yield (
        f'<p><b class="{colour}">{_text(verdict.value)}</b>: {_text(MEANS[verdict])} '
        f'<span class="quiet">({_text(explanation.proof)})</span></p>\n'
    )
    for each in sorted(explanation.standings, key=lambda s: (s.can_end, not s.in_callback)):
        if each.wait.kind is Kind.WORK:
            yield f'<p class="quiet">{_text(each.activity.name)} waits for work</p>\n'
        else:
            yield f'<div class="chain">{"".join(_chain(each, explanation.look))}</div>\n'
    for executor in explanation.look.executors:
        names = ', '.join(executor.nodes) or 'no node'
        due = ready(explanation, executor.entities)
        yield f'<p class="quiet">{_text(f"{executor.cls} of {names}{due}")}</p>\n'


def _chain(standing: Standing, look: Look) -> Iterator[str]:
    """The chain from the waiting thread over what it waits for to what keeps that."""
    activity, place = standing.activity, standing.activity.place
    never = '' if standing.can_end else ' class="never"'
    code = f'{standing.code} ' if standing.code else ''
    line = _line(place)
    source = f'<pre>{_text(line)}</pre>' if line else ''
    yield (
        f'<div{never}><b>{_text(code + place.called)}</b> ({_text(activity.name)})<br>'
        f'<span class="quiet">{_text(place.at_line)}</span>{source}</div>'
    )
    if standing.asleep or standing.wait.kind in (Kind.NOTHING, Kind.SLEEP):
        yield f'<span>{_text(does(standing, look))}</span>'
        return
    limit = ' with a time-out' if standing.wait.timed else ''
    forever = '' if standing.can_end else ' forever'
    what = resource(standing.wait, look)
    yield f'<span>waits{forever} for →</span><div>{_text(what + limit)}</div>'
    if standing.reasons:
        reasons = ''.join(f'<li>{_text(each)}</li>' for each in standing.reasons)
        yield f'<span>→</span><div><ul>{reasons}</ul></div>'


def _line(place: Frame) -> str:
    """Give the source line as it is now; the process names the file, so it may be anything."""
    try:
        text = read_regular(Path(place.file), _MOST_SOURCE_BYTES).decode(errors='replace')
    except (OSError, ValueError):
        return ''
    return next(iter(text.splitlines()[place.line - 1 : place.line]), '').strip()


def _text(text: str) -> str:
    """Escape a text; names and lines come from the process and may hold anything."""
    return escape(one_line(text))
