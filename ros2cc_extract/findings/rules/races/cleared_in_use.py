"""CC305: an object that is tested and then used, and set to ``None`` in between."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import called, listing, shown
from ros2cc_extract.findings.races.flag_locks import shared_by
from ros2cc_extract.findings.races.harms import uses_cleared
from ros2cc_extract.findings.races.races import Race, RaceKind, races_of
from ros2cc_extract.findings.races.uses import Use
from ros2cc_extract.findings.rules.races.lost_update import hit_of
from ros2cc_extract.findings.waits.overlap import is_quick, overlaps_itself
from ros2cc_extract.findings.waits.verdicts import SELF_OVERLAP, refuting_run
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Callback

HELP = (
    'take a copy first (x = self.x; if x is not None: x.…), or hold one lock around the test and '
    'the use, and where it is set to None'
)


def find(context: Context) -> Iterator[Hit]:
    reported: set[tuple[str, str | Place]] = set()
    for race in races_of(context):
        if race.kind is RaceKind.CLEARED_IN_USE:
            reported |= {(race.first.doer.name, name) for name in race.names}
            reported |= {(name, race.first.place) for name in race.names}
            yield weighed(race, hit_of(race, help_text=HELP))
    alike: dict[tuple[Place, Severity | None], list[Use]] = {}
    for use in _of_themselves(context):
        name = use.access.name
        if not reported & {(use.doer.name, name), (name, use.place)}:
            alike.setdefault((use.place, _severity(use, context)), []).append(use)
    for (_, severity), uses in alike.items():
        yield _of_itself(uses, severity, context)


def weighed(race: Race, hit: Hit) -> Hit:
    """A note where nothing is called between the test and the use."""
    return (
        hit
        if race.first.access.later or race.first.access.bare
        else replace(hit, severity=Severity.NOTE)
    )


def _of_themselves(context: Context) -> Iterator[Use]:
    """The first use of each object that another run of the same callback may clear."""
    for callback in shared_by(context):
        if overlaps_itself(callback, context):
            first: dict[str, Use] = {}
            for use, _ in uses_cleared(callback, callback):
                first.setdefault(use.access.name, use)
            yield from first.values()


def _severity(use: Use, context: Context) -> Severity | None:
    is_quickly = isinstance(use.doer, Callback) and is_quick(use.doer, context)
    return Severity.NOTE if is_quickly or not use.access.later else None


def _of_itself(uses: Sequence[Use], severity: Severity | None, context: Context) -> Hit:
    """One for all callbacks that come to this line, and for all that they use in it."""
    use, doers = uses[0], [use.doer for use in uses]
    names = list(dict.fromkeys(use.access.name for use in uses))
    is_one = len({called(doer) for doer in doers}) == 1
    verbs, whose = (('tests', 'uses'), 'it') if is_one else (('test', 'use'), 'one of them')
    what = 'it' if len(names) == 1 else 'them'
    return Hit(
        place=use.place,
        message=f'{shown(doers)} {verbs[0]} {listing(names)} and then {verbs[1]} {what}, and '
        f'another run of {whose} may set {"it" if what == "it" else "one of them"} to None in '
        'between: then the use raises an exception',
        help=HELP,
        severity=severity,
        subjects=(*(doer.name for doer in doers), *names),
        run=refuting_run(SELF_OVERLAP, context, use.doer),
    )


RULE = Rule(
    code='CC305',
    slug='cleared-in-use',
    severity=Severity.WARNING,
    title='Object set to None between a test and its use',
    what='A callback tests whether an object is there (`if self.goal is not None`) and then uses '
    'it (`self.goal.cancel()`), and a callback that may run at the same time sets it to None. If '
    'that happens between the test and the use, the use raises AttributeError or TypeError, '
    'which ends the spin. No lock is held around both. If nothing is called between the test and '
    'the use, it is only a note: an interpreter with a global lock does not switch threads there. '
    'An object that is used without any test may be gone as well.',
    why='Every read of an attribute looks it up again. CPython switches threads at calls and at '
    'the ends of loop iterations (3.12, `Python/bytecodes.c`, `CHECK_EVAL_BREAKER`), and in a '
    'build without the global lock anywhere. The model decides whether two callbacks may '
    'overlap; if the unit was not verified, their groups and the number of threads do. An '
    'exception in a callback leaves `spin`. Source: rclpy 7.1.6 and 9.1.2, `executors.py` '
    '(`MultiThreadedExecutor`, `_spin_once_impl`).',
    bad="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.goal = None
        self.create_timer(0.01, self.check, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_subscription(Empty, 'stop', self.on_stop, 10)

    def check(self):
        if self.goal is not None and self.goal.is_active():
            self.goal.refresh()

    def on_stop(self, msg):
        self.goal = None
""",
    good="""\
class Arm(Node):
    def check(self):
        goal = self.goal
        if goal is not None and goal.is_active():
            goal.refresh()
""",
    mend='Read the attribute once, into a local variable, and test and use that.',
    find=find,
)
