# SPDX-License-Identifier: Apache-2.0
"""The log directory of one run."""

from __future__ import annotations

import os
import time

from launch.logging._screen import screen


def base_directory() -> str:
    """Return the base directory that contains the log directories of all runs."""
    explicit = os.environ.get('ROS_LOG_DIR')
    if explicit:
        return os.path.abspath(os.path.expanduser(explicit))
    home = os.environ.get('ROS_HOME') or os.path.join('~', '.ros')
    return os.path.abspath(os.path.join(os.path.expanduser(home), 'log'))


def run_directory() -> str:
    """Return the path of the log directory for a run that starts now."""
    now = _now_text(time.time())
    return os.path.join(base_directory(), f'{now}-{os.uname().nodename}-{os.getpid()}')


def make_run_directory() -> str:
    """Create the log directory of this run, and point the link `latest` to it."""
    path = run_directory()
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        raise RuntimeError(
            f"the folder '{path}' for the log files cannot be made: {error.strerror}; set "
            'ROS_LOG_DIR to a folder in which you may write'
        ) from error
    _point_latest_at(os.path.dirname(path), path)
    return path


def _now_text(now_s: float) -> str:
    """Format a local time with microseconds, such that the strings sort by time."""
    microseconds = int(now_s % 1 * 1e6)
    return f'{time.strftime("%Y-%m-%d-%H-%M-%S", time.localtime(now_s))}-{microseconds:06d}'


def _point_latest_at(base: str, path: str) -> None:
    """Replace the link `latest` atomically."""
    latest = os.path.join(base, 'latest')
    if os.path.exists(latest) and not os.path.islink(latest):
        screen.write_line(
            f"[WARNING] [launch]: '{latest}' is not a symbolic link and stays as it is, so it "
            'does not lead to the log files of this run'
        )
        return
    temporary = f'{latest}.{os.getpid()}'
    try:
        os.symlink(path, temporary)
        os.replace(temporary, latest)
    except OSError:
        _remove_quietly(temporary)


def _remove_quietly(path: str) -> None:
    """Remove a file, and ignore errors."""
    try:
        os.unlink(path)
    except OSError:
        pass
