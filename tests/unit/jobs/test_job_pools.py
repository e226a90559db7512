"""A list of jobs is done by any pool, with the same answers."""

from __future__ import annotations

import pickle
import subprocess
import sys
import time
from contextlib import closing

from ros2cc_extract.deadline import Deadline
from ros2cc_extract.jobs.pools import Processes, in_order

# In a process of its own: under some test runners threads run, and then nothing is forked.
HEAD = """
import os, signal, time
from contextlib import closing
from ros2cc_extract.jobs.pools import Processes, in_order
from ros2cc_extract.jobs.process_pool import usable_cores
"""


def said(program: str) -> str:
    done = subprocess.run(
        [sys.executable, '-c', HEAD + program], capture_output=True, text=True, timeout=60
    )
    return f'{done.stdout}{done.stderr}'.strip()


def test_answers_stand_in_the_order_of_their_jobs() -> None:
    program = """
def late_first(job):
    time.sleep(0.2 if job == 'a' else 0)
    return job * 2
done = []
print(in_order(Processes(2), late_first, ['a', 'b', 'c'], done.append), done)
print([number for number, _ in Processes(2).each(late_first, ['a', 'b', 'c'])])
"""
    assert said(program) == "['aa', 'bb', 'cc'] [1, 2, 3]\n[1, 2, 0]"


def test_jobs_are_inherited_and_need_not_be_pickled() -> None:
    program = """
jobs = [lambda: os.getpid() != parent for _ in range(4)]
parent = os.getpid()
print(in_order(Processes(2), lambda job: job(), jobs))
"""
    assert said(program) == '[True, True, True, True]'


def test_who_stops_early_leaves_no_child() -> None:
    program = """
def work(job):
    time.sleep(0 if job == 0 else 60)
    return os.getpid()
with closing(Processes(2).each(work, range(3))) as answers:
    _, child = next(answers)
print(os.path.exists(f'/proc/{child}'))
"""
    assert said(program) == 'False'


def test_a_child_shares_no_cores() -> None:
    program = """
os.sched_getaffinity = lambda pid: {0, 1}
print(in_order(Processes(2), lambda job: usable_cores(8), range(2)), usable_cores(8))
"""
    assert said(program) == '[1, 1] 8'


def test_one_job_or_none_stays_here() -> None:
    with closing(Processes(4).each(lambda job: job + 1, [1])) as answers:
        assert list(answers) == [(0, 2)]
    assert in_order(Processes(4), str, []) == []


def test_a_deadline_travels_as_the_time_that_is_left() -> None:
    sent = pickle.dumps(Deadline(time.monotonic() + 0.2, 'too late'))
    time.sleep(0.3)
    received = pickle.loads(sent)
    assert (received.is_over, received.reason) == (False, 'too late')
    assert 0.1 < received.at - time.monotonic() <= 0.2
