# SPDX-License-Identifier: Apache-2.0
"""Check which method to draw by is next."""

from __future__ import annotations

from humanoid_simulation.camera.ladder import Ladder


def test_what_never_worked_is_given_up() -> None:
    """A method that fails before its first picture is not tried again."""
    ladder = Ladder(['egl', 'rays'])
    assert not ladder.note_end('no library.')
    assert ladder.method == 'rays' and ladder.failures == {'egl': 'no library.'}


def test_what_worked_gets_another_chance() -> None:
    """A method that has drawn is tried again, until it fails three times in a row."""
    ladder = Ladder(['egl', 'rays'])
    ladder.note_picture()
    assert ladder.note_end('killed.') and ladder.note_end('killed.')
    ladder.note_picture()
    assert ladder.note_end('killed.') and ladder.note_end('killed.')
    assert not ladder.note_end('killed.') and ladder.method == 'rays'


def test_none_left() -> None:
    """When all have failed, there is no method."""
    ladder = Ladder(['rays'])
    ladder.note_end('killed.')
    assert ladder.method == ''
