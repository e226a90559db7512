"""
Queries and answers of a checker, for modules that do not run one themselves.

Code that only names an engine, or reads a kept verdict, starts faster without a checker.
"""

from __future__ import annotations

from enum import Enum


class Verdict(Enum):
    """Answer to a query; undecided when a limit was hit before it was known."""

    SATISFIED = 'satisfied'
    NOT_SATISFIED = 'not satisfied'
    UNDECIDED = 'undecided'


class Fairness(Enum):
    """
    Which infinite paths count for ``-->``, ``A<>`` and ``E[]``.

    NONE: all, as in UPPAAL. WEAK: those on which no process is enabled from some point on for
    ever without ever moving.
    """

    NONE = 'none'
    WEAK = 'weak'


class EngineKind(Enum):
    """The engine that searches; AUTO is the native core if it is built."""

    AUTO = 'auto'
    REFERENCE = 'reference'
    NATIVE = 'native'
