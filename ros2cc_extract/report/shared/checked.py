"""The result of a check, as every output format gets it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field

from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.promises import Judgement
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.system.model import System
from ros2cc_extract.verify.results.results import Verification


@dataclass(frozen=True, kw_only=True)
class Checked:
    """
    What a check found.

    :param verifications: of the units, in their order.
    :param promises: of the units, in their order.
    :param files: every file that was looked at.
    :param sources: text of those files that could be read, by the path that places name.
    :param root: absolute path of the repository; paths below it become relative.
    :param package: name of the test suite.
    :param docs_url: where the site of ``docs/`` stands; empty if unknown.
    :param with_verdicts: people want to see the table of queries of each unit too.
    :param system: what launch files among the paths start.
    :param more: what else the JSON holds, such as where a result comes from.
    """

    units: Sequence[Spec]
    verifications: Sequence[Verification]
    findings: Sequence[Finding]
    summary: Mapping[str, int]
    files: Sequence[str]
    sources: Mapping[str, str]
    promises: Sequence[Sequence[Judgement]] = ()
    root: str = ''
    package: str = 'ros2cc'
    docs_url: str = ''
    with_verdicts: bool = False
    system: System | None = None
    more: Mapping[str, object] = field(default_factory=dict)
