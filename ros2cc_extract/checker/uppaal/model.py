"""Reads a model and its queries: from a file or text to what engines explore."""

from __future__ import annotations

from pathlib import Path

from ros2cc_extract.checker.network.network import Network
from ros2cc_extract.checker.uppaal.elaboration.elaborate import Elaboration, elaborate
from ros2cc_extract.checker.uppaal.files.document import read_document
from ros2cc_extract.checker.uppaal.files.query_file import (
    Query,
    clean,
    first_line,
    read_query_file,
)
from ros2cc_extract.errors import InputError, ModelFormatError
from ros2cc_extract.files import read_named
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

MOST_MODEL_BYTES = 64_000_000


@dataclass(frozen=True, eq=False)
class Model:
    """
    An elaborated model.

    :param queries: those stored in the XML.
    """

    name: str
    elaboration: Elaboration
    queries: tuple[Query, ...]

    @property
    def network(self) -> Network:
        """The network that engines see."""
        return self.elaboration.network()

    @property
    def processes(self) -> tuple[str, ...]:
        """Names of the processes in system order."""
        return tuple(process.name for process in self.network.processes)

    def process_index(self, name: str) -> int:
        """
        Return the position of a process in the system line.

        :raises InputError: there is no process of that name.
        """
        if name not in self.processes:
            known = ', '.join(self.processes[:8])
            what = f'there is no process {name!r}'
            raise InputError(what, Place(self.name), f'known are {known}')
        return self.processes.index(name)

    def template_of(self, name: str) -> str:
        """Return the template of a process."""
        return self.network.processes[self.process_index(name)].template


def load_model(path: Path) -> Model:
    """
    Read a model file.

    :raises InputError: the file cannot be read.
    :raises ModelFormatError: it is no model of the supported subset.
    """
    return _model(model_text(path), path.as_posix(), None)


def model_text(path: Path) -> bytes:
    """
    Read a model file as it is.

    :raises InputError: the file cannot be read.
    """
    return read_named(path, MOST_MODEL_BYTES, 'give a readable file')


def read_model(text: str, name: str) -> Model:
    """
    Read a model from text.

    :param name: file name for messages.
    :raises ModelFormatError: it is no model of the supported subset.
    """
    return _model(text.encode(), name, 'utf-8')


def _model(data: bytes, name: str, encoding: str | None) -> Model:
    document = read_document(data, name, encoding)
    try:
        elaboration = elaborate(document)
    except RecursionError:
        raise too_deep(name) from None
    queries = tuple(
        Query(
            clean(node.formula.value),
            node.comment,
            Place(name, first_line(node.formula.value, node.formula.line)),
        )
        for node in document.queries
    )
    return Model(name, elaboration, queries)


def read_queries(text: str, name: str) -> tuple[Query, ...]:
    """
    Read a query file.

    :raises ModelFormatError: a comment or query that is not complete, or no query.
    """
    return read_query_file(text, name)


def too_deep(name: str) -> ModelFormatError:
    """What is said of the model in file ``name`` where our own recursion comes to its end."""
    return ModelFormatError(
        'functions and expressions nest too deep',
        Place(name),
        'call fewer functions inside functions, or use variables for parts',
    )
