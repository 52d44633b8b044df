# SPDX-License-Identifier: Apache-2.0
"""Scripted language model server for tests."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
import json
import threading
from typing import Any

GOOD = {'steps': [{'skill': 'go_to', 'arguments': {'target': 'hall'}}], 'refusal': None}
Answer = tuple[int, Any]
"""A status, and the body: an object sent as JSON, a text, or a function that yields chunks."""


def says(content: Any) -> Answer:
    """
    Build the answer of a model that writes some content.

    Parameters
    ----------
    content
        The content: a text, or an object, which becomes JSON.

    Returns
    -------
    Answer
        Status 200, and a chat completion with one choice, as in the OpenAI API.

    """
    text = content if isinstance(content, str) else json.dumps(content)
    return 200, {'choices': [{'message': {'role': 'assistant', 'content': text}}]}


class ModelStub:
    """
    Scripted answers of a server, and a record of its requests.

    Parameters
    ----------
    *answers
        The answers, in order; a function is called with the request.

    """

    def __init__(self, *answers: Answer | Callable[[dict[str, Any]], Answer]) -> None:
        self.answers = list(answers)
        self.asked: list[dict[str, Any]] = []
        self.headers: list[dict[str, str]] = []
        self.models = ['small-model']
        self.url = ''

    def answer(self, request: dict[str, Any]) -> Answer:
        """
        Record a request, and return the next answer; the last one is repeated.

        Parameters
        ----------
        request
            The body of the request, decoded from JSON; an answer may be a function of it.

        """
        self.asked.append(request)
        given = self.answers.pop(0) if len(self.answers) > 1 else self.answers[0]
        return given(request) if callable(given) else given


@contextmanager
def serving(stub: ModelStub) -> Iterator[ModelStub]:
    """
    Serve the answers of a stub over HTTP on a free port of 127.0.0.1.

    Parameters
    ----------
    stub
        The source of the answers; its `url` is set.

    Yields
    ------
    ModelStub
        The same stub, while the server runs.

    """
    over = threading.Event()

    class Handler(BaseHTTPRequestHandler):
        """Request handler that returns the answers of the stub."""

        def do_GET(self) -> None:
            """List the models."""
            self._send(200, {'data': [{'id': name} for name in stub.models]})

        def do_POST(self) -> None:
            """Answer a chat completion request."""
            length = int(self.headers['Content-Length'])
            stub.headers.append(dict(self.headers))
            status, content = stub.answer(json.loads(self.rfile.read(length)))
            self._send(status, content)

        def _send(self, status: int, content: Any) -> None:
            self.send_response(status)
            if status in (301, 302):
                self.send_header('Location', '/elsewhere')
            self.end_headers()
            if isinstance(content, str):
                self.wfile.write(content.encode())
            elif isinstance(content, (dict, list)):
                self.wfile.write(json.dumps(content).encode())
            else:
                try:
                    for part in content(over):
                        self.wfile.write(part)
                        self.wfile.flush()
                except OSError:
                    return

        def log_message(self, *_: Any) -> None:
            """Suppress logging."""

    server = ThreadingHTTPServer(('127.0.0.1', 0), Handler)
    server.daemon_threads = True
    threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
    stub.url = f'http://127.0.0.1:{server.server_port}/v1'
    try:
        yield stub
    finally:
        over.set()
        server.shutdown()
        server.server_close()
