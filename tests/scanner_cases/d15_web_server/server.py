"""Point 28: routes of another file, over helpers of a third one, on the node of the program."""

from fastapi import FastAPI
from panel.ros import get_node
from panel.routes import router

app = FastAPI()
app.include_router(router)


def tick():
    pass


def main():
    get_node().create_timer(1.0, tick)


if __name__ == '__main__':
    main()
