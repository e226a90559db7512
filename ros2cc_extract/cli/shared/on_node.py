"""Findings on the running node: the interpreter that runs it, and what came of each."""

from __future__ import annotations

import argparse
import importlib.util
import shutil
import sys
from dataclasses import replace
from typing import TextIO

from ros2cc_extract.confirm.confirming import confirm
from ros2cc_extract.confirm.consent import ask_to_start
from ros2cc_extract.confirm.schedules import can_be_tried, schedule_of
from ros2cc_extract.findings.base.model import Finding, OnNode
from ros2cc_extract.pipeline.check import Outcome


def interpreter_of(args: argparse.Namespace) -> str:
    """The one that is named; else this one if it has rclpy, else the first of the path."""
    if args.python:
        return str(args.python)
    own = importlib.util.find_spec('rclpy') is not None
    return sys.executable if own else shutil.which('python3') or sys.executable


def with_outcomes(
    outcome: Outcome, args: argparse.Namespace, release: str | None, stderr: TextIO
) -> tuple[Finding, ...]:
    """
    Try each finding that can be shown.

    :raises InputError: when a program may not be started.
    """
    python = interpreter_of(args)
    schedules = {
        number: schedule_of(each, outcome.units)
        for number, each in enumerate(outcome.findings)
        if can_be_tried(each)
    }
    for entry in dict.fromkeys(each.entry for each in schedules.values()):
        ask_to_start(entry, python, stderr, yes=args.yes)
    found = list(outcome.findings)
    for number, schedule in schedules.items():
        if stderr.isatty():
            print(f'confirming {schedule.code} at {schedule.path}:{schedule.line}', file=stderr)
        judgement = confirm(schedule, python, stubs=args.stub_missing).judgement
        on_node = OnNode(
            judgement.outcome.value, release, judgement.reason, judgement.evidence, judgement.run
        )
        found[number] = replace(found[number], on_node=on_node)
    return tuple(found)
