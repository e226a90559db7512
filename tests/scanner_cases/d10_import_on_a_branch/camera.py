from std_msgs.msg import String


class Camera:
    def __init__(self, node):
        self.node = node

    def open(self):
        self._subscribe('image')

    def _subscribe(self, topic):
        self.node.create_subscription(String, topic, self.on_image, 10)

    def on_image(self, msg):
        pass
