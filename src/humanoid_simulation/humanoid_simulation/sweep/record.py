# SPDX-License-Identifier: Apache-2.0
"""The record of a sweep: finished runs, one a line, which survives every kind of end."""

from __future__ import annotations

from collections.abc import Sequence
import contextlib
from dataclasses import asdict
from datetime import datetime, timezone
import errno
import fcntl
import json
import os
from pathlib import Path
from types import TracebackType
from typing import Any

from humanoid_simulation.errors import SimulationError
from humanoid_simulation.sweep.conditions import Run, values_to_store
from humanoid_simulation.sweep.results import Crash, FinishedRun, RunResult

NAME = 'runs.jsonl'
_LONGEST_LINE = 1_000_000
"""In bytes; a line has about a thousandth of that."""


class Record:
    """
    Append-only file of finished runs; each line is on the disk before the next run counts.

    One process at a time may open it. A last line that was cut off, as by kill -9 or a full disk,
    is removed: that run is done again.

    Parameters
    ----------
    folder
        The folder of the sweep, which is created if necessary.

    Attributes
    ----------
    finished
        Finished runs by version of the code and key.
    crashes
        Crashes, in order; the runs may have been finished later.

    Raises
    ------
    SimulationError
        The file cannot be read or written, is damaged, or is open in another process.

    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / NAME
        try:
            self._new_folders = [each for each in (folder, *folder.parents) if not each.exists()]
            folder.mkdir(parents=True, exist_ok=True)
            self._file = os.open(self._path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
            _sync_folder(folder)
        except OSError as error:
            raise self._error(error) from error
        try:
            self._lock()
            self._cut_off_torn_line()
        except BaseException:
            os.close(self._file)
            raise
        self.finished, self.crashes = read_record(self._path)

    def __enter__(self) -> Record:
        """Return the record, which is closed at the end of the block."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the file, so that another process may open it."""
        os.close(self._file)

    def remove_if_empty(self) -> bool:
        """Delete a record without any entry, and the folders that were created for it."""
        if self.finished or self.crashes:
            return False
        with contextlib.suppress(OSError):  # such as a folder with something else in it
            self._path.unlink()
            for folder in self._new_folders:
                folder.rmdir()
        return True

    def left(self, runs: Sequence[Run], version: str) -> list[Run]:
        """
        List the runs that are not finished yet, in order.

        Parameters
        ----------
        runs
            All runs.
        version
            Version of the code; runs that another one finished do not count.

        """
        return [run for run in runs if (version, run.key) not in self.finished]

    def of(self, runs: Sequence[Run], version: str) -> list[FinishedRun]:
        """
        List the finished ones of some runs, in order.

        Parameters
        ----------
        runs
            The runs.
        version
            Version of the code that finished them.

        """
        keys = [(version, run.key) for run in runs]
        return [self.finished[key] for key in keys if key in self.finished]

    def add(self, run: Run, version: str, result: RunResult) -> FinishedRun:
        """
        Record a finished run; on return, it is on the disk.

        Parameters
        ----------
        run, result
            The run and its result.
        version
            Version of the code.

        Returns
        -------
        FinishedRun
            The entry of the record.

        Raises
        ------
        SimulationError
            It cannot be written.

        """
        now = datetime.now(timezone.utc).isoformat(timespec='seconds')
        conditions = values_to_store(run.conditions)
        entry = FinishedRun(version, run.key, conditions, result, now)
        self._append(asdict(entry))
        self.finished[version, run.key] = entry
        return entry

    def add_crash(self, run: Run, version: str, attempt: int, reason: str) -> None:
        """
        Record that the process of a run crashed.

        Parameters
        ----------
        run
            The run.
        version
            Version of the code.
        attempt
            Which attempt it was, from 1 on.
        reason
            What is known about the cause.

        Raises
        ------
        SimulationError
            It cannot be written.

        """
        crash = Crash(version, run.key, values_to_store(run.conditions), attempt, reason)
        self._append(asdict(crash))
        self.crashes.append(crash)

    def _append(self, entry: dict[str, Any]) -> None:
        """Write a line, and wait until it is on the disk."""
        line = json.dumps(entry, separators=(',', ':')).encode() + b'\n'
        before = os.fstat(self._file).st_size
        try:
            if os.write(self._file, line) < len(line):
                os.ftruncate(self._file, before)
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            os.fsync(self._file)
        except OSError as error:
            raise self._error(error) from error

    def _lock(self) -> None:
        """Reserve the file for this process; the lock ends with it."""
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if os.fstat(self._file).st_nlink == 0:
                raise BlockingIOError(errno.EAGAIN, 'another sweep has just removed it')
        except BlockingIOError as error:
            raise SimulationError(
                f'Another sweep is writing to {self._path}. Wait for it or stop it, or give '
                'another --output.'
            ) from error

    def _cut_off_torn_line(self) -> None:
        """Remove an incomplete last line."""
        start = max(os.fstat(self._file).st_size - _LONGEST_LINE, 0)
        end = os.pread(self._file, _LONGEST_LINE, start)
        if end and not end.endswith(b'\n'):
            os.ftruncate(self._file, start + end.rfind(b'\n') + 1)
            os.fsync(self._file)

    def _error(self, error: OSError) -> SimulationError:
        """Create the error for a file that cannot be written."""
        return SimulationError(f'{self._path} cannot be written: {error.strerror}.')


