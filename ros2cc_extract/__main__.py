"""``python -m ros2cc_extract``: the command line, from any folder."""

import sys

# Python looks first in the current folder, where a foreign `yaml.py` or `ast.py` may be.
if not (sys.flags.isolated or getattr(sys.flags, 'safe_path', False)):
    del sys.path[0]

if __name__ == '__main__':
    from ros2cc_extract.cli.main import entry_point

    entry_point()
