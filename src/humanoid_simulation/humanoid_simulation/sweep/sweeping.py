# SPDX-License-Identifier: Apache-2.0
"""Do the runs of an experiment that are left, record them, and report."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
import time

from humanoid_simulation.sweep import report
from humanoid_simulation.sweep.engine import Crashed, Done, Engine, Notice
from humanoid_simulation.sweep.experiment import Experiment
from humanoid_simulation.sweep.progress import falls_text, progress_line
from humanoid_simulation.sweep.record import Record
from humanoid_simulation.sweep.report import Report
from humanoid_simulation.sweep.results import FinishedRun, Summary


class Sweep:
    """
    The runs of an experiment, of which those that are left are done and recorded.

    Parameters
    ----------
    experiment
        The experiment.
    record
        Where finished runs are recorded.
    version
        Version of the code that does them.
    say
        Called with a line about the progress, and whether it is the last one.

    Attributes
    ----------
    summary
        Summary of the finished runs of the experiment.
    crashed
        Keys of runs whose process crashed in every attempt.

    """

    def __init__(
        self,
        experiment: Experiment,
        record: Record,
        version: str,
        say: Callable[[str, bool], None],
    ) -> None:
        self._experiment, self._record, self._version = experiment, record, version
        self._say = say
        self.summary = Summary.of(self._finished)
        self.crashed: list[str] = []

    @property
    def everything(self) -> list[FinishedRun]:
        """Return all finished runs of the record, also of other versions and conditions."""
        return [*self._record.finished.values()]

    def run(self, engine: Engine) -> None:
        """
        Do the runs that are left, and record each as soon as it is finished.

        Parameters
        ----------
        engine
            Does the runs.

        Raises
        ------
        SimulationError
            A run cannot be recorded, or the engine cannot go on.

        """
        runs = self._experiment.runs
        left = self._record.left(runs, self._version)
        done = len(runs) - len(left)
        self._say(f'{done} of {len(runs)} runs are finished already, {len(left)} are left', True)
        begin_s, outcomes = time.monotonic(), engine.outcomes(left)
        try:
            for outcome in outcomes:
                if isinstance(outcome, Notice):
                    self._say(outcome.sentence, True)
                    continue
                self._note(outcome)
                self._tell(len(left), time.monotonic() - begin_s)
        finally:
            outcomes.close()  # ends what runs

    def report(self, replay_command: str) -> Report:
        """
        Return the report of what is finished.

        Parameters
        ----------
        replay_command
            The command that shows a run, without its key.

        """
        finished = self._finished
        keys = {run.key for run in self._experiment.runs} - {run.key for run in finished}
        return Report(
            self._experiment.name,
            self._version,
            len(self._experiment.runs),
            self._experiment.varied,
            finished,
            [
                crash
                for crash in self._record.crashes
                if crash.version == self._version and crash.key in keys
            ],
            len(self._record.finished) - len(finished),
            replay_command,
        )

    def conclusion(self, folder: Path) -> str:
        """
        Describe the result in one line.

        Parameters
        ----------
        folder
            The folder of the sweep, which has the report.

        """
        summary = self.summary
        crashed = (
            f'; {len(self.crashed)} crashed twice and are not finished' if self.crashed else ''
        )
        return (
            f'{summary.stood} of {summary.finished} stood, {falls_text(summary)}{crashed}; '
            f'{summary.simulated_s:.0f} s in {summary.cpu_s:.0f} s of CPU, '
            f'{summary.distance_m:.0f} m. Report: {folder / report.NAME}'
        )

    @property
    def _finished(self) -> list[FinishedRun]:
        """Return the finished runs of the experiment."""
        return self._record.of(self._experiment.runs, self._version)

    def _note(self, outcome: Done | Crashed) -> None:
        """Record what has become of a run."""
        if isinstance(outcome, Done):
            entry = self._record.add(outcome.run, self._version, outcome.result)
            self.summary = self.summary.including(entry)
            return
        self._record.add_crash(outcome.run, self._version, outcome.attempt, outcome.reason)
        again = 'it is not tried again' if outcome.is_final else 'it is tried once more'
        self._say(f'Run {outcome.run.key} crashed: {outcome.reason}; {again}', True)
        if outcome.is_final:
            self.crashed.append(outcome.run.key)

    def _tell(self, to_do: int, elapsed_s: float) -> None:
        """Say how far the sweep is."""
        planned = len(self._experiment.runs)
        left = planned - self.summary.finished - len(self.crashed)
        line = progress_line(self.summary, planned, to_do - left, left, elapsed_s)
        self._say(line, left == 0)
