"""Wrong models, made by changing the text of the right one; executions must distinguish them."""

from __future__ import annotations

import re
from collections.abc import Callable


def clients_after_services(text: str) -> str:
    """As the published model serves them."""
    return re.sub(
        r'(cb_rank_table\[NUM_CB\] = \{)([^}]*)(\})',
        lambda found: found[1] + found[2].translate({ord('5'): '6', ord('6'): '5'}) + found[3],
        text,
    )


def group_closed_at_submission(text: str) -> str:
    """While a member of a group is queued, no other one is."""
    return _replaced(
        text,
        '    return !group_closed[cb_group_table[c]];\n',
        '    return !group_closed[cb_group_table[c]] &amp;&amp; forall (other : CbId)'
        ' !(cb_queued[other] &gt; 0 &amp;&amp; cb_group_table[other] == cb_group_table[c]);\n',
    )


def vanishing_readiness(text: str) -> str:
    """Who is refused has nothing to do any more."""
    return _replaced(
        text,
        '>cb_queued[my_cb()]--,',
        '>cb_queued[my_cb()]--, cb_waiting[my_cb()] = 0,',
    )


def waiting_for_a_free_thread(text: str) -> str:
    """Nothing is collected while all threads run."""
    return _replaced(
        text,
        '>is_next(c) &amp;&amp; may_begin(c)</label>',
        '>is_next(c) &amp;&amp; may_begin(c) &amp;&amp;'
        ' exists (t : ThreadId) !thread_running[t]</label>',
    )


def no_refused_starts(text: str) -> str:
    """What was queued will start."""
    return re.sub(
        r'(<label kind="guard"[^>]*>)([^<]*group_closed\[my_group\(\)\])(</label>\s*'
        r'<label kind="assignment"[^>]*>cb_queued)',
        r'\1false\3',
        text,
    )


def take_at_collection(text: str) -> str:
    """Data is taken by the thread that spins."""
    begun = re.sub(
        r'    (if \(cb_waiting\[my_cb\(\)\][^\n]*\n    )?'
        r'    ?cb_waiting\[my_cb\(\)\]--;\n',
        '',
        text,
    )
    return _replaced(begun, '    pool_size++;\n', '    pool_size++;\n    cb_waiting[c]--;\n')


def tasks_in_the_other_order(text: str) -> str:
    """As the other distribution serves them."""
    return re.sub(
        r'(task_turn\[a\] )&([gl])t;',
        lambda found: f'{found[1]}&{"l" if found[2] == "g" else "g"}t;',
        text,
    )


def _replaced(text: str, old: str, new: str) -> str:
    assert old in text, f'the text has changed: {old}'
    return text.replace(old, new)


def served_by_kind(text: str) -> str:
    """As the other executors do: subscriptions before services, in any order of arrival."""
    first = (
        '    int[0, NUM_EVENT - 1] first;\n'
        '    for (place : int[0, NUM_EVENT - 1])\n'
        '        if (place &lt; event_count'
        ' &amp;&amp; cb_rank_table[event_queue[place]] &lt; cb_rank_table[event_queue[first]])\n'
        '            first = place;\n'
    )
    return _taking('event_queue[first]', 'place &gt;= first &amp;&amp; ', first)(text)


def newest_event_first(text: str) -> str:
    """As a stack."""
    return _taking('event_queue[event_count - 1]', 'place &gt;= event_count &amp;&amp; ', '')(text)


def one_event_for_each(text: str) -> str:
    """An entity that waits to be served gets no second note of what arrives."""
    return _replaced(
        text,
        '    event_queue[event_count] = c;\n    event_count++;\n',
        '    if (cb_waiting[c] == 1) {\n'
        '        event_queue[event_count] = c;\n        event_count++;\n    }\n',
    )


def _taking(event: str, moved: str, before: str) -> Callable[[str], str]:
    """Take another event than the first; those behind it move up."""
    pairs = (
        ('= event_queue[0];\n', f'= {event};\n'),
        (
            '        event_queue[place] = place &lt; event_count ?',
            f'        if ({moved}true)\n            event_queue[place] = place &lt; event_count ?',
        ),
        ('void take_event() {\n', f'void take_event() {{\n{before}'),
    )

    def edit(text: str) -> str:
        for old, new in pairs:
            text = _replaced(text, old, new)
        return text

    return edit


#: Each with the program written by hand that distinguishes it.
PLANTED = (
    (clients_after_services, -1),
    (group_closed_at_submission, -2),
    (vanishing_readiness, -2),
    (waiting_for_a_free_thread, -3),
    (no_refused_starts, -2),
    (take_at_collection, -2),
    (tasks_in_the_other_order, -4),
    (served_by_kind, -5),
    (newest_event_first, -5),
    (one_event_for_each, -5),
)
