# SPDX-License-Identifier: Apache-2.0
"""Which frames hang together, however many there are and however they are connected."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rviz_common.visualizer.global_options import _tops


class Counting(dict[str, str]):
    """Parents that count how often they are asked for."""

    asked = 0

    def get(self, name: str, default: Any = None) -> Any:
        """Return a parent."""
        self.asked += 1
        return super().get(name, default)


def chain(count: int) -> Counting:
    """Return the parents of frames, each below the one before."""
    parents = Counting({f'd{index}': f'd{index - 1}' for index in range(1, count)})
    parents['d0'] = 'NO_PARENT'
    return parents


def tops(parents: Mapping[str, str]) -> dict[str, str]:
    """Return the top of each frame that is a child or a parent."""
    return _tops({*parents, *parents.values()} - {'NO_PARENT'}, parents)


def test_trees() -> None:
    """Each frame is below the top of its own tree."""
    parents = {'base': 'odom', 'arm': 'base', 'leg': 'base', 'odom': 'NO_PARENT', 'b': 'a'}
    expected = dict.fromkeys(('odom', 'base', 'arm', 'leg'), 'odom') | {'a': 'a', 'b': 'a'}
    assert tops(parents) == expected


def test_a_long_chain_is_linear() -> None:
    """Each frame is asked for its parent once, also in the order that is worst."""
    parents = chain(5000)
    names = sorted(parents, key=lambda name: int(name[1:]), reverse=True)
    assert set(_tops(names, parents).values()) == {'d0'}
    assert parents.asked == 5000
    parents.asked = 0
    assert set(_tops(reversed(names), parents).values()) == {'d0'}
    assert parents.asked == 5000


def test_circles_end() -> None:
    """Frames that go round have one top, which is one of them; so has what is below."""
    found = tops({'a': 'b', 'b': 'c', 'c': 'a', 'd': 'c', 'e': 'e'})
    assert found['a'] == found['b'] == found['c'] == found['d']
    assert found['a'] in ('a', 'b', 'c')
    assert found['e'] == 'e'
