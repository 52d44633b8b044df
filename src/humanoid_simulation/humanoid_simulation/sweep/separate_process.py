# SPDX-License-Identifier: Apache-2.0
"""Let an engine work in a process of its own: its libraries may end that one, but not this one."""

from __future__ import annotations

from _thread import interrupt_main
from collections.abc import Sequence
import contextlib
from dataclasses import dataclass
from multiprocessing.connection import Connection
import os
from pathlib import Path
import signal
import sys
import threading
import time
from typing import TYPE_CHECKING

from humanoid_simulation import processes
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.sweep import ENVIRONMENT
from humanoid_simulation.sweep.engine import Engine, Notice, Outcomes

if TYPE_CHECKING:  # processes of tests need not import the walk
    from humanoid_simulation.sweep.conditions import Run

_CLEARING_S = 10.0
"""How long an engine is given to end what it has begun."""


@dataclass(frozen=True)
class _Problem:
    """Why the engine cannot go on."""

    sentence: str


class SeparateProcess:
    """
    Engine that lets another one work in a process of its own.

    If that process ends, however it does, this one raises an error. If this one ends, that one
    closes the outcomes of its engine, which ends all work.

    Parameters
    ----------
    engine
        The other engine, which is sent to the process.
    name
        What is lost with the process, for the error.
    log
        The file for all that the engine and its libraries print. It is removed if the engine
        raises an error before the first outcome of a run.

    """

    def __init__(self, engine: Engine, name: str, log: Path) -> None:
        self._engine, self._name, self._log = engine, name, log

    def outcomes(self, runs: Sequence[Run]) -> Outcomes:
        """
        Let the engine do the runs, see `Engine.outcomes`.

        Parameters
        ----------
        runs
            The runs to do.

        Raises
        ------
        SimulationError
            The engine has raised it, or its process has ended.

        """
        connection, theirs = processes.CONTEXT.Pipe()
        process = processes.start(_serve, (theirs, self._engine, self._log), ENVIRONMENT)
        theirs.close()
        try:
            try:
                connection.send([*runs])
                has_outcome = False
                while (answer := connection.recv()) is not None:
                    if isinstance(answer, _Problem):
                        if not has_outcome:  # what libraries printed has led to nothing
                            self._log.unlink(missing_ok=True)
                        raise SimulationError(answer.sentence)
                    has_outcome |= not isinstance(answer, Notice)
                    yield answer
            except (EOFError, OSError) as error:
                raise SimulationError(
                    f'{self._name} can no longer be reached: the process connected to it '
                    f'{processes.ending_text(process)}; {self._log} has its last output. Finished '
                    'runs are kept: bring it back, and give the same command again.'
                ) from error
        finally:
            connection.close()
            process.join(_CLEARING_S + processes.PATIENCE_S)
            processes.end(process)


def _serve(connection: Connection, engine: Engine, log: Path) -> None:
    """Do runs, and send what becomes of them, until all are done or the connection is closed."""
    os.setsid()  # Ctrl-C reaches all processes of a terminal
    signal.signal(signal.SIGINT, signal.default_int_handler)
    processes.let_signals_through()
    with log.open('w') as stream:
        os.dup2(stream.fileno(), sys.stdout.fileno())
        os.dup2(stream.fileno(), sys.stderr.fileno())
    with contextlib.suppress(KeyboardInterrupt, EOFError, OSError):
        runs = connection.recv()
        threading.Thread(target=_end_with, args=(connection,), daemon=True).start()
        try:
            with contextlib.closing(engine.outcomes(runs)) as outcomes:
                for outcome in outcomes:
                    connection.send(outcome)
            connection.send(None)
        except SimulationError as error:
            connection.send(_Problem(str(error)))


def _end_with(connection: Connection) -> None:
    """Interrupt the engine when the connection is closed, and end this process soon after."""
    with contextlib.suppress(EOFError, OSError):
        connection.recv()
    interrupt_main()
    time.sleep(_CLEARING_S)
    os._exit(1)
