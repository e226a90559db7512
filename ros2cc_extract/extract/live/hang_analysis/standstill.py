"""
What the hook writes when callbacks do not end.

Runs inside the user's process too: with all that it imports, the standard library only.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ros2cc_extract.extract.live.hang_analysis.formats import as_text
from ros2cc_extract.extract.live.hang_analysis.samples import look_of
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Verdict, explain
from ros2cc_extract.text_escaping import lines

Row = Mapping[str, Any]


def standstill(
    process: int, looks: tuple[Row, Row], limit_s: float, *, nothing_ended: bool
) -> tuple[str, str] | None:
    """
    Give the verdict on two looks and its explanation, where it is worth a word.

    A process that is idle never is. One in which other callbacks go on is where some are in a
    deadlock: a callback that only takes long is no news as long as others end.
    """
    explanation = explain(process, (look_of(looks[0]), look_of(looks[1])))
    is_silent = explanation.verdict is Verdict.HEALTHY
    if is_silent or not (nothing_ended or explanation.verdict is Verdict.DEADLOCK):
        return None
    what = 'no callback has' if nothing_ended else 'a callback has not'
    head = f'ros2cc-extract: {what} ended for {limit_s:g} s'
    return explanation.verdict.value, lines(f'{head}\n{as_text((explanation,))}')
