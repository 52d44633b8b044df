# SPDX-License-Identifier: Apache-2.0
"""What a browser may ask for."""

from __future__ import annotations

from collections.abc import Callable
import json
from typing import Any

import pytest
from rviz_common.page import Page
from rviz_common.visualizer import Visualizer
import websockets.sync.client

JSON = Any


@pytest.fixture
def ask(page: Page, show: Callable[..., Visualizer], spin_until: Any) -> Callable[..., JSON]:
    """Return what sends a message to the small page, and returns the answer."""
    show('Panels: []')
    path = next(each for each in page.routes._by_path if each.startswith('/look/'))

    def ask(**message: JSON) -> JSON:
        answers: list[JSON] = []
        with websockets.sync.client.connect(f'ws://127.0.0.1:{page.port}{path}') as socket:
            socket.send(json.dumps(message))

            def has_come() -> bool:
                try:
                    answers.append(json.loads(socket.recv(timeout=0.05)))
                except TimeoutError:
                    return False
                return True

            spin_until(has_come, 'an answer')
        return answers[0]

    return ask


@pytest.mark.parametrize('viewer', [None, 12345, 'me', [1], {}])
def test_a_browser_that_has_gone_is_told_so(ask: Callable[..., JSON], viewer: JSON) -> None:
    """Whatever it says that it is."""
    for do in ('theme', 'quality', 'rate'):
        assert 'Reload it' in ask(do=do, viewer=viewer)['refusal']
