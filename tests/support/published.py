"""The published model of callbacks, groups, threads and executor, written out for the tests."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from xml.sax.saxutils import escape

TYPES = ('TMR', 'SUB', 'SRV', 'CLT')


@dataclass(frozen=True)
class Case:
    """
    One case.

    :param callbacks: type and group number of each.
    :param groups: REENTRANT or EXCLUSIVE of each.
    """

    callbacks: tuple[tuple[str, int], ...]
    groups: tuple[str, ...]
    threads: int
    max_cycle: int = 1


def one_group(callbacks: int, threads: int, group: str, max_cycle: int = 1) -> Case:
    """Return the published shape: the first half timers, the others subscriptions."""
    timers = (callbacks + 1) // 2
    kinds = ['TMR'] * timers + ['SUB'] * (callbacks - timers)
    return Case(tuple((kind, 0) for kind in kinds), (group,), threads, max_cycle)


def declarations(case: Case) -> str:
    """Return the global declarations."""
    groups = ', '.join(str(group) for _, group in case.callbacks)
    types = ', '.join(kind for kind, _ in case.callbacks)
    return f"""
const int NUM_CB = {len(case.callbacks)};
const int NUM_CB_GROUP = {len(case.groups)};
const int NUM_THREAD = {case.threads};
const int MAX_CYCLE = {case.max_cycle};
typedef int[0, NUM_CB - 1] CbId;
typedef int[0, NUM_CB_GROUP - 1] GroupId;
typedef int[0, NUM_THREAD - 1] ThreadId;
typedef int[0, 3] CbType;
typedef int[0, 1] GroupType;
const CbType TMR = 0; const CbType SUB = 1; const CbType SRV = 2; const CbType CLT = 3;
const GroupType REENTRANT = 0; const GroupType EXCLUSIVE = 1;
const GroupId cb_group_table[NUM_CB] = {{{groups}}};
const CbType cb_type_table[NUM_CB] = {{{types}}};
bool group_closed[NUM_CB_GROUP];
bool ready_set[NUM_CB];
bool thread_running[NUM_THREAD];
CbId thread_cb_assign_table[NUM_THREAD];
chan group_close[NUM_CB_GROUP], group_open[NUM_CB_GROUP], cb_assign_signal[NUM_THREAD];
broadcast chan thread_free;
bool cb_running(CbId c) {{
    return exists (t : ThreadId) thread_running[t] && thread_cb_assign_table[t] == c;
}}
"""


EXECUTOR = """
bool ready_set_copy[NUM_CB];
CbId cur_cb_id;
ThreadId cur_thread_id;
bool ok(CbId c) {
    return (cb_type_table[c] == TMR ? ready_set[c] : ready_set_copy[c])
        && !group_closed[cb_group_table[c]];
}
ThreadId idle_thread() {
    ThreadId t;
    for (t = 0; t < NUM_THREAD - 1; t++) {
        if (!thread_running[t]) return t;
    }
    return thread_running[t] ? 0 : t;
}
"""


def edge(source: str, target: str, **labels: str) -> str:
    """Return a transition element."""
    kinds = ''.join(
        f'<label kind="{kind}">{escape(text)}</label>' for kind, text in labels.items() if text
    )
    return f'<transition><source ref="{source}"/><target ref="{target}"/>{kinds}</transition>\n'


def location(name: str, kind: str = '') -> str:
    """Return a location element whose reference is its name."""
    mark = f'<{kind}/>' if kind else ''
    return f'<location id="{name}"><name>{name}</name>{mark}</location>\n'


def template(
    name: str, parameters: str, local: str, locations: str, initial: str, edges: str
) -> str:
    """Return a template element."""
    return (
        f'<template><name>{name}</name><parameter>{escape(parameters)}</parameter>'
        f'<declaration>{escape(local)}</declaration>\n{locations}'
        f'<init ref="{initial}"/>\n{edges}</template>\n'
    )


def document(declaration: str, templates: str, system: str, queries: str = '') -> str:
    """Return a whole model file."""
    return (
        '<?xml version="1.0" encoding="utf-8"?>\n<nta>\n'
        f'<declaration>{escape(declaration)}</declaration>\n{templates}'
        f'<system>{escape(system)}</system>\n<queries>{queries}</queries>\n</nta>\n'
    )


def query_element(formula: str, comment: str = '') -> str:
    """Return a query element."""
    text = f'<formula>{escape(formula)}</formula><comment>{escape(comment)}</comment>'
    return f'<query>{text}</query>\n'


def _callback() -> str:
    return template(
        'Callback',
        'const CbId id',
        'int[0, MAX_CYCLE] cycle_count;',
        location('wait') + location('ready'),
        'wait',
        edge(
            'wait',
            'ready',
            guard='cycle_count < MAX_CYCLE',
            assignment='ready_set[id] = true, cycle_count++',
        )
        + edge('ready', 'wait', assignment='ready_set[id] = false'),
    )


def _group() -> str:
    closed, reentrant = 'group_closed[id] = ', 'type == REENTRANT'
    return template(
        'CallbackGroup',
        'const GroupType type, const GroupId id',
        '',
        location('open') + location('close'),
        'open',
        edge(
            'open',
            'open',
            guard=reentrant,
            synchronisation='group_open[id]?',
            assignment=closed + 'false',
        )
        + edge(
            'open',
            'open',
            guard=reentrant,
            synchronisation='group_close[id]?',
            assignment=closed + 'false',
        )
        + edge(
            'open',
            'close',
            guard='type == EXCLUSIVE',
            synchronisation='group_close[id]?',
            assignment=closed + 'true',
        )
        + edge(
            'close',
            'open',
            guard='type == EXCLUSIVE',
            synchronisation='group_open[id]?',
            assignment=closed + 'false',
        ),
    )


def _thread() -> str:
    return template(
        'Thread',
        'const ThreadId id',
        'CbId my_cb_id; GroupId my_cb_group_id;',
        location('wait')
        + location('assigned', 'committed')
        + location('running', 'urgent')
        + location('done', 'committed'),
        'wait',
        edge(
            'wait',
            'assigned',
            synchronisation='cb_assign_signal[id]?',
            assignment='my_cb_id = thread_cb_assign_table[id],'
            ' my_cb_group_id = cb_group_table[my_cb_id]',
            comments='{callback my_cb_id} is given to {thread id}',
        )
        + edge(
            'assigned',
            'running',
            synchronisation='group_close[my_cb_group_id]!',
            assignment='thread_running[id] = true',
            comments='{callback my_cb_id} starts on {thread id}',
        )
        + edge(
            'running',
            'done',
            synchronisation='group_open[my_cb_group_id]!',
            assignment='thread_running[id] = false',
            comments='{callback my_cb_id} ends on {thread id}',
        )
        + edge('done', 'wait', synchronisation='thread_free!'),
    )


def _executor() -> str:
    some_idle = 'exists (t : ThreadId) !thread_running[t]'
    pick = 'cur_thread_id = idle_thread()'
    next_cb = 'cur_cb_id < NUM_CB - 1'
    last_cb = 'cur_cb_id == NUM_CB - 1'
    return template(
        'Executor',
        '',
        EXECUTOR,
        location('polling', 'urgent')
        + location('schedule_start', 'committed')
        + location('pick_thread', 'urgent')
        + location('wait_thread')
        + location('pick_cb', 'urgent')
        + location('execute_cb', 'urgent')
        + location('next_cb', 'committed'),
        'polling',
        edge('polling', 'schedule_start', assignment='ready_set_copy = ready_set, cur_cb_id = 0')
        + edge('schedule_start', 'pick_thread')
        + edge('pick_thread', 'pick_cb', guard=some_idle, assignment=pick)
        + edge('pick_thread', 'wait_thread', guard=f'!({some_idle})')
        + edge('wait_thread', 'pick_cb', synchronisation='thread_free?', assignment=pick)
        + edge(
            'pick_cb',
            'execute_cb',
            guard='ok(cur_cb_id)',
            synchronisation='cb_assign_signal[cur_thread_id]!',
            assignment='thread_cb_assign_table[cur_thread_id] = cur_cb_id',
        )
        + edge('pick_cb', 'next_cb', guard='!ok(cur_cb_id)')
        + edge('execute_cb', 'pick_thread', guard=next_cb, assignment='cur_cb_id++')
        + edge('execute_cb', 'polling', guard=last_cb)
        + edge('next_cb', 'pick_cb', guard=next_cb, assignment='cur_cb_id++')
        + edge('next_cb', 'polling', guard=last_cb),
    )


def system(case: Case) -> str:
    """Return the system declaration: executor, threads, groups, callbacks."""
    lines = ['executor = Executor();']
    lines += [f'thread_{i} = Thread({i});' for i in range(case.threads)]
    lines += [f'group_{i} = CallbackGroup({kind}, {i});' for i, kind in enumerate(case.groups)]
    lines += [f'cb_{i} = Callback({i});' for i in range(len(case.callbacks))]
    names = ', '.join(line.split(' = ')[0] for line in lines)
    return '\n'.join(lines) + f'\nsystem {names};\n'


def formulas(case: Case) -> list[str]:
    """Return the seven query families in the published order."""
    numbers = range(len(case.callbacks))
    pairs = list(combinations(numbers, 2))
    return [
        'A[] not deadlock',
        *(f'E<> cb_running({i})' for i in numbers),
        *(f'A[] not (cb_running({i}) and cb_running({j}))' for i, j in pairs),
        *(f'A[] cb_running({i}) imply group_closed[cb_group_table[{i}]]' for i in numbers),
        *(f'E<> (cb_running({i}) and cb_running({j}))' for i, j in pairs),
        *(f'A[] not group_closed[{g}]' for g in range(len(case.groups))),
        *(
            f'(executor.schedule_start and executor.ready_set_copy[{i}] and !cb_running({i}))'
            f' --> cb_running({i})'
            for i in numbers
        ),
    ]


def published_model(case: Case) -> str:
    """Return the model of a case with all its queries."""
    templates = _executor() + _thread() + _group() + _callback()
    queries = ''.join(query_element(formula) for formula in formulas(case))
    return document(declarations(case), templates, system(case), queries)
