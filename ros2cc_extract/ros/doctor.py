"""
A check of ``ros2 doctor``: the nodes of the package or workspace one stands in.

Loaded by ``ros2 doctor`` through the entry point ``ros2doctor.checks``; importing it needs no ROS.
Source of the interface: ros2doctor 0.36.1, ``ros2doctor/api/__init__.py``.
"""

from __future__ import annotations

import io
from pathlib import Path

from ros2cc_extract.diagnostics import Diagnostic, Severity, unreadable_folder
from ros2cc_extract.errors import Ros2ccError
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.packages.manifest import MANIFEST, python_files
from ros2cc_extract.pipeline.check import Outcome, check_paths
from ros2cc_extract.pipeline.config import load_config
from ros2cc_extract.ros.standard import standard_job

WORKSPACE_SOURCES = 'src'


@dataclass
class Counts:
    """
    Counts that ``ros2 doctor`` reads.

    The names are those of ``ros2doctor.api.Result``, which reads nothing else.
    """

    error: int = 0
    warning: int = 0


class CallbackCheck:
    """Checks the callbacks of the nodes below the current folder; elsewhere it has no opinion."""

    def category(self) -> str:
        """Link the check with reports of the same name."""
        return 'callbacks'

    def check(self) -> Counts:
        """Count findings; each is reported as a warning or error of the doctor."""
        folder = checked_folder(Path.cwd())
        if folder is None:
            return Counts()
        try:
            outcome = _outcome(folder)
        except Ros2ccError as error:
            _warn(f'callbacks could not be checked: {error}')
            return Counts(warning=1)
        return _counted(outcome)


def checked_folder(here: Path) -> Path | None:
    """Give the package, or the sources of the workspace, at ``here``; ``None`` elsewhere."""
    if (here / MANIFEST).is_file():
        return here
    sources = here / WORKSPACE_SOURCES
    return sources if any(sources.glob(f'*/{MANIFEST}')) else None


def _outcome(folder: Path) -> Outcome:
    barred: list[Diagnostic] = []
    files = python_files([folder], on_error=lambda error: barred.append(unreadable_folder(error)))
    return check_paths(standard_job(files, load_config(folder), barred), io.StringIO())


def _counted(outcome: Outcome) -> Counts:
    counts = Counts()
    for finding in outcome.findings:
        if finding.severity is Severity.ERROR:
            counts.error += 1
        elif finding.severity is Severity.WARNING:
            counts.warning += 1
        else:
            continue
        _warn(_line(finding))
    return counts


def _line(finding: Finding) -> str:
    mend = f'; {finding.help}' if finding.help else ''
    return f'{finding.place}: {finding.code} {finding.message}{mend}'


def _warn(message: str) -> None:
    from ros2doctor.api.format import doctor_warn

    doctor_warn(message)
