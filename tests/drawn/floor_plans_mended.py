"""Floor plans: a planner loads the latched plans of all floors before it takes orders."""
import threading
import time

import rclpy
from nav_msgs.msg import OccupancyGrid
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.wait_for_message import wait_for_message

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
FLOORS = 12


class Archive(Node):

    def __init__(self):
        super().__init__('archive')
        self.pubs = [
            self.create_publisher(OccupancyGrid, f'plan_{floor}', LATCHED)
            for floor in range(FLOORS)
        ]
        for pub in self.pubs:
            pub.publish(OccupancyGrid())


class Planner(Node):

    def __init__(self):
        super().__init__('planner')
        self.plans = []
        self.create_timer(0.5, self.report)

    def load(self):
        reader = rclpy.create_node('plan_reader')
        for floor in range(FLOORS):
            _, plan = wait_for_message(
                OccupancyGrid, reader, f'plan_{floor}', qos_profile=LATCHED, time_to_wait=5.0
            )
            self.plans.append(plan)
        reader.destroy_node()
        missing = self.plans.count(None)
        print(f'{FLOORS} plans, {missing} missing', flush=True)

    def report(self):
        self.get_logger().info(f'{len(self.plans)} plans')


def spin(executor):
    try:
        executor.spin()
    except ExternalShutdownException:
        pass


def main():
    rclpy.init()
    planner = Planner()
    executor = SingleThreadedExecutor()
    executor.add_node(planner)
    executor.add_node(Archive())
    spinner = threading.Thread(target=spin, args=(executor,), daemon=True)
    spinner.start()
    time.sleep(0.5)
    planner.load()
    rclpy.try_shutdown()
    spinner.join()


if __name__ == '__main__':
    main()
