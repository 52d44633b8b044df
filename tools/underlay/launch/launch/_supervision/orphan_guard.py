# SPDX-License-Identifier: Apache-2.0
"""End the processes of a launch that was killed."""

from __future__ import annotations

import os
import signal
import subprocess
from typing import Optional

# The shell waits in `read`, and gets on only when the launch closes the pipe or dies.
_SCRIPT = """
trap '' INT TERM HUP QUIT
groups=' '
while read -r what group; do
  case $what in
    add) groups="$groups$group " ;;
    end) groups="${groups%% $group *} ${groups#* $group }" ;;
  esac
done
left() {
  for group in $groups; do
    kill -s 0 -- "-$group" 2>/dev/null && return 0
  done
  return 1
}
for signal in INT TERM KILL; do
  left || exit 0
  for group in $groups; do
    kill -s $signal -- "-$group" 2>/dev/null
  done
  tries=0
  while [ $tries -lt 5 ] && left; do
    sleep 0.2
    tries=$((tries + 1))
  done
done
"""


class OrphanGuard:
    """
    Watches over groups of processes from a small process in a session of its own.

    Even if the launch is killed, with no chance to do anything, the groups come to an end.
    """

    def __init__(self) -> None:
        """Create the guard; it starts with the first group."""
        self._shell: Optional[subprocess.Popen[bytes]] = None
        self._pipe = -1

    @property
    def pid(self) -> Optional[int]:
        """Return the id of the watching process, None if there is none."""
        return None if self._shell is None else self._shell.pid

    def add(self, group: int) -> None:
        """Watch over a group."""
        if self._shell is None:
            self._start()
        self._tell(f'add {group}\n')

    def remove(self, group: int) -> None:
        """Watch over a group no longer, as it has ended."""
        self._tell(f'end {group}\n')

    def _start(self) -> None:
        reading_end, self._pipe = os.pipe()
        try:
            self._shell = subprocess.Popen(
                ['/bin/sh', '-c', _SCRIPT],
                stdin=reading_end,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                cwd='/',
                env={'PATH': '/usr/bin:/bin'},
                start_new_session=True,
            )
        finally:
            os.close(reading_end)

    def _tell(self, text: str) -> None:
        """Write to the watching process; one that someone has ended cannot be told."""
        try:
            os.write(self._pipe, text.encode())
        except OSError:
            pass

    def close(self) -> None:
        """End the watching process; it ends what is still in its groups."""
        if self._shell is None:
            return
        os.close(self._pipe)
        self._pipe = -1
        self._shell.send_signal(signal.SIGCONT)  # someone may have stopped it
        self._shell.wait()
        self._shell = None
