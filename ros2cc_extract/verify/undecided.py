"""The verification of a unit that was not asked, or whose model could not be used."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterable
from dataclasses import replace

from ros2cc_extract.errors import CoreMismatchError, ModelFormatError, Ros2ccError
from ros2cc_extract.generator.build import Profile, Query, queries_of
from ros2cc_extract.generator.queries import structural_starvation
from ros2cc_extract.generator.unit import number_unit
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.results.results import Verification, open_result
from ros2cc_extract.verify.search.options import Options

LONGEST_MESSAGE = 300


def undecided_unit(closed: ClosedSpec, options: Options, reason: str) -> Verification:
    """Leave every query open, for one reason."""
    return _undecided(closed, options, _queries(closed, options), reason)


def is_defect(error: Exception) -> bool:
    """Whether verifying a unit has failed by our own fault, and no traceback is asked for."""
    is_of_model = isinstance(error, ModelFormatError | CoreMismatchError)
    by_us = is_of_model or not isinstance(error, Ros2ccError)
    return by_us and not os.environ.get('ROS2CC_TRACEBACK')


def failed_unit(closed: ClosedSpec, options: Options, error: Exception) -> Verification:
    """
    Report an error of our own model as a defect of this tool.

    The model was made here, of a unit without holes, so only we can mend it.
    """
    message = ' '.join(str(error).split())[:LONGEST_MESSAGE]
    defect = f'{type(error).__name__}: {message}'
    queries: tuple[Query, ...] = ()
    with contextlib.suppress(Exception):  # wrong queries are not shown; the defect is reported
        queries = _queries(closed, options)
    unit = _undecided(closed, options, queries, f'a defect of this tool: {defect}')
    return replace(unit, defect=defect)


def _queries(closed: ClosedSpec, options: Options) -> tuple[Query, ...]:
    queries = queries_of(closed, profile=options.profile, max_cycle=options.max_cycle)
    if options.profile is not Profile.RCLPY or not options.structural or not options.max_cycle:
        return queries
    return (*queries, *map(structural_starvation, number_unit(closed, None).callbacks))


def _undecided(
    closed: ClosedSpec, options: Options, queries: Iterable[Query], reason: str
) -> Verification:
    return Verification(
        model=closed.spec.name,
        profile=options.profile.value,
        text=options.text.value,
        engine='none',
        states=0,
        transitions=0,
        seconds=0.0,
        peak_mb=0.0,
        complete=False,
        results=tuple(open_result(query, reason) for query in queries),
        assumptions=closed.assumptions,
    )
