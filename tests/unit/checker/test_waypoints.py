"""Searches that go from waypoint to waypoint."""

from __future__ import annotations

from ros2cc_extract.checker.api import Limits, Query, Verdict, read_model
from ros2cc_extract.checker.refutation.waypoints import refute

MODEL = """\
<nta>
<declaration>
int[0,3] seen[2];
bool below(int most) { for (n : int[0,1]) if (seen[n] &gt;= most) return false; return true; }
</declaration>
<template><name>T</name>
<location id="a"><name>A</name></location><location id="b"><name>B</name></location>
<location id="c"><name>C</name></location><init ref="a"/>
<transition><source ref="a"/><target ref="b"/>
<label kind="assignment">seen[0] = 1</label></transition>
<transition><source ref="b"/><target ref="c"/>
<label kind="assignment">seen[1] = 2</label></transition>
</template>
<system>P = T(); system P;</system>
</nta>
"""


def test_a_query_may_call_a_function_that_the_model_does_not() -> None:
    """It is there only once the query was read."""
    query = Query('A[] below(2)', '', None)
    result = refute(read_model(MODEL, 'm.xml'), ['E<> P.B'], [query], limits=Limits())
    assert [answer.verdict for answer in result.answers] == [Verdict.NOT_SATISFIED]


def test_a_waypoint_may_call_one_too() -> None:
    query = Query('A[] not P.C', '', None)
    result = refute(read_model(MODEL, 'm.xml'), ['E<> not below(1)'], [query], limits=Limits())
    assert [answer.verdict for answer in result.answers] == [Verdict.NOT_SATISFIED]
