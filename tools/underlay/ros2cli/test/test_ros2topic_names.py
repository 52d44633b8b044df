# SPDX-License-Identifier: Apache-2.0
"""Tests of topic names on the command line."""

from __future__ import annotations

import pytest
from ros2cli.names import absolute


@pytest.mark.parametrize('name', ['/a', 'a', 'robot1/joint_commands', '_hidden/x'])
def test_the_leading_slash_may_be_left_out(name: str) -> None:
    """A name becomes absolute."""
    assert absolute(name) == '/' + name.lstrip('/')


@pytest.mark.parametrize('name', ['', '/', '/bad name', 'a/', '//a', '1a', 'a/2b', 'é'])
def test_what_can_be_no_topic_is_refused(name: str) -> None:
    """Nobody waits for a topic that cannot exist."""
    with pytest.raises(RuntimeError, match='is not a valid topic name'):
        absolute(name)
