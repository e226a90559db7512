from desk.parts.base import Part
from std_msgs.msg import Bool


class Lamp(Part):
    def __init__(self, node):
        super().__init__(node)
        self.listen('lamp', Bool)

    def heard(self, msg):
        pass
