"""The check with nothing but the project's own settings: what linter, hook and doctor ask for."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ros2cc_extract.checker.api import Limits
from ros2cc_extract.diagnostics import Diagnostic
from ros2cc_extract.findings.filters.baseline import read_baseline
from ros2cc_extract.pipeline.check import Job
from ros2cc_extract.pipeline.config import Config, assumptions_of
from ros2cc_extract.pipeline.sources import read_input
from ros2cc_extract.spec.close import Policy
from ros2cc_extract.verify.search.options import Options

SECONDS_PER_UNIT = 20.0


def standard_job(paths: Sequence[Path], config: Config, noticed: Sequence[Diagnostic] = ()) -> Job:
    """
    Set up a check of ``paths``.

    :param noticed: what is known already, such as folders that cannot be looked into.
    :raises InputError: when the baseline of the settings cannot be used.
    """
    known: frozenset[str] = frozenset()
    if config.baseline is not None:
        known = read_baseline(read_input(config.baseline), str(config.baseline))
    return Job(
        paths=paths,
        config=config,
        policy=Policy(),
        options=Options(limits=Limits(seconds=config.timeout or SECONDS_PER_UNIT)),
        assumptions=assumptions_of(config, ()),
        root=config.root.resolve(),
        known=known,
        noticed=tuple(noticed),
    )
