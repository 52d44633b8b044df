# SPDX-License-Identifier: Apache-2.0
"""The base class of the events of a process that runs or has run."""

from __future__ import annotations

from typing import Optional, TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal


class RunningProcessEvent(Event):
    """
    Base class of events about a process that runs or has run.

    Parameters
    ----------
    action
        The action that started the process.
    name
        The label of the process, with its number.
    cmd
        The command line, as a list of words.
    cwd
        The working directory of the process; None for that of the launch.
    env
        The environment that the process was started with.
    pid
        The id of the process.

    """

    name = 'launch.events.process.RunningProcessEvent'

    def __init__(
        self,
        *,
        action: ExecuteLocal,
        name: str,
        cmd: list[str],
        cwd: Optional[str],
        env: Optional[dict[str, str]],
        pid: int,
    ) -> None:
        self.__action = action
        self.__name = name
        self.__cmd = cmd
        self.__cwd = cwd
        self.__env = env
        self.__pid = pid

    @property
    def action(self) -> ExecuteLocal:
        """Return the action that started the process."""
        return self.__action

    @property
    def execute_process_action(self) -> ExecuteLocal:
        """Return the action that started the process (the older name)."""
        return self.__action

    @property
    def process_name(self) -> str:
        """Return the label of the process."""
        return self.__name

    @property
    def cmd(self) -> list[str]:
        """Return the command line."""
        return self.__cmd

    @property
    def cwd(self) -> Optional[str]:
        """Return the working directory of the process; None for that of the launch."""
        return self.__cwd

    @property
    def env(self) -> Optional[dict[str, str]]:
        """Return the environment that the process was started with."""
        return self.__env

    @property
    def pid(self) -> int:
        """Return the process id."""
        return self.__pid
