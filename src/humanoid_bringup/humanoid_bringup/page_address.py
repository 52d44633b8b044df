# SPDX-License-Identifier: Apache-2.0
"""Log the address of the page again after startup, so that it is the last output."""

from __future__ import annotations

import re
from typing import Optional

from launch import Action
from launch.actions import LogInfo, TimerAction
from launch.event_handlers import OnProcessIO
from launch.events.process import ProcessIO

ADDRESS = re.compile(r'RViz is at (http\S+)\s')
ROBOT = re.compile(r'(Simulator|Mock robot) started')
SETTLE_S = 2.0
"""Delay after which other nodes have logged their startup messages."""
_LONGEST = 4096


class Startup:
    """Detects in the output of processes that the robot and its page have started."""

    def __init__(self) -> None:
        self._written: dict[str, str] = {}
        self._url: str | None = None
        self._has_robot = self._is_over = False

    def hear(self, process: str, text: str) -> Optional[str]:
        """
        Search the output of a process, in pieces of any size.

        Parameters
        ----------
        process
            The name of the process.
        text
            Its output since the last call.

        Returns
        -------
        Optional[str]
            The address of the page, once, when the robot has started as well; otherwise None.

        """
        if self._is_over:
            return None
        written = self._written[process] = (self._written.get(process, '') + text)[-_LONGEST:]
        found = ADDRESS.search(written)
        self._url = found[1] if found else self._url
        self._has_robot |= ROBOT.search(written) is not None
        self._is_over = self._has_robot and self._url is not None
        return self._url if self._is_over else None


def announce_page() -> OnProcessIO:
    """Build the event handler that logs the page address once robot and page have started."""
    startup = Startup()

    def hear(event: ProcessIO) -> Optional[list[Action]]:
        url = startup.hear(event.process_name, event.text.decode(errors='replace'))
        if url is None:
            return None
        return [TimerAction(period=SETTLE_S, actions=[LogInfo(msg=announcement(url))])]

    return OnProcessIO(on_stdout=hear, on_stderr=hear)


def announcement(url: str) -> str:
    """
    Format the lines that show the address of the page.

    Parameters
    ----------
    url
        The address of the page.

    """
    sentence = f'Open {url} to see and drive the robot.'
    line = '-' * len(sentence)
    return f'\n{line}\n{sentence}\n{line}'
