"""
``import ros2cc_extract.live`` as the first line of a node records what its executors hold.

The recording goes into the folder that the environment variable ``ROS2CC_LIVE_DIR`` names, else
into the current directory; ``ros2cc-extract`` reads it. Needs nothing but the standard library,
so it works in a node's environment where the tool's dependencies are missing.
"""

from __future__ import annotations

import os
import sys

from ros2cc_extract.extract.live.hook.wrapping import OUTPUT_VARIABLE, install

# The process may have been started with the hook already; it must not be there twice.
if '_ros2cc_live' not in sys.modules:
    install(os.environ.get(OUTPUT_VARIABLE) or os.curdir)
