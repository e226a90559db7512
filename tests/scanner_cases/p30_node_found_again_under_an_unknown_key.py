"""P30: a node that was just put under an unknown key of a dictionary is taken from there."""
# live: no, somebody outside the program calls the method that makes the second node

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Drone(Node):
    def __init__(self, name):
        super().__init__('drone')
        self.create_timer(0.1, self.fly)

    def fly(self):
        pass


class Tower(Node):
    def __init__(self):
        super().__init__('tower')
        self.drones = {}
        self.create_timer(1.0, self.look)

    def look(self):
        pass

    def connected(self, link):
        if link not in self.drones:
            drone = Drone(link)
            self.drones[link] = drone
            self.serve(self.drones[link])

    def serve(self, node):
        own = SingleThreadedExecutor()
        own.add_node(node)
        threading.Thread(target=own.spin, daemon=True).start()


def main():
    rclpy.init()
    rclpy.spin(Tower())


# expect:
# unit tower: SingleThreadedExecutor x1 rclpy.spin, main
#   group tower_default EXCLUSIVE default
#   timer look in tower_default every 1
# unit drone: own=SingleThreadedExecutor x1 spin in thread, main
#   group drone_default EXCLUSIVE default
#   timer fly in drone_default every 0.1 when=later
