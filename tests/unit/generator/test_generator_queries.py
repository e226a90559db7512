from generator_units import closed_unit

from ros2cc_extract.generator.build import Family, Query, render

TWO = closed_unit('tick:TMR:g scan:SUB:g', 'g:EXCLUSIVE', 1)


def test_queries_stand_in_the_published_order():
    assert [query.formula for query in render(TWO).queries] == [
        'A[] not deadlock',
        'E<> cb_running(0)',
        'E<> cb_running(1)',
        'A[] not (cb_running(0) and cb_running(1))',
        'A[] cb_running(0) imply group_closed[cb_group_table[0]]',
        'A[] cb_running(1) imply group_closed[cb_group_table[1]]',
        'E<> (cb_running(0) and cb_running(1))',
        'A[] not group_closed[0]',
        '(executor.schedule_start and executor.ready_set_copy[0] and !cb_running(0))'
        ' --> cb_running(0)',
        '(executor.schedule_start and executor.ready_set_copy[1] and !cb_running(1))'
        ' --> cb_running(1)',
    ]


def test_a_query_names_its_callbacks_and_groups():
    by_family = {query.family: query for query in render(TWO).queries}
    assert by_family[Family.NEVER_TOGETHER] == Query(
        family=Family.NEVER_TOGETHER,
        formula='A[] not (cb_running(0) and cb_running(1))',
        words='tick and scan never run at the same time',
        callbacks=('tick', 'scan'),
        groups=(),
    )
    assert by_family[Family.GROUP_CLOSED] == Query(
        family=Family.GROUP_CLOSED,
        formula='A[] cb_running(1) imply group_closed[cb_group_table[1]]',
        words='group g is closed while scan runs',
        callbacks=('scan',),
        groups=('g',),
    )


def test_query_file_pairs_each_formula_with_its_words():
    one = closed_unit('tick:TMR:g', 'g:REENTRANT', 1)
    assert render(one).q == (
        '/*\nthere is no deadlock: some step is always possible\n*/\nA[] not deadlock\n\n'
        '/*\ntick can run\n*/\nE<> cb_running(0)\n\n'
        '/*\ngroup g is closed while tick runs\n*/\n'
        'A[] cb_running(0) imply group_closed[cb_group_table[0]]\n\n'
        '/*\ngroup g is always open to further threads\n*/\nA[] not group_closed[0]\n\n'
        '/*\ntick never starves: once a poll has seen it ready, it runs\n*/\n'
        '(executor.schedule_start and executor.ready_set_copy[0] and !cb_running(0))'
        ' --> cb_running(0)\n'
    )
