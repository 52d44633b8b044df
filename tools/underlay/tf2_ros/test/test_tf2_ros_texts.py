# SPDX-License-Identifier: Apache-2.0
"""What the programs print."""

from __future__ import annotations

from math import pi, sqrt

from tf2_messages import stamped
from tf2_ros.tf2_echo import echo_text
from tf2_ros.tf2_monitor import Delays, report, Traffic


def test_echo() -> None:
    """The transform with its time, its rotation in four forms, and as many digits as wanted."""
    half = sqrt(0.5)
    message = stamped('map', 'base', 12.5, (1, -2, 10), (0, 0, half, half))
    assert echo_text(message, 3).splitlines() == [
        'At time 12.500000000',
        '- Translation: [1.000, -2.000, 10.000]',
        '- Rotation: in Quaternion (xyzw) [0.000, 0.000, 0.707, 0.707]',
        f'- Rotation: in RPY (radian) [0.000, 0.000, {pi / 2:.3f}]',
        '- Rotation: in RPY (degree) [0.000, 0.000, 90.000]',
        '- Matrix:',
        '  0.000 -1.000  0.000  1.000',
        '  1.000  0.000  0.000 -2.000',
        '  0.000  0.000  1.000 10.000',
        '  0.000  0.000  0.000  1.000',
    ]
    assert '- Translation: [1.0, -2.0, 10.0]' in echo_text(message, 1)


def test_echo_of_what_does_not_move() -> None:
    """Without a time it is 0.0; a pitch of 90 degrees is no reason for warnings."""
    text = echo_text(stamped('map', 'base', 0.0, (0, 0, 0), (0, sqrt(0.5), 0, sqrt(0.5))), 3)
    assert text.startswith('At time 0.0\n') and '90.000' in text


def test_report() -> None:
    """Delays and rates of all frames, or of a chain."""
    traffic = Traffic()
    traffic.add([('base', 0.25), ('arm', 0.5)])
    traffic.add([('base', 0.75)])
    traffic.net.add(0.5)
    text = report(traffic, {'camera'}, [], 4.0)
    assert text.splitlines() == [
        'RESULTS: for all Frames',
        '',
        'Frames:',
        'Frame: arm, published by <no authority available>, Average Delay: 0.5, Max Delay: 0.5',
        'Frame: base, published by <no authority available>, Average Delay: 0.5, Max Delay: 0.75',
        'Frame: camera, published by <no authority available>, Average Delay: 0, Max Delay: 0',
        '',
        'All Broadcasters:',
        'Node: <no authority available> 0.5 Hz, Average Delay: 0.5, Max Delay: 0.75',
    ]
    chain = report(traffic, {'camera'}, ['map', 'base'], 4.0)
    assert chain.startswith(
        'RESULTS: for map to base\nChain is: map -> base\nNet delay     avg = 0.5: max = 0.5\n'
    )
    assert 'Frame: arm' not in chain


def test_stamps_ahead() -> None:
    """Transforms that come before their time have a negative delay, also the longest one."""
    delays = Delays()
    delays.add(-0.5)
    delays.add(-0.25)
    assert str(delays) == 'Average Delay: -0.375, Max Delay: -0.25'
