"""What one arrival for each callback would leave empty is asked with two."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.generator.build import Family, Profile, Text
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.yaml.yaml_io import read_specs
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

UNIT = """\
node:
  name: arm
  callbacks:
    - {name: free, type: TMR, callback_group: reentrant}
    - {name: kept, type: SUB, callback_group: exclusive}
  callback_groups:
    - {name: reentrant, type: REENTRANT}
    - {name: exclusive, type: EXCLUSIVE}
  executor:
    name: executor
    threads: [%s]
"""


@pytest.mark.parametrize('text', list(Text))
@pytest.mark.parametrize(('threads', 'free'), [(1, Verdict.SATISFIED), (2, Verdict.NOT_SATISFIED)])
def test_a_reentrant_callback_overlaps_itself_on_two_threads(
    text: Text, threads: int, free: Verdict
) -> None:
    names = ', '.join(f'{{name: thread_{number}}}' for number in range(threads))
    (spec,) = read_specs(UNIT % names, 'arm.yaml')
    options = Options(profile=Profile.RCLPY, text=text)
    results = verify_unit(close(spec), options).results
    overlaps = {r.callbacks[0]: r for r in results if r.family == Family.SELF_OVERLAP.value}
    assert {name: result.verdict for name, result in overlaps.items()} == {
        'free': free,
        'kept': Verdict.SATISFIED,
    }
