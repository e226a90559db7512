"""Ends by os._exit as soon as the recording in the folder given says that its timer has run."""

import json
import os
import sys
from pathlib import Path

import rclpy

folder = Path(sys.argv[1])


def look() -> None:
    recordings = [json.loads(path.read_text()) for path in folder.glob('*.json')]
    if any(entity['measured']['count'] for each in recordings for entity in each['entities']):
        os._exit(3)


rclpy.init()
node = rclpy.create_node('left_behind')
node.create_timer(0.01, look)
rclpy.spin(node)
