class Part:
    def __init__(self, node):
        self.node = node

    def listen(self, topic, kind):
        self.node.create_subscription(kind, topic, self.heard, 10)
