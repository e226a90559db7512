"""Children answer what they are asked; what they cannot answer is done by the parent."""

from __future__ import annotations

import os
import subprocess
import sys

# Each in a process of its own: under some test runners threads run, and a fork is not safe.
HEAD = 'import os, signal, threading, time\n'
HEAD += 'from ros2cc_extract.jobs.process_pool import ProcessPool, usable_cores\n'


def said(program: str) -> str:
    done = subprocess.run(
        [sys.executable, '-c', HEAD + program], capture_output=True, text=True, timeout=60
    )
    return f'{done.stdout}{done.stderr}'.strip()


def test_answers_come_in_the_order_of_the_requests() -> None:
    program = """
with ProcessPool(lambda n: n * n, 3) as pool:
    print([answer for answer, _ in pool.ask(range(20))])
"""
    assert said(program) == str([n * n for n in range(20)])


def test_who_answered_can_be_asked_again() -> None:
    program = """
with ProcessPool(lambda _: os.getpid(), 3) as pool:
    first = pool.ask(range(9))
    again = pool.ask(range(9), [child for _, child in first])
    print(again == first, os.getpid() in [pid for pid, _ in first])
"""
    assert said(program) == 'True False'


def test_the_work_of_a_child_that_dies_is_done_by_the_parent() -> None:
    program = """
parent = os.getpid()
def answer(n):
    if n % 3 == 0 and os.getpid() != parent:
        os.kill(os.getpid(), signal.SIGKILL)
    return n
with ProcessPool(answer, 2) as pool:
    print([answer for answer, _ in pool.ask(range(9))])
"""
    assert said(program) == str(list(range(9)))


def test_an_error_is_raised_where_it_can_be_handled() -> None:
    program = """
def answer(n):
    raise LookupError('no ' + str(n))
try:
    with ProcessPool(answer, 2) as pool:
        pool.ask([7, 8])
except LookupError as error:
    print(error)
"""
    assert said(program) == 'no 7'


def test_nothing_is_shared_while_a_thread_runs() -> None:
    program = """
held = threading.Event()
threading.Thread(target=held.wait).start()
print(usable_cores(), usable_cores(4))
held.set()
"""
    assert said(program) == '1 1'


def test_cores_are_those_this_process_may_use() -> None:
    program = 'os.sched_setaffinity(0, {0})\nprint(usable_cores(), usable_cores(3))'
    assert said(program) == '1 3'
    assert said('print(usable_cores())') == str(len(os.sched_getaffinity(0)))


def test_an_interrupt_leaves_no_child_and_no_noise() -> None:
    program = """
parent = os.getpid()
def answer(n):
    if n == 1:
        os.kill(0, signal.SIGINT)  # the whole group, as a terminal does
    time.sleep(60)
signal.signal(signal.SIGINT, signal.default_int_handler)
os.setpgid(0, 0)
try:
    with ProcessPool(answer, 2) as pool:
        children = [child.pid for child in pool._children]
        pool.ask([1, 2])
except KeyboardInterrupt:
    print('interrupted')
print([pid for pid in children if os.path.exists('/proc/%d' % pid)])
"""
    assert said(program) == 'interrupted\n[]'
