"""A read of a camera takes as long as a frame and ends by itself; that of a file is no wait."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of_unit
from ros2cc_extract.spec.effects import TIME, Blocking, Waker
from ros2cc_extract.spec.model import Spec

PROGRAM = """\
import cv2
import rclpy
from rclpy.node import Node


class Camera(Node):
    def __init__(self):
        super().__init__('camera')
        self.capture = cv2.VideoCapture(SOURCE)
        self.create_timer(0.05, self.grab)

    def grab(self):
        ok, frame = self.capture.read()


rclpy.init()
rclpy.spin(Camera())
"""


def unit_of(source: str) -> Spec:
    (unit,) = scan_text(PROGRAM.replace('SOURCE', source)).units
    return unit


def waits_of(unit: Spec) -> tuple[Blocking, ...]:
    return next(callback for callback in unit.callbacks if callback.name == 'grab').blocking


@pytest.mark.parametrize(
    'source', ['0', 'index()', "'/dev/video2'", "'rtsp://eye/1'", "'v4l2src ! appsink'"]
)
def test_a_read_of_a_camera_is_in_the_specification_and_no_finding(source: str) -> None:
    unit = unit_of(source)
    (wait,) = waits_of(unit)
    assert (wait.call, wait.wakers) == ('VideoCapture.read', (Waker(by=TIME),))
    assert not [found for found in findings_of_unit(unit, None) if found.code < 'CC3']


def test_a_read_of_a_file_is_no_wait() -> None:
    assert waits_of(unit_of("'record.mp4'")) == ()


def test_frames_of_a_pipeline_come_or_the_wait_for_them_gives_up() -> None:
    text = PROGRAM.replace('import cv2', 'import pyrealsense2 as rs')
    text = text.replace('cv2.VideoCapture(SOURCE)', 'rs.pipeline()')
    (unit,) = scan_text(text.replace('ok, frame = self.capture.read()', FRAMES)).units
    (wait,) = waits_of(unit)
    assert (wait.call, wait.wakers) == ('pipeline.wait_for_frames', (Waker(by=TIME),))


FRAMES = 'frames = self.capture.wait_for_frames()'
