# SPDX-License-Identifier: Apache-2.0
"""Format all frames as text, YAML or Graphviz."""

from __future__ import annotations

import re
from typing import NamedTuple

from tf2_py._frame_store import Cache, FrameStore

_SHORTEST_S = 1e-4
_PLAIN = re.compile(r'[\w/][\w/.-]*')


class Branch(NamedTuple):
    """The entry of a frame in a listing."""

    frame: str
    parent: str
    broadcaster: str
    rate_hz: float
    latest_s: float
    oldest_s: float

    @property
    def length_s(self) -> float:
        """Return the time between the oldest and the latest transform."""
        return self.latest_s - self.oldest_s


def branches(store: FrameStore) -> list[Branch]:
    """
    List all frames that have a parent.

    Parameters
    ----------
    store
        The frames.

    """
    return [_branch(frame, cache) for frame, cache in store.known() if cache.samples]


def _branch(frame: str, cache: Cache) -> Branch:
    first, last = cache.samples[0], cache.samples[-1]
    latest_s, oldest_s = last.stamp_ns / 1e9, first.stamp_ns / 1e9
    rate_hz = len(cache.samples) / max(latest_s - oldest_s, _SHORTEST_S)
    return Branch(frame, last.parent, last.authority, rate_hz, latest_s, oldest_s)


def as_yaml(store: FrameStore) -> str:
    """
    Format the frames as YAML, for `tf2_tools view_frames` and the service `tf2_frames`.

    Parameters
    ----------
    store
        The frames.

    Returns
    -------
    str
        A mapping from each child frame to its parent, broadcaster, rate (Hz) and times (s).

    """
    return ''.join(map(_yaml, branches(store))) or '{}'


def _yaml(branch: Branch) -> str:
    return (
        f'{_key(branch.frame)}: \n'
        f'  parent: {_yaml_text(branch.parent)}\n'
        f"  broadcaster: '{branch.broadcaster}'\n"
        f'  rate: {branch.rate_hz:.3f}\n'
        f'  most_recent_transform: {branch.latest_s:.6f}\n'
        f'  oldest_transform: {branch.oldest_s:.6f}\n'
        f'  buffer_length: {branch.length_s:.3f}\n'
    )


def _key(frame: str) -> str:
    """Format a frame as a YAML key, quoted if YAML would parse it differently."""
    return frame if _PLAIN.fullmatch(frame) else _yaml_text(frame)


def _yaml_text(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"


def as_string(store: FrameStore) -> str:
    """
    Format the frames and their parents as text, one per line.

    Parameters
    ----------
    store
        The frames.

    """
    return ''.join(
        f'Frame {branch.frame} exists with parent {branch.parent}.\n' for branch in branches(store)
    )


def as_dot(store: FrameStore) -> str:
    """
    Format the frame tree as a Graphviz graph.

    Parameters
    ----------
    store
        The frames.

    """
    return 'digraph G {\n' + (''.join(map(_arrow, branches(store))) or '"no tf data"\n') + '}\n'


def _arrow(branch: Branch) -> str:
    label = (
        f'Broadcaster: {branch.broadcaster}\\n'
        f'Average rate: {branch.rate_hz:.3f} Hz\\n'
        f'Most recent transform: {branch.latest_s:.6f}\\n'
        f'Buffer length: {branch.length_s:.3f} s\\n'
    )
    return f'{_dot_text(branch.parent)} -> {_dot_text(branch.frame)} [label="{label}"];\n'


def _dot_text(text: str) -> str:
    escaped = text.replace('\\', '\\\\').replace('"', '\\"')
    return f'"{escaped}"'
