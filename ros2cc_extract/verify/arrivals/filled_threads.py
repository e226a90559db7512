"""
A second look at claims about ends: with callbacks of which one run is not enough.

They fill the threads with runs of their own, or use up what is given once. One arrival for each
callback is enough for all else; see ``needed_arrivals.crowding`` and ``repeated_takers``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.generator.build import Family, Query
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.arrivals.needed_arrivals import crowding
from ros2cc_extract.verify.arrivals.repeated_takers import not_looked_at, taking_again
from ros2cc_extract.verify.results.results import QueryResult
from ros2cc_extract.verify.search.search_results import Found, key_of, total, weighs_more

Ask = Callable[[Sequence[Query], ClosedSpec, Limits], Found]
#: The second search is the last one: it may take what is left of the time of the unit.
MOST_STATES = 3_000_000
OF_ENDS = (Family.DEADLOCK, Family.PROGRESS, Family.POOL_EXHAUSTION, Family.STARVATION)


def ask_again(
    found: Found, queries: Sequence[Query], closed: ClosedSpec, ask: Ask, limits: Limits
) -> Found:
    """
    Ask again what one arrival for each has not refuted, and keep what is refuted or open now.

    The search has its own bound on states: a waiting callback often may overlap itself. What no
    number of arrivals shows leaves open what is not refuted.
    """
    of_ends = [query for query in queries if query.family in OF_ENDS]
    again = _asked_again(found, of_ends, closed, ask, limits)
    reason = not_looked_at(closed.spec, found.results)
    if not reason:
        return again
    results = dict(again.results)
    threads = {activity.name for activity in closed.spec.activities}
    for query in of_ends:
        key = key_of(query)
        # What keeps a thread waiting then keeps the callback waiting that takes from it.
        is_of_thread = query.family is Family.PROGRESS and threads.issuperset(query.callbacks)
        if results[key].verdict is Verdict.SATISFIED and not is_of_thread:
            results[key] = replace(
                results[key], verdict=Verdict.UNDECIDED, reason=reason, run=None, in_doubt=True
            )
    return replace(again, results=results)


def _asked_again(
    found: Found, of_ends: Sequence[Query], closed: ClosedSpec, ask: Ask, limits: Limits
) -> Found:
    arrivals = _arrivals(found, closed)
    asked = [query for query in of_ends if _may_be_of(query, arrivals)]
    left = [query for query in asked if _may_be_refuted(found.results[key_of(query)])]
    if not arrivals or not left:
        return found
    more = replace(closed, arrivals=arrivals)
    second = ask(left, more, replace(limits, states=limits.states or MOST_STATES))
    results = dict(found.results)
    for query in left:
        key = key_of(query)
        if weighs_more(second.results[key], results[key]):
            results[key] = replace(second.results[key], repeated=tuple(arrivals))
    check = replace(
        total((found.check, second.check)), complete=found.check.complete and second.check.complete
    )
    return Found(results, check, found.by_slices)


def _arrivals(found: Found, closed: ClosedSpec) -> Mapping[str, int]:
    crowds, takers = crowding(closed.spec), taking_again(closed.spec, found.results)
    return {
        name: max(crowds.get(name, 1), takers.get(name, 1))
        for callback in closed.spec.callbacks
        if (name := callback.name) in crowds or name in takers
    }


def _may_be_of(query: Query, arrivals: Mapping[str, int]) -> bool:
    """Return whether runs that fill the threads may refute it: a starved one has no thread."""
    return query.family is not Family.STARVATION or not arrivals.keys() <= set(query.callbacks)


def _may_be_refuted(result: QueryResult) -> bool:
    """What a limit has left open one that is no wider does not decide."""
    return result.verdict is Verdict.SATISFIED or result.in_doubt
