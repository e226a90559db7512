"""P22: a name from a parameter of nobody: unresolved, named after the class."""
# live: no, nobody makes the node

from rclpy.node import Node


class RobotArm(Node):
    def __init__(self, number):
        super().__init__(f'arm_{number}')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass

# expect:
# unit robot_arm: no executor
#   group robot_arm_default EXCLUSIVE default
#   timer tick in robot_arm_default every 0.5
#   ? executor executor
#   ? robot_arm node_name
