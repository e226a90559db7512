"""What is said of a race."""

from __future__ import annotations

from ros2cc_extract.findings.base.wording import called, listing
from ros2cc_extract.findings.races.loops_over_data import is_replaced
from ros2cc_extract.findings.races.races import Race, RaceKind
from ros2cc_extract.spec.effects import BY_KEY, FILLS, TAKES_NEXT
from ros2cc_extract.spec.releases.table import NO_GLOBAL_LOCK

IN_ONE_PIECE = (
    f'{NO_GLOBAL_LOCK.without}, which the language does not promise and free-threaded builds lack'
)


def describe(race: Race) -> str:
    """Say what happens to the attributes."""
    first = called(race.first.doer)
    others = listing(called(use.doer) for use in race.others)
    if race.others[0].doer.name == race.first.doer.name:
        others = 'another thread that runs it'
    others = f'{others} of another entity' if others == first else others
    names = listing(race.names, limit=4)
    it = 'it' if len(race.names) == 1 else 'them'
    old = 'its old value' if len(race.names) == 1 else 'their old values'
    some = 'a part of it' if len(race.names) == 1 else 'some of them'
    return {
        RaceKind.CHANGED_IN_LOOP: f'{first} iterates over {names}, and {others} may change '
        f'the size of {it} meanwhile: Python raises RuntimeError in the loop',
        RaceKind.CLEARED_IN_USE: f'{first} uses {names} without a test, and {others} may set {it} '
        'to None before: then the use raises an exception'
        if race.first.access.bare
        else f'{first} tests {names} and then uses {it}, and {others} may set {it} to None in '
        'between: then the use raises an exception',
        RaceKind.TORN: f'{first} {_takes(race)} {names} while {others} may change {it} piece by '
        f'piece: {"the message" if _is_sent(race) else it} is half old and half new',
        RaceKind.EMPTIED: f'{first} iterates over {names} and then empties {it}, and {others} may '
        'put something in before that: it is lost',
        RaceKind.SHRUNK_IN_LOOP: f'{first} goes over {names} by index, and {others} may take '
        'items out meanwhile: Python raises IndexError in the loop',
        RaceKind.TAKEN: _taken(race, first, names, others),
        RaceKind.GONE: f'{first} finds an item in {names} and then looks it up, and {others} may '
        f'take it out in between: Python raises {_lack(race)}',
        RaceKind.OVERWRITTEN: f'{first} writes {names}, waits and reads {it} back, and {others} '
        f'may write {it} in between: then it gets what was meant for the other',
        RaceKind.LOST_UPDATE: f'{first} updates {names} from {old}, and {others} may write {it} '
        'at the same time: one change can get lost',
        RaceKind.CHECK_THEN_ACT: f'{first} reads {names} and then writes {it}, and {others} may '
        f'write {it} in between: what was read no longer holds',
        RaceKind.CHECK_THEN_CHANGE: f'{first} reads {names} and then changes {it} in place, and '
        f'{others} may change {it} in between: what was read may no longer hold',
        RaceKind.WHOLE_UPDATE: f'{first} updates {names} from {old} without a lock, and {others} '
        f'may write {it} at the same time: {IN_ONE_PIECE}',
        RaceKind.TORN_STATE: f'{first} reads {names}, and {others} may have written only {some} '
        'by then: new values stand beside old ones',
        RaceKind.LAST_WRITE_WINS: f'{first} and {others} may write {names} at the same time: the '
        'last one wins',
    }[race.kind]


def _taken(race: Race, first: str, names: str, others: str) -> str:
    moves = race.first.access.moves
    if moves == FILLS:
        return (
            f'{first} finds room in {names} and then puts an item in, and {others} may take the '
            'last room in between: then it raises an exception, or waits'
        )
    if is_replaced(race.first.access, race.others[0].access):
        return (
            f'{first} finds an item in {names} and then takes one out, and {others} may put '
            'others in their place in between: then it takes one that it has not looked at'
        )
    or_waits = ', or waits' if moves == TAKES_NEXT else ''
    return (
        f'{first} finds an item in {names} and then takes one out, and {others} may take the last '
        f'one in between: then it raises an exception{or_waits}'
    )


def _lack(race: Race) -> str:
    return 'KeyError' if race.first.access.looks_up == BY_KEY else 'IndexError'


def _is_sent(race: Race) -> bool:
    """Whether it is a message that goes out."""
    sent = {act.source for act in race.first.doer.publishes}
    return race.first.place in sent


def _takes(race: Race) -> str:
    return 'publishes' if _is_sent(race) else 'uses all of'
