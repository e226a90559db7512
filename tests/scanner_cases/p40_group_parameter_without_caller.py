"""P40, point 7: no known caller: the group is unresolved, never the default one."""
# live: no, nobody makes the helper

import rclpy


class Helper:
    def __init__(self, node, group=None):
        node.create_timer(1.0, self.tick, callback_group=group)

    def tick(self):
        pass

# expect:
# unit node: no executor
#   group unresolved_1 EXCLUSIVE UNRESOLVED
#   timer tick in unresolved_1 every 1 node=?
#   ? tick node
#   ? unresolved_1 group
#   ? executor executor
