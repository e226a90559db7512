"""The result of a check in every format but the one for terminals; one text per format."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ros2cc_extract.report.html.page import html_report
from ros2cc_extract.report.machine.github import workflow_commands
from ros2cc_extract.report.machine.json_report import check_data, to_text
from ros2cc_extract.report.machine.junit import junit
from ros2cc_extract.report.machine.sarif import sarif
from ros2cc_extract.report.shared.checked import Checked
from ros2cc_extract.report.unit_mermaid import units_diagram


def write(checked: Checked, format: str) -> str:
    """Write ``checked`` in one of the formats of ``WRITERS``."""
    return WRITERS[format](checked)


def _json(checked: Checked) -> str:
    data = check_data(checked.units, checked.verifications, checked.findings, checked.summary)
    return to_text({**data, **checked.more})


def _html(checked: Checked) -> str:
    return html_report(
        checked.units, checked.verifications, checked.findings, checked.summary, checked.sources
    )


def _mermaid(checked: Checked) -> str:
    return units_diagram(checked.units)


WRITERS: Mapping[str, Callable[[Checked], str]] = {
    'json': _json,
    'sarif': lambda checked: sarif(checked.findings, root=checked.root, docs_url=checked.docs_url),
    'junit': lambda checked: junit(checked.findings, checked.files, checked.package),
    'github': lambda checked: workflow_commands(checked.findings, root=checked.root),
    'html': _html,
    'mermaid': _mermaid,
}
