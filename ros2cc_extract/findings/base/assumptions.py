"""What a finding hangs on that was assumed: defaults of parameters."""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.spec.model import Spec


def with_assumptions(finding: Finding, unit: Spec) -> Finding:
    """
    Name what was assumed of the callbacks concerned, and what setting leads to a wait.

    A wait to which no default leads is reported as a warning at most.
    """
    concerned = [c for c in unit.callbacks if c.name in finding.subjects]
    remarks = tuple(
        Remark(callback.source, f'assumed: {callback.assumed}')
        for callback in concerned
        if callback.assumed and callback.source
    )
    executor = unit.executor
    if executor.assumed and executor.source and ' follows from parameter ' in executor.assumed:
        remarks += (Remark(executor.source, f'assumed: {executor.assumed}'),)
    waits = [b for c in concerned for b in c.blocking if b.source == finding.place]
    remarks += tuple(
        Remark(wait.source, f'assumed: {wait.assumed}')
        for wait in waits
        if wait.assumed and wait.source
    )
    conditions = list(dict.fromkeys(wait.only_if for wait in waits))
    if len(conditions) == 1 and conditions[0]:
        is_error = finding.severity is Severity.ERROR
        finding = replace(
            finding,
            message=f'{finding.message}; only if {conditions[0]}',
            severity=Severity.WARNING if is_error else finding.severity,
        )
    return replace(finding, related=(*finding.related, *remarks)) if remarks else finding
