# SPDX-License-Identifier: Apache-2.0
"""Report that log files cannot be written, as on a full disk, once for a launch with its nodes."""

from __future__ import annotations

import re

from launch.logging._screen import screen

_NODE_ERROR = re.compile(
    r'\[\*\*\* LOG ERROR #\d+ \*\*\*\] .*\{Failed writing to file (?P<path>.*): (?P<reason>.*)\}'
)
"""Error that spdlog, which writes the log files of nodes, prints each second on a failure."""


class LostFiles:
    """Reporter of log files that cannot be written: each reason once, with the first file."""

    def __init__(self) -> None:
        self._reasons: set[str] = set()

    def add(self, path: str, reason: str) -> None:
        """
        Report a log file that cannot be written any more, unless the reason has been reported.

        Parameters
        ----------
        path
            The path of the file.
        reason
            Why it cannot be written.

        """
        if reason not in self._reasons:
            self._reasons.add(reason)
            screen.write_line(
                f"[WARNING] [launch]: log files cannot be written any more, '{path}' first: "
                f'{reason}. All else goes on; make room there, or set ROS_LOG_DIR to another '
                'folder at the next start.'
            )

    def without_errors(self, lines: list[str]) -> list[str]:
        """
        Filter out, and report, a node's messages that its log file cannot be written.

        Parameters
        ----------
        lines
            The lines of the output.

        Returns
        -------
        list of str
            The lines without these messages.

        """
        kept = []
        for line in lines:
            found = _NODE_ERROR.match(line) if line.startswith('[***') else None
            if found is None:
                kept.append(line)
            else:
                self.add(found['path'], found['reason'])
        return kept
