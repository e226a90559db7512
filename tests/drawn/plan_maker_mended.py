"""Plan node: a plan for each request, made in another process."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

from helper_12_cruncher_mended import Cruncher


class PlanNode(Node):
    """Plans on demand."""

    def __init__(self):
        super().__init__('plan_node')
        self.cruncher = Cruncher()
        self.create_service(Trigger, 'plan', self.on_plan)
        self.alive = self.create_publisher(Empty, 'alive', 1)
        self.create_timer(0.1, self.on_tick)

    def on_tick(self):
        self.alive.publish(Empty())

    def on_plan(self, _request, response):
        self.cruncher.run()
        response.success = True
        return response


def main():
    rclpy.init()
    node = PlanNode()
    try:
        rclpy.spin(node)
    finally:
        node.destroy_node()


if __name__ == '__main__':
    main()
