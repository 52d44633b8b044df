# SPDX-License-Identifier: Apache-2.0
"""What is told of a process: its output, line by line, its start and its end."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from typing import Any, Optional, TYPE_CHECKING

from launch.events.process import ProcessExited, ProcessStarted, ProcessStderr, ProcessStdout
from launch.logging import get_logger, get_output_loggers, launch_config
from launch.logging._output import is_on_screen
from launch.logging._screen import screen

if TYPE_CHECKING:
    from launch._supervision.program import PerformedOptions, ProgramOwner
    from launch.launch_context import LaunchContext

_STREAMS = (1, 2)
_LAST_LINES = 20
_LONGEST = 1024 * 1024
"""Maximum length of a line in bytes; a longer one is split, as it may never end."""
_PLACE = '{line}'


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


class ProcessReport:
    """
    Reports the start, the output and the end of a process, in the log and as events.

    Parameters
    ----------
    action
        The action that runs the process.
    details
        The name, cmd, cwd and env of the process, to which its pid is added.
    options
        How the process is run.
    context
        The launch context, to which events are emitted.

    Attributes
    ----------
    output
        The logging of the output.
    pid
        The id of the process; 0 while none runs.

    """

    def __init__(
        self,
        action: ProgramOwner,
        details: dict[str, Any],
        options: PerformedOptions,
        context: LaunchContext,
    ) -> None:
        self._action = action
        self._details = details
        self._log_cmd = options.log_cmd
        self._context = context
        self._logger = get_logger(details['name'])
        self.output = ProcessOutput(
            details['name'],
            options.output,
            LineFormat(options.output_format, action),
            keep=options.cached_output,
        )
        self.pid = 0

    def start(self, pid: int) -> None:
        """
        Report the start of the process.

        Parameters
        ----------
        pid
            Its id.

        """
        self.pid = self._details['pid'] = pid
        if self._log_cmd:
            self._logger.info(
                "process details: cmd='%s', cwd='%s', custom_env?=%s",
                self._command_line(),
                self._details['cwd'],
                self._details['env'] is not None,
            )
        self._logger.info('process started with pid [%s]', pid)
        self._context.emit_event_sync(ProcessStarted(**self._event_details()))

    def feed(self, stream: int, data: bytes) -> None:
        """
        Log output, and emit its event if it is handled.

        Parameters
        ----------
        stream, data
            As for `ProcessOutput.feed`.

        """
        self.output.feed(stream, data)
        event_class = ProcessStdout if stream == 1 else ProcessStderr
        event = event_class(text=data, **self._event_details())
        if self._context.would_handle_event(event):
            self._context.emit_event_sync(event)

    def end(self, return_code: int, *, was_interrupted: bool) -> None:
        """
        Report the end of the process; an unexpected failure is noted, with its last lines.

        Parameters
        ----------
        return_code
            The exit status, negative for a signal.
        was_interrupted
            Whether the launch has ended the process.

        """
        self.output.flush()
        if return_code == 0:
            self._logger.info('process has finished cleanly [pid %s]', self.pid)
        else:
            self._logger.error(
                "process has died [pid %s, exit code %s, cmd '%s'].",
                self.pid,
                return_code,
                self._command_line(),
            )
            if not was_interrupted:
                self._context.run.note_failure(return_code)
                self.output.show_last_lines()
        self._context.emit_event_sync(
            ProcessExited(returncode=return_code, **self._event_details())
        )

    def _command_line(self) -> str:
        return ' '.join(self._details['cmd'])

    def _event_details(self) -> dict[str, Any]:
        return {
            'action': self._action,
            'pid': self.pid,
            **{key: self._details[key] for key in ('name', 'cmd', 'cwd', 'env')},
        }


class LineSplitter:
    """Splitter that collects bytes and returns complete lines."""

    def __init__(self) -> None:
        self._pieces: list[bytes] = []
        self._size = 0

    def feed(self, data: bytes) -> list[str]:
        """
        Add bytes, and return the lines that they complete.

        Parameters
        ----------
        data
            The next bytes of the stream.

        Returns
        -------
        list of str
            The lines without line breaks; one that is longer than 1 MiB is split.

        """
        if b'\n' in data:
            lines, _, rest = b''.join([*self._pieces, data]).rpartition(b'\n')
            self._keep(rest)
            return _decode(lines)
        self._pieces.append(data)
        self._size += len(data)
        return self._cut() if self._size > _LONGEST else []

    def _keep(self, rest: bytes) -> None:
        self._pieces = [rest] if rest else []
        self._size = len(rest)

    def _cut(self) -> list[str]:
        """Return the incomplete line, except for a trailing incomplete UTF-8 character."""
        text = b''.join(self._pieces)
        tail = 1
        while tail < 4 and 0x80 <= text[-tail] < 0xC0:
            tail += 1
        end = len(text) - (tail if text[-tail] >= 0xC0 else 0)
        self._keep(text[end:])
        return _decode(text[:end])

    def flush(self) -> list[str]:
        """Return the text after the last line break as a line, if there is any."""
        rest = b''.join(self._pieces)
        self._keep(b'')
        return _decode(rest) if rest else []


def _decode(data: bytes) -> list[str]:
    """Decode lines, and strip the carriage returns that a pseudo terminal adds."""
    lines = data.decode('utf-8', 'replace').split('\n')
    return [line.rstrip('\r') for line in lines] if b'\r' in data else lines


class LineFormat:
    """
    Format of the output lines of a process, applied to many lines at once if possible.

    Parameters
    ----------
    text
        The brace-style format, with the fields `line` and `this`.
    this
        The action, for the field `this`.

    """

    def __init__(self, text: str, this: Any) -> None:
        self._text = text
        self._this = this
        self._frame = _frame_of(text, this)

    def apply(self, lines: Sequence[str]) -> str:
        """
        Format lines for the log.

        Parameters
        ----------
        lines
            The lines, without line breaks.

        Returns
        -------
        str
            The formatted lines, with line breaks between them.

        """
        if self._frame is None:
            return '\n'.join(self._text.format(line=line, this=self._this) for line in lines)
        head, tail = self._frame
        between = f'{tail}\n{head}'
        return f'{head}{between.join(lines)}{tail}'


def _frame_of(text: str, this: Any) -> Optional[tuple[str, str]]:
    """Return the text before and after each line, None if the format is more complex."""
    head, place, tail = text.partition(_PLACE)
    if not place:
        return None
    try:
        return head.format(this=this), tail.format(this=this)
    except (KeyError, ValueError, IndexError):
        return None
