# SPDX-License-Identifier: Apache-2.0
"""What is left undone while nobody looks."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from rviz_common.visualizer.frame_loop import Attention, PATIENCE_S


class Listener:
    """Notes whether it rests."""

    rests = False

    def rest(self) -> None:
        """Rest."""
        self.rests = True

    def resume(self) -> None:
        """Work."""
        self.rests = False


@pytest.fixture
def world() -> SimpleNamespace:
    """Return a time that the test tells, somebody who may look, and a listener."""
    return SimpleNamespace(now_s=100.0, is_watched=False, listener=Listener(), node=object())


def attention(world: SimpleNamespace, may_rest: bool = True) -> Attention:
    """Make what is tested."""
    listener: Any = world.listener
    node: Any = Node()
    return Attention(node, listener, lambda: world.is_watched, may_rest, lambda: world.now_s)


class Node:
    """A node without topics."""


def test_it_rests_until_somebody_looks(world: SimpleNamespace) -> None:
    """It rests from the start, and works for whoever comes, at once."""
    watched = attention(world)
    assert watched.look() and watched.rests and world.listener.rests
    assert not watched.look()
    world.is_watched = True
    assert watched.look() and not watched.rests and not world.listener.rests


def test_a_page_that_is_loaded_again(world: SimpleNamespace) -> None:
    """Somebody who leaves for a moment finds all as it was."""
    watched = attention(world)
    world.is_watched = True
    watched.look()
    world.is_watched = False
    world.now_s += PATIENCE_S / 2.0
    assert not watched.look() and not watched.rests
    world.now_s += PATIENCE_S
    assert watched.look() and world.listener.rests


def test_who_must_not_rest(world: SimpleNamespace) -> None:
    """A page that is to work all the time does."""
    watched = attention(world, may_rest=False)
    assert not watched.look() and not watched.rests and not world.listener.rests
