"""Point 15: entities on an object of a class that is no node: reported, without a unit."""
# live: no, it raises

from std_msgs.msg import String


class Filter:
    def __init__(self):
        self.gain = 1.0


class FilterNode(Filter):
    def __init__(self):
        super().__init__()
        self.create_subscription(String, 'in', self.on_msg, 10)

    def on_msg(self, msg):
        pass


def main():
    import rclpy

    rclpy.init()
    FilterNode()

# expect:
# warning not-followed @15
