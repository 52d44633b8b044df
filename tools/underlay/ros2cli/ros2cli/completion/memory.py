# SPDX-License-Identifier: Apache-2.0
"""
What a node has answered is remembered for some seconds.

Who presses TAB often presses it again, to see the choices or after one more letter.
"""

from __future__ import annotations

from contextlib import suppress
import json
import os
from pathlib import Path
import time
from typing import Any
from urllib.parse import quote

from ros2cli.graph.participants import participant_ports
from ros2cli.graph.reach import read_reach

REMEMBERED_S = 8.0


def recall(subject: str) -> Any:
    """
    Read cached data from the file system.

    Parameters
    ----------
    subject
        The key under which `remember` has stored them.

    Returns
    -------
    Any
        The data; None without any, after 8 s, or when participants on this machine have come or
        gone.

    """
    path = _path(subject)
    try:
        if time.time() - path.stat().st_mtime > REMEMBERED_S:
            return None
        neighbours, data = json.loads(path.read_text(encoding='utf-8'))
    except (OSError, ValueError):
        return None
    return data if neighbours == participant_ports(read_reach().domain_id) else None


def remember(subject: str, data: Any) -> None:
    """
    Cache data in the file system; a failure to do so is ignored.

    The file is replaced in one step, so that a second shell never reads half of it.

    Parameters
    ----------
    subject
        The key, such as the name of the service that was called.
    data
        What JSON can store, except None.

    """
    path = _path(subject)
    new = path.with_name(f'{path.name}.{os.getpid()}')
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        new.write_text(
            json.dumps([participant_ports(read_reach().domain_id), data]), encoding='utf-8'
        )
        new.replace(path)
        return
    with suppress(OSError):
        new.unlink()


def _path(subject: str) -> Path:
    """Return the file for a subject, as seen from this shell."""
    folder = Path(os.environ.get('ROS_HOME') or '~/.ros').expanduser()
    reach = read_reach()
    name = quote(f'{reach.domain_id}_{reach.extent}_{subject}', safe='')
    return folder / 'completion' / f'{name}.json'
