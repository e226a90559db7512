"""
What a rule is: a code, its help text, and a check of one unit.

The texts here are the only help texts: ``explain``, the pages under ``docs/rules`` and the rule
tables of the reports are all made from them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import field
from functools import cached_property

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Activity, Callback, CallbackGroup, GroupType, Spec
from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.verify.results.evidence import Evidence
from ros2cc_extract.verify.results.results import Verification

Doer = Callback | Activity
"""What waits, reads and writes: a callback, or a thread of the program's own."""


@dataclass(frozen=True)
class Context:
    """
    What a rule may look at.

    :param verification: the verdicts on ``unit``, where it was verified.
    """

    unit: Spec
    verification: Verification | None = None

    @cached_property
    def written(self) -> tuple[Callback, ...]:
        """The user's callbacks; those that rclpy adds to every node are left out."""
        return tuple(callback for callback in self.unit.callbacks if not callback.builtin)

    @cached_property
    def by_name(self) -> dict[str, Callback]:
        """Every callback by its name."""
        return {callback.name: callback for callback in self.unit.callbacks}

    @cached_property
    def doers(self) -> tuple[Doer, ...]:
        """The user's callbacks, and what runs beside the executor."""
        return (*self.written, *self.unit.activities)

    @cached_property
    def everybody(self) -> tuple[Doer, ...]:
        """All that may run, functions too that code has which is not scanned."""
        return (*self.unit.callbacks, *self.unit.activities, *self.unit.handed)

    @cached_property
    def doer_by_name(self) -> dict[str, Doer]:
        """Every callback and every activity by its name."""
        return {**self.by_name, **{each.name: each for each in self.unit.activities}}

    @cached_property
    def groups(self) -> dict[str, CallbackGroup]:
        """Every group by its name."""
        return {group.name: group for group in self.unit.groups}

    def group_of(self, callback: Callback) -> CallbackGroup:
        """The group of a callback of the unit."""
        return self.groups[callback.group]

    def exclusive_group(self, callback: Callback) -> CallbackGroup | None:
        """The group of ``callback`` if it is known to be mutually exclusive."""
        group = self.group_of(callback)
        known = not group.unresolved and not group.groupless and not callback.groupless
        return group if known and group.type is GroupType.EXCLUSIVE else None

    def home(self) -> Place:
        """A place for what concerns the unit as a whole."""
        unit = self.unit
        return unit.executor.source or Place(unit.sources[0] if unit.sources else unit.name)


@dataclass(frozen=True, kw_only=True)
class Hit:
    """
    A finding before its rule has signed it.

    :param severity: where it differs from the rule's.
    :param cause: as that of a finding.
    """

    place: Place
    message: str
    help: str = ''
    severity: Severity | None = None
    subjects: tuple[str, ...] = ()
    chain: tuple[Remark, ...] = ()
    related: tuple[Remark, ...] = ()
    run: Evidence | None = None
    cause: str = ''


Check = Callable[[Context], Iterator[Hit]]


def _nothing(_context: Context) -> Iterator[Hit]:
    return iter(())


@dataclass(frozen=True, kw_only=True)
class Rule:
    """
    One rule.

    :param slug: stable short name, also that of the extractor's diagnostics it takes over.
    :param severity: the usual one; a finding may weigh less, and then says why.
    :param why: how rclpy behaves, with the source of the claim.
    :param bad: a node, or the part that matters, that gets the finding.
    :param good: the same, mended.
    :param mend: what to do, in a sentence or two.
    :param until: what releases do in which it matters no more; none for all.
    :param since: what releases of rclpy do in which it matters; none for all.
    :param language: of the bad example.
    :param find: the check; without one the rule speaks for the extractor's diagnostics.
    """

    code: str
    slug: str
    severity: Severity
    title: str
    what: str
    why: str
    bad: str
    good: str
    mend: str
    since: Behaviour | None = None
    until: Behaviour | None = None
    language: str = 'python'
    find: Check = field(default=_nothing, repr=False)

    def check(self, context: Context) -> Iterator[Finding]:
        """Give the findings of this rule on one unit, in the order of its callbacks."""
        for hit in self.find(context):
            yield Finding(
                code=self.code,
                severity=hit.severity or self.severity,
                place=hit.place,
                message=hit.message,
                help=hit.help,
                unit=context.unit.name,
                subjects=hit.subjects,
                chain=hit.chain,
                related=tuple(dict.fromkeys(hit.related)),
                run=hit.run,
                cause=hit.cause,
            )
