"""The result of a check in every format but the one for terminals; one text per format."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ros2cc_extract.report.html.page import html_report
from ros2cc_extract.report.machine.github import workflow_commands
from ros2cc_extract.report.machine.json_report import check_data, to_text
from ros2cc_extract.report.machine.junit import junit
from ros2cc_extract.report.machine.sarif import sarif
from ros2cc_extract.report.shared.checked import Checked
from ros2cc_extract.report.shared.last_line import last_line
from ros2cc_extract.report.unit_mermaid import units_diagram


def write(checked: Checked, format: str) -> str:
    """Write ``checked`` in one of the formats of ``WRITERS``."""
    return WRITERS[format](checked)


def _sarif(checked: Checked) -> str:
    line = last_line(checked.summary)
    return sarif(checked.findings, line=line, root=checked.root, docs_url=checked.docs_url)


def _json(checked: Checked) -> str:
    return to_text({**check_data(checked), **checked.more})


def _junit(checked: Checked) -> str:
    line = last_line(checked.summary)
    return junit(checked.findings, checked.files, checked.package, line=line)


def _mermaid(checked: Checked) -> str:
    return f'{units_diagram(checked.units)}%% {last_line(checked.summary)}\n'


WRITERS: Mapping[str, Callable[[Checked], str]] = {
    'json': _json,
    'sarif': _sarif,
    'junit': _junit,
    'github': lambda checked: workflow_commands(checked.findings, root=checked.root),
    'html': html_report,
    'mermaid': _mermaid,
}
