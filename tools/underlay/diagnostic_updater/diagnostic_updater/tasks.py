# SPDX-License-Identifier: Apache-2.0
"""Diagnostic tasks, of which each fills in a status."""

from __future__ import annotations

from collections.abc import Callable
from threading import RLock
from typing import Any

from diagnostic_updater.status_wrapper import DiagnosticStatusWrapper

__all__ = [
    'CompositeDiagnosticTask',
    'DiagnosticTask',
    'DiagnosticTaskVector',
    'FunctionDiagnosticTask',
    'Report',
]

Report = Callable[[DiagnosticStatusWrapper], DiagnosticStatusWrapper]
"""What a task does: it fills in the status that it is given, and returns it."""


class DiagnosticTask:
    """
    A diagnostic task; derived classes have a method `run`.

    Parameters
    ----------
    name
        The name of the task.

    """

    def __init__(self, name: str) -> None:
        self.name = name

    def getName(self) -> str:  # noqa: N802
        """The name of the task."""
        return self.name

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """
        Fill in a status.

        Parameters
        ----------
        stat
            The status.

        Returns
        -------
        DiagnosticStatusWrapper
            The same status.

        """
        raise NotImplementedError(f'The diagnostic task {self.name!r} has no method run')


class FunctionDiagnosticTask(DiagnosticTask):
    """
    A diagnostic task that calls a function.

    Parameters
    ----------
    name
        The name of the task.
    fn
        The function. It fills in the status that it is given, and returns it.

    """

    def __init__(self, name: str, fn: Report) -> None:
        super().__init__(name)
        self.fn = fn

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """
        Call the function.

        Parameters
        ----------
        stat
            The status to fill in.

        """
        return _filled_in(self.name, self.fn(stat))


class CompositeDiagnosticTask(DiagnosticTask):
    """
    Several diagnostic tasks with one status, whose levels and messages are merged.

    Parameters
    ----------
    name
        The name of them all.

    """

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.tasks: list[DiagnosticTask] = []

    def addTask(self, task: DiagnosticTask) -> None:  # noqa: N802
        """
        Add a task.

        Parameters
        ----------
        task
            The task, of which the name is not used.

        """
        self.tasks.append(task)

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """
        Run all tasks.

        Parameters
        ----------
        stat
            The status to fill in.

        """
        merged = DiagnosticStatusWrapper()
        for index, task in enumerate(self.tasks):
            stat.clearSummary()
            stat = _filled_in(task.getName(), task.run(stat))
            if index == 0:
                merged.summary(stat)
            else:
                merged.mergeSummary(stat)
        stat.summary(merged)
        return stat


class DiagnosticTaskVector:
    """The diagnostic tasks of a node; base of `Updater`."""

    def __init__(self) -> None:
        self.tasks: list[FunctionDiagnosticTask] = []
        self.lock = RLock()

    def add(self, *args: Any) -> None:
        """
        Add a task.

        Parameters
        ----------
        *args
            A task, or a name and a function that fills in the status that it is given and returns
            it.

        Raises
        ------
        TypeError
            It is neither.

        """
        if len(args) == 1 and isinstance(args[0], DiagnosticTask):
            task = FunctionDiagnosticTask(args[0].getName(), args[0].run)
        elif len(args) == 2 and isinstance(args[0], str) and callable(args[1]):
            task = FunctionDiagnosticTask(*args)
        else:
            raise TypeError('add takes a DiagnosticTask, or a name and a function')
        with self.lock:
            self.tasks.append(task)
        self.addedTaskCallback(task)

    def addedTaskCallback(self, task: FunctionDiagnosticTask) -> None:  # noqa: N802
        """
        Do what derived classes do when a task has been added.

        Parameters
        ----------
        task
            The task.

        """

    def removeByName(self, name: str) -> bool:  # noqa: N802
        """
        Remove the first task with a name.

        Parameters
        ----------
        name
            The name.

        Returns
        -------
        bool
            Whether there was one.

        """
        with self.lock:
            for task in self.tasks:
                if task.name == name:
                    self.tasks.remove(task)
                    return True
        return False


def _filled_in(name: str, status: Any) -> DiagnosticStatusWrapper:
    if not isinstance(status, DiagnosticStatusWrapper):
        raise TypeError(
            f'The diagnostic task {name!r} returned {status!r}, but it must return the status '
            'that it was given'
        )
    return status
