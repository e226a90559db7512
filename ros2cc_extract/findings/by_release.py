"""Findings of one unit under several releases of rclpy as one list: each says where it holds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.settings import Setting, where


def of_all_releases(
    found: Sequence[tuple[Setting, Sequence[Finding]]], rows: Sequence[Behaviour]
) -> tuple[Finding, ...]:
    """
    Join what was found of one unit.

    :param found: for each setting of ``rows``, the one first whose words are kept.
    """
    holding: dict[object, list[Setting]] = {}
    first: dict[object, Finding] = {}
    for setting, findings in found:
        alike: Counter[object] = Counter()
        for finding in findings:
            about = (finding.code, finding.place, finding.subjects, finding.unit)
            alike[about] += 1
            identity = (about, alike[about])  # two may differ in their words alone
            first.setdefault(identity, finding)
            settings = holding.setdefault(identity, [])
            if setting not in settings:
                settings.append(setting)
    return tuple(
        finding
        if len(holding[identity]) == len(found)
        else replace(finding, message=f'{finding.message} (on {_where(holding[identity], rows)})')
        for identity, finding in first.items()
    )


def _where(settings: Sequence[Setting], rows: Sequence[Behaviour]) -> str:
    return where([release for setting in settings for release in setting.releases], rows)
