# SPDX-License-Identifier: Apache-2.0
"""Check the rendering methods, the order in which they are tried, and what is said of them."""

from __future__ import annotations

from humanoid_simulation.camera.methods import environment_of, Ladder, methods_of, success_sentence


def test_order() -> None:
    """The best method comes first; a chosen one is the only one."""
    assert methods_of('auto') == ('egl', 'osmesa', 'rays')
    assert methods_of('osmesa') == ('osmesa',)


def test_environment() -> None:
    """Each method has its own environment, whatever the user has set."""
    given = {'MUJOCO_GL': 'glfw', 'PYOPENGL_PLATFORM': 'glx', 'HOME': '/root'}
    chosen = environment_of('egl', given)
    assert chosen['PYOPENGL_PLATFORM'] == 'egl' and chosen['MUJOCO_GL'] == 'disable'
    assert 'PYOPENGL_PLATFORM' not in environment_of('rays', given)
    assert chosen['HOME'] == '/root' and given['MUJOCO_GL'] == 'glfw'


def test_chosen_rays_are_no_reason_to_complain() -> None:
    """Only rays that nobody has asked for come with a way out."""
    assert 'apt' not in success_sentence('rays', {})
    assert 'apt install' in success_sentence('rays', {'egl': 'no library.'})


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
