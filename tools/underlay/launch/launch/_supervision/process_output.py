# SPDX-License-Identifier: Apache-2.0
"""Logging of the output of a process."""

from __future__ import annotations

from collections import deque
from typing import Any

from launch._supervision.line_format import LineFormat
from launch._supervision.line_splitter import LineSplitter
from launch.logging import get_output_loggers, launch_config
from launch.logging._output import is_on_screen
from launch.logging._screen import screen

_STREAMS = (1, 2)
_LAST_LINES = 20


class ProcessOutput:
    """
    Logger of the output lines of a process, which optionally caches the text.

    Parameters
    ----------
    label
        The label of the process, by which its loggers and log files are named.
    config
        Where the output goes, as for `normalize_output_config`.
    line_format
        The format of its lines.
    keep
        Whether the text is cached for `kept`.

    Raises
    ------
    ValueError
        The configuration is not valid.

    """

    def __init__(
        self,
        label: str,
        config: Any,
        line_format: LineFormat,
        *,
        keep: bool,
    ) -> None:
        self._loggers = dict(zip(_STREAMS, get_output_loggers(label, config)))
        self._splitters = {stream: LineSplitter() for stream in _STREAMS}
        self._line_format = line_format
        self._keep = keep
        self._kept: dict[int, list[bytes]] = {stream: [] for stream in _STREAMS}
        self._unseen: deque[str] = deque(maxlen=_LAST_LINES)
        self._is_seen = {stream: is_on_screen(self._loggers[stream]) for stream in _STREAMS}

    def feed(self, stream: int, data: bytes) -> None:
        """
        Process bytes from an output stream, and log the lines that they complete.

        Parameters
        ----------
        stream
            1 for the standard output, 2 for the standard error.
        data
            The next bytes of the stream.

        """
        if self._keep:
            self._kept[stream].append(data)
        self._log(stream, self._splitters[stream].feed(data))

    def flush(self) -> None:
        """Log the text after the last line break."""
        for stream, splitter in self._splitters.items():
            self._log(stream, splitter.flush())

    def show_last_lines(self) -> None:
        """Show the last output lines that were logged, but not shown on the screen."""
        for line in self._unseen:
            screen.write_line(f'    {line}')
        self._unseen.clear()

    def kept(self, stream: int) -> str:
        """
        Return the cached text of an output stream; empty if it is not cached.

        Parameters
        ----------
        stream
            1 for the standard output, 2 for the standard error.

        """
        return b''.join(self._kept[stream]).decode('utf-8', 'replace')

    def _log(self, stream: int, lines: list[str]) -> None:
        lines = launch_config.lost_files.without_errors(lines)
        if not lines:
            return
        text = self._line_format.apply(lines)
        self._loggers[stream].info('%s', text)
        if not self._is_seen[stream]:
            self._unseen.extend(text.split('\n')[-_LAST_LINES:])
