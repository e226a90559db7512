"""The line that ends every report: what was found, and in how much."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

from ros2cc_extract.report.shared.counts import counted

_FOUND = ('errors', 'warnings', 'notes', 'undecided_waits')


def last_line(summary: Mapping[str, int]) -> str:
    """Write it; nothing is counted that is not there, and what is undecided is said."""
    counts = Counter(summary)
    found = [counted(counts[kind], kind) for kind in _FOUND if counts[kind]]
    where = counted(counts['files'], 'files')
    if found:
        line = f'Found {", ".join(found)} in {where}'
    elif counts['units']:
        line = f'No problems found in {where}'
    else:
        line = f'Nothing to check in {where}: no node with a callback'
    more = [f'{counts["accepted"]} accepted'] if counts['accepted'] else []
    if counts['undecided']:
        more.append(f'{counted(counts["undecided"], "verdicts")} undecided')
    return '; '.join([line, *more])
