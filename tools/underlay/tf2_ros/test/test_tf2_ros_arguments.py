# SPDX-License-Identifier: Apache-2.0
"""The arguments of static_transform_publisher."""

from __future__ import annotations

import pytest
from tf2_ros.static_transform_publisher import parsed

FRAMES = ['--frame-id', 'foo', '--child-frame-id', 'bar']


def test_new_style() -> None:
    """Options in any order, also with numbers that look like options; the rest is zero."""
    transform = parsed([*FRAMES, '--z', '-1e-3', '--x=2', '--y', '-3'])
    assert (transform.frame_id, transform.child_frame_id) == ('foo', 'bar')
    assert transform.translation == (2.0, -3.0, -0.001)
    assert transform.rotation == (0.0, 0.0, 0.0, 1.0)
    assert not transform.is_old_style


def test_rotations() -> None:
    """Roll, pitch and yaw turn about fixed axes; a quaternion is taken as it is."""
    turned = parsed([*FRAMES, '--yaw', '1.5707963267948966'])
    assert turned.rotation == pytest.approx((0, 0, 0.5**0.5, 0.5**0.5))
    assert parsed([*FRAMES, '--qx', '1', '--qw', '0']).rotation == (1, 0, 0, 0)
    assert parsed([*FRAMES, '--qx', '1']).rotation == (1, 0, 0, 0)
    assert parsed([*FRAMES, '--qx', '0']).rotation == (0, 0, 0, 1)


def test_old_style() -> None:
    """Eight numbers and names are yaw, pitch and roll; nine a quaternion."""
    euler = parsed('1 2 3 1.57 0.0 -3.14 foo bar'.split())
    assert euler.translation == (1, 2, 3) and euler.is_old_style
    assert euler.rotation == pytest.approx((-0.707388, -0.706825, 0.000563, 0.000563), abs=1e-6)
    quaternion = parsed('-1 2 3 0 0 1 0 foo bar'.split())
    assert quaternion.rotation == (0, 0, 1, 0)


@pytest.mark.parametrize(
    ('words', 'text'),
    [
        (['--x', '1'], 'required: --frame-id, --child-frame-id'),
        ([*FRAMES, '--x', 'one'], "'one' is not a number"),
        ([*FRAMES, '--x', 'nan'], "'nan' is not a finite number"),
        ([*FRAMES, '--yaw', '1', '--qw', '1'], '--qw and --yaw exclude each other'),
        ([*FRAMES, '--qw', '2'], 'the quaternion (0 0 0 2) has the length 2 instead of 1'),
        ([*FRAMES, '--qw', '0.99'], 'the quaternion (0 0 0 0.99) has the length 0.99 instead'),
        (['--frame-id', 'a', '--child-frame-id', 'a'], "'a' cannot be its own parent"),
        (
            ['--frame-id', 'a', '--child-frame-id', '/b'],
            "the frame '/b' starts with a slash, which tf2 does not allow: write 'b'",
        ),
        (
            ['--frame_id', 'a', '--child_frame_id=b'],
            "there is no option '--frame_id'. Did you mean '--frame-id'?",
        ),
        ([*FRAMES, '--wobble', '1'], "there is no option '--wobble'. The options are: --help"),
        ('1 2 3 0 0 0 foo bar 100'.split(), "'100' is the period that ROS 1 had: leave it out"),
        ('1 2 3 0 0 0 1 foo bar 100'.split(), "'100' is the period that ROS 1 had"),
        (
            ['--frame-id', '', '--child-frame-id', 'a'],
            "'' and 'a' have to be frame names: neither may be empty",
        ),
        (['--frame-id', 'a', '--child-frame-id', '/'], "'a' and '/' have to be frame names"),
        (['1', '2', 'foo', 'bar'], '4 arguments are neither x y z yaw pitch roll frame_id'),
        ('1 2 3 4 5 six foo bar'.split(), "'six' is not a number"),
    ],
)
def test_mistakes(words: list[str], text: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Mistakes are named, and the status is 2."""
    with pytest.raises(SystemExit) as caught:
        parsed(words)
    assert caught.value.code == 2
    assert text in ' '.join(capsys.readouterr().err.split())


def test_help(capsys: pytest.CaptureFixture[str]) -> None:
    """The help names the options."""
    with pytest.raises(SystemExit):
        parsed(['-h'])
    assert '--child-frame-id' in capsys.readouterr().out
