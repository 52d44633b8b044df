# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs of `ros2 daemon`."""

from collections.abc import Callable
from subprocess import CompletedProcess

import pytest

Ros2 = Callable[..., CompletedProcess[str]]


@pytest.mark.parametrize('words', [['status'], ['start'], ['start', '-d'], ['stop']])
def test_there_is_no_daemon(words: list[str], ros2_here: Ros2) -> None:
    """Each verb says that no daemon runs and why none is needed, and is no error."""
    result = ros2_here('daemon', *words)
    first, second = result.stdout.splitlines()
    assert (result.returncode, result.stderr, first) == (0, '', 'The daemon is not running')
    assert second.startswith('There is none, and none is needed: ')
