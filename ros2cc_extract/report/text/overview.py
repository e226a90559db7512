"""One row per unit: what a whole repository holds, where a table of verdicts each is too much."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from rich.console import Console
from rich.padding import Padding

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.places import Unknown
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.report.shared.owners import is_about
from ros2cc_extract.report.text.style import table
from ros2cc_extract.shown import one_line
from ros2cc_extract.spec.model import Executor, Spec
from ros2cc_extract.verify.results.results import Verdict, Verification


def print_overview(
    verified: Sequence[tuple[Spec, Verification]], findings: Sequence[Finding], console: Console
) -> None:
    """
    Print a row per unit, with the number of its errors and warnings.

    Of units without an executor in sight only those that have such are rows: no verdict of the
    others tells more than what was assumed.
    """
    rows = table('unit', 'entry', 'executor', 'callbacks', 'groups', 'overlapping', 'findings')
    left_out = 0
    shared = Counter(source for unit, _ in verified for source in unit.sources)
    units = [unit for unit, _ in verified]
    for unit, verification in verified:
        weight = _weight([finding for finding in findings if is_about(finding, unit, units)])
        if isinstance(unit.executor.kind, Unknown) and not weight:
            left_out += 1
            continue
        rows.add_row(
            one_line(unit.name),
            one_line(_home(unit, shared)),
            one_line(_executor(unit.executor)),
            str(len(unit.callbacks)),
            str(len({callback.group for callback in unit.callbacks})),
            _overlapping(verification),
            weight or '-',
        )
    if left_out < len(verified):
        console.print(rows)
    if left_out:
        told = counted(left_out, 'units')
        console.print(f'{told} without an executor in sight, no error, no warning: see --tables')
    undecided = sum(verification.is_undecided for _, verification in verified)
    if undecided:
        console.print(f'{counted(undecided, "units")} with undecided verdicts: see --tables')
    console.print(
        Padding('overlapping: pairs of callbacks that can run at the same time', (0, 0, 1, 0))
    )


def _home(unit: Spec, shared: Counter[str]) -> str:
    """Where it is started, or else the file that the fewest others share, with its folder."""
    place = unit.entry or min(unit.sources, key=lambda source: shared[source], default='-')
    return '/'.join(place.split('/')[-2:])


def _executor(executor: Executor) -> str:
    threads = counted(len(executor.threads), 'threads')
    if isinstance(executor.kind, Unknown):
        return f'none found, {threads} assumed'
    assumed = ' assumed' if executor.threads_source == 'default_cpu_count' else ''
    return f'{executor.kind or "executor"}, {threads}{assumed}'


def _overlapping(verification: Verification) -> str:
    pairs = Counter(r.verdict for r in verification.results if r.family == 'can_overlap')
    if not pairs:
        return '-'
    return f'{pairs[Verdict.SATISFIED]} of {pairs.total()}'


def _weight(findings: Sequence[Finding]) -> str:
    severities = Counter(finding.severity for finding in findings)
    counts = ((Severity.ERROR, 'errors'), (Severity.WARNING, 'warnings'))
    told = [counted(severities[which], what) for which, what in counts if severities[which]]
    return ', '.join(told)
