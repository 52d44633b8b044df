# SPDX-License-Identifier: Apache-2.0
"""A browser that no longer answers is noticed, although its connection stays open."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest
from rviz_common.page import watchdog
from rviz_common.page.watchdog import serving, wait_until_lost
from websockets.exceptions import ConnectionClosedError


class Connection:
    """A connection that answers a number of pings."""

    def __init__(self, answers: int, is_closed: bool = False) -> None:
        """Begin to answer."""
        self.left, self._is_closed = answers, is_closed

    async def ping(self) -> asyncio.Future[float]:
        """Answer, or never; or fail as a closed connection does."""
        answer = asyncio.get_running_loop().create_future()
        self.left -= 1
        if self.left >= 0:
            answer.set_result(0.01)
        elif self._is_closed:
            raise ConnectionClosedError(None, None)
        return answer


async def lost(connection: Any) -> None:
    """Wait in a task that a connection has started, as those of callbacks are."""
    with serving(connection):
        task = asyncio.create_task(wait_until_lost(0.01))
    await task


@pytest.mark.parametrize('is_closed', [False, True])
def test_it_waits_as_long_as_there_are_answers(
    monkeypatch: pytest.MonkeyPatch, is_closed: bool
) -> None:
    """One that is closed does not answer either."""
    monkeypatch.setattr(watchdog, 'PERIOD_S', 0.0)
    connection = Connection(3, is_closed)
    asyncio.run(lost(connection))
    assert connection.left == -1


def test_without_a_browser_it_waits_forever() -> None:
    """What a program does is not ended."""

    async def main() -> bool:
        task = asyncio.create_task(wait_until_lost(0.01))
        done, _ = await asyncio.wait([task], timeout=0.05)
        task.cancel()
        return bool(done)

    assert not asyncio.run(main())
