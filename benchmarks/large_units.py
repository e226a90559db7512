"""
CPU time of profile rclpy on large units: 8 threads, a group for four callbacks.

``python benchmarks/large_units.py [--seconds 60]`` prints user CPU time (``resource``), all
queries asked, of units without waits and with one callback of ten that calls a
service of somebody outside. Beside them: what the same took before slices had a normal form
(revision 59f22b2), on units of random kinds and groups.
"""

from __future__ import annotations

import argparse
import resource
from collections import Counter

from rclpy_profile import Size, make_unit

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

#: CPU seconds before, without waits, by number of callbacks.
BEFORE = {10: 3.3, 20: 7.0, 40: 25.0, 80: 107.0, 160: 165.0}
THREADS = 8


def user_seconds() -> float:
    """CPU time of this process outside the system."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--seconds', type=float, default=60.0, help='limit of one unit')
    options = Options(profile=Profile.RCLPY, limits=Limits(seconds=parser.parse_args().seconds))
    print('| callbacks | callers | queries | open | states | CPU s | before |')
    print('|---|---|---|---|---|---|---|')
    for number in BEFORE:
        for callers in (0, number // 10):
            closed = close(make_unit(Size(number, number // 4, THREADS, callers)))
            started = user_seconds()
            results = verify_unit(closed, options)
            seconds = user_seconds() - started
            verdicts = Counter(result.verdict for result in results.results)
            before = '' if callers else f'{BEFORE[number]:g}'
            print(
                f'| {number} | {callers} | {len(results.results)} '
                f'| {verdicts[Verdict.UNDECIDED]} | {results.states} | {seconds:.2f} '
                f'| {before} |',
                flush=True,
            )


if __name__ == '__main__':
    main()
