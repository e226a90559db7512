"""What a verdict says where its model leaves something out."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

EXAMPLES = Path(__file__).parents[3] / 'launch_free_examples'


@pytest.mark.parametrize(
    ('example', 'profile', 'words'),
    [
        (
            'service_deadlock',
            Profile.PAPER,
            'blocking calls left out, there is no deadlock: some step is always possible',
        ),
        (
            'service_deadlock',
            Profile.RCLPY,
            'there is no deadlock: all that arrives can be served',
        ),
        ('two_groups', Profile.PAPER, 'there is no deadlock: some step is always possible'),
    ],
)
def test_dead_locks_are_not_denied_by_a_model_that_knows_no_blocking(
    example: str, profile: Profile, words: str
) -> None:
    (unit,) = scan([EXAMPLES / example / 'node.py']).units
    options = Options(profile=profile, structural=False)
    assert verify_unit(close(unit), options).results[0].words == words