def read_record(path: Path) -> tuple[dict[tuple[str, str], FinishedRun], list[Crash]]:
    """
    Read the record of a sweep.

    Parameters
    ----------
    path
        The file; an incomplete last line is ignored.

    Returns
    -------
    dict, list
        Finished runs by version and key, and crashes.

    Raises
    ------
    SimulationError
        The file cannot be read, or a line of it is damaged.

    """
    finished: dict[tuple[str, str], FinishedRun] = {}
    crashes: list[Crash] = []
    try:
        with path.open(encoding='utf-8') as stream:
            for number, line in enumerate(stream, 1):
                if not line.endswith('\n'):
                    break
                entry = _entry(line, f'{path}, line {number}')
                if isinstance(entry, Crash):
                    crashes.append(entry)
                else:
                    finished[entry.version, entry.key] = entry
    except (OSError, UnicodeDecodeError) as error:
        raise SimulationError(f'{path} cannot be read: {error}.') from error
    return finished, crashes


def _entry(line: str, place: str) -> FinishedRun | Crash:
    """Parse a line of a record, or raise SimulationError with its place."""
    try:
        content = json.loads(line)
        if 'reason' in content:
            return Crash(**content)
        return FinishedRun(**content | {'result': RunResult(**content['result'])})
    except (ValueError, TypeError, KeyError) as error:
        raise SimulationError(
            f'{place}, is damaged. Delete that line: its run is then done again.'
        ) from error


def find_run(path: Path, key: str) -> FinishedRun:
    """
    Find a finished run by its key; of several versions, the last one counts.

    Parameters
    ----------
    path
        The record of a sweep.
    key
        The key, or its first digits.

    Raises
    ------
    SimulationError
        The record cannot be read, or no run or several ones have a key that begins like that.

    """
    found = [run for run in read_record(path)[0].values() if run.key.startswith(key)]
    keys = {run.key for run in found}
    if not key or not keys:
        raise SimulationError(
            f"No finished run of {path} has a key that begins with '{key}'. The report lists the "
            'keys.'
        )
    if len(keys) > 1:
        raise SimulationError(
            f"{len(keys)} runs have a key that begins with '{key}', such as "
            f'{", ".join(sorted(keys)[:2])}. Give more digits.'
        )
    return found[-1]


def _sync_folder(folder: Path) -> None:
    """Wait until the entries of a folder are on the disk."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
