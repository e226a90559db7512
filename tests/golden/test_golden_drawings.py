"""The pictures in ``docs/`` are the drawings of the templates as they are."""

import os
from dataclasses import replace
from pathlib import Path

import pytest

from ros2cc_extract.generator.build import Profile, Text, render
from ros2cc_extract.generator.executor_kinds import ExecutorKind
from ros2cc_extract.generator.svg import draw
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.yaml.yaml_io import load_specs

IMAGES = Path(__file__).parents[2] / 'docs' / 'images'
SPEC = Path(__file__).parent / 'models' / 'services' / 'spec.yaml'


def compare(prefix: str, xml: str) -> None:
    drawn = {f'{prefix}_{name}.svg': picture for name, picture in draw(xml).items()}
    if os.environ.get('RENEW_GOLDEN'):
        for name, picture in drawn.items():
            (IMAGES / name).write_text(picture, encoding='utf-8')
    assert drawn == {
        path.name: path.read_text(encoding='utf-8') for path in IMAGES.glob(f'{prefix}_*.svg')
    }


def waiting_unit(kind: ExecutorKind) -> ClosedSpec:
    """The recorded unit, in which the watchdog calls a service and the service awaits it."""
    (spec,) = load_specs(SPEC)
    home, *others, watchdog = spec.callbacks
    home = replace(home, blocking=(Blocking(call='await', on='plan_reply'),))
    watchdog = replace(watchdog, blocking=(Blocking(call='client.call', on='plan_reply'),))
    executor = replace(spec.executor, kind=kind.value)
    return close(replace(spec, callbacks=(home, *others, watchdog), executor=executor))


@pytest.mark.parametrize('text', Text)
def test_pictures_show_the_templates_of_profile_paper(text: Text):
    (spec,) = load_specs(SPEC)
    compare(f'paper_{text.value}', render(close(spec), text=text).xml)


@pytest.mark.parametrize('kind', ExecutorKind)
def test_pictures_show_the_templates_of_profile_rclpy(kind: ExecutorKind):
    model = render(waiting_unit(kind), profile=Profile.RCLPY)
    compare(f'rclpy_{kind.value}', model.xml)
