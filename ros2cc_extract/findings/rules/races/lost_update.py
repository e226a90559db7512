"""CC301: an attribute read and written back while another callback may write it."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.races.race_texts import describe
from ros2cc_extract.findings.races.races import Race, RaceKind, races_of
from ros2cc_extract.findings.waits.remedies import LOCK_OF_LOOP, is_on_loop

HELP = 'hold one lock around both, or put the callbacks into one mutually exclusive group'
OF_OTHER_RULES = (RaceKind.LAST_WRITE_WINS, RaceKind.CLEARED_IN_USE)
HELP_OUTSIDE_GROUPS = 'hold one lock around both; a callback group cannot help'


def find(context: Context) -> Iterator[Hit]:
    for race in races_of(context):
        if race.kind not in OF_OTHER_RULES and not race.is_outside_groups:
            is_loop = is_on_loop(context.unit.executor) and not race.has_threads
            yield hit_of(race, help_text=LOCK_OF_LOOP if is_loop else '')


def hit_of(race: Race, message: str = '', help_text: str = '') -> Hit:
    """The finding of one race; ``message`` is added to what happens."""
    is_free = race.is_outside_groups or race.has_threads
    is_less = race.kind in (RaceKind.CHECK_THEN_CHANGE, RaceKind.WHOLE_UPDATE)
    is_less = is_less or (race.kind is RaceKind.CHECK_THEN_ACT and race.is_flag)
    is_less = is_less or (race.kind is RaceKind.GONE and not race.first.access.later)
    is_less = is_less or (race.kind is RaceKind.OVERWRITTEN and race.first.access.asked)
    is_less = is_less or (race.kind is RaceKind.TORN_STATE and not race.is_meant_whole)
    return Hit(
        place=race.first.place,
        message=describe(race) + message,
        help=help_text or (HELP_OUTSIDE_GROUPS if is_free else HELP),
        severity=Severity.NOTE if is_less else None,
        subjects=race.subjects,
        related=race.related(),
        run=race.run,
    )


RULE = Rule(
    code='CC301',
    slug='lost-update',
    severity=Severity.WARNING,
    title='Attribute updated by callbacks that may overlap',
    what='A callback reads an attribute and writes it back (`self.n += self.size(msg)`, or a test '
    'followed by an assignment), another callback writes it, the two may run at the same '
    'time, and they hold no common lock. A write of what the test has found (`if self.x is '
    'None`, and others only set it to None) is not reported. Neither is one that comes only where '
    'another state was found (`if self.x is not None`), if nobody else brings that state about '
    'behind the test. A change in place after a test '
    '(`if d: d.pop()`, `d[k] = d.get(k) + 1`) is only a note, because the two may mean '
    'different items; it is a warning where both have looked for an item in the collection '
    'and one of them waits before it changes that item. A loop over a dictionary, set or '
    'deque that another callback changes meanwhile raises RuntimeError; a collection that is '
    'passed to a helper or a thread is still the same one, a copy (`list(d.items())`) is not. '
    'A loop over a list, or a copy of it, that is emptied behind it loses what others put in '
    'meanwhile. Code that counts through the indices of a list from which others take items, or '
    'that has found an item, waits, and takes one while others may take the last, fails by an '
    'exception. So does code that looks up what it has found in a dictionary (`if k in d`, `for k '
    'in list(d)`, then `d[k]`) or in a list that others take out or empty; a note if nothing is '
    'called in between. So does code that asks a queue (`empty()`, `qsize()`, `full()`) and then '
    'takes an item or puts one in, or it waits: no pause is needed in between. Variables of other '
    'modules, attributes of functions, default values, results that `lru_cache` keeps and fields '
    'of a kept message are data like attributes. A '
    'message that is kept and changed piece by piece (`self.msg.position[k] = x`, two fields '
    'one after the other) while another callback publishes it goes out half old and half new; '
    'a message that is created each time, or changed in one step, does not. Attributes that '
    'one callback writes one after the other, so that others may run in between, while '
    'another reads them together, are a note, and so are items of one container; it is a warning '
    'if it waits in between and both come from one thing, or holds a lock over both. '
    'Threads that the program starts, timer threads and pool tasks '
    'included, and `main` beside a thread that spins count like callbacks, on any executor. '
    'Accesses before the start of a thread or after its join, what one run alone does before it '
    'makes the entity of the other callback, and accesses that exclusive '
    'branches keep apart, are not reported. What a callback has written and reads back after a '
    'wait is only a note if nothing but a test looks at it. A flag that one tests and both set to '
    'constants is only a note there. So is an update of a number with nothing but constants and '
    'names between its read and its write (`self.n += 1`), if the other updates it in the same '
    'way or has not read it before: CPython does that in one step.',
    why='With a `MultiThreadedExecutor` callbacks of different groups, or of one reentrant '
    'group, run on different threads. CPython may switch threads between the read and the write: '
    'where a Python function begins (also a property or `__add__`), at a call, and at the end of '
    'a loop iteration. Measured on CPython 3.10 to 3.13, two threads: of 4 to 20 million `self.n '
    '+= 1` none was lost, of those with a call or a property 27 to 45 %. The language does not '
    'guarantee this, and free-threaded builds switch anywhere. The model decides whether two '
    'callbacks may overlap; if the unit was not verified, their groups and the number of threads '
    'do. Source: rclpy 7.1.6 and 9.1.2, `executors.py` (`MultiThreadedExecutor`), '
    '`callback_groups.py`. No executor controls a thread that the program starts. Measured with '
    'rclpy 7.1.6: a thread and a timer added to one counter, on a `SingleThreadedExecutor`; of '
    '35593 additions 32800 were lost. A thread that read a sensor for each of the six items of a '
    'message which a timer published: of 80 messages 43 held two samples (rclpy 7.1.6; 42 with '
    '9.1.2), and none under one lock.',
    bad="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.1, self.tick, callback_group=ReentrantCallbackGroup())
        self.create_subscription(Empty, 'reset', self.on_reset, 10)

    def tick(self):
        self.count += self.steps()

    def on_reset(self, msg):
        self.count = 0
""",
    good="""\
class Arm(Node):
    def tick(self):
        with self.lock:
            self.count += self.steps()

    def on_reset(self, msg):
        with self.lock:
            self.count = 0
""",
    mend='Hold one `threading.Lock` around both, never over a blocking call; or put both '
    'callbacks into one mutually exclusive group.',
    find=find,
)
