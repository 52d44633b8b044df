# SPDX-License-Identifier: Apache-2.0
"""Publish a static transform: `ros2 run tf2_ros static_transform_publisher`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
import random
import string
import sys
from typing import TYPE_CHECKING

from tf2_ros.program import run, spin

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.node import Node

_NUMBERS = {
    'x': 'x component of the translation in metres',
    'y': 'y component of the translation',
    'z': 'z component of the translation',
    'qx': 'x component of the quaternion',
    'qy': 'y component of the quaternion',
    'qz': 'z component of the quaternion',
    'qw': 'w component of the quaternion',
    'roll': 'rotation about x in radians',
    'pitch': 'rotation about y in radians',
    'yaw': 'rotation about z in radians',
}
_EULER = ('roll', 'pitch', 'yaw')
_QUATERNION = ('qx', 'qy', 'qz', 'qw')
_OLD_STYLE = {
    8: ('x', 'y', 'z', 'yaw', 'pitch', 'roll'),
    9: ('x', 'y', 'z', 'qx', 'qy', 'qz', 'qw'),
}
_OLD_STYLE_WARNING = 'Old-style arguments are deprecated; see --help for new-style arguments'


def main() -> int:
    """Run the program; return the exit status."""
    return run(parsed, _publish)


def _publish(transform: _StaticTransform) -> None:
    """Publish the transform until the program is stopped."""
    from rclpy.node import Node
    from tf2_ros.static_transform_broadcaster import StaticTransformBroadcaster

    letters = ''.join(random.choices(string.ascii_letters + string.digits, k=16))
    node = Node(f'static_transform_publisher_{letters}')
    if transform.is_old_style:
        node.get_logger().warning(_OLD_STYLE_WARNING)
    StaticTransformBroadcaster(node).sendTransform(_message(transform, node))
    node.get_logger().info(_report(transform))
    spin(node)


def _message(transform: _StaticTransform, node: Node) -> TransformStamped:
    from geometry_msgs.msg import TransformStamped

    message = TransformStamped(child_frame_id=transform.child_frame_id)
    message.header.frame_id = transform.frame_id
    message.header.stamp = node.get_clock().now().to_msg()
    place, turn = message.transform.translation, message.transform.rotation
    place.x, place.y, place.z = transform.translation
    turn.x, turn.y, turn.z, turn.w = transform.rotation
    return message


def _report(transform: _StaticTransform) -> str:
    translation = ', '.join(f"'{number:f}'" for number in transform.translation)
    rotation = ', '.join(f"'{number:f}'" for number in transform.rotation)
    return (
        'Spinning until stopped - publishing transform\n'
        f'translation: ({translation})\n'
        f'rotation: ({rotation})\n'
        f"from '{transform.frame_id}' to '{transform.child_frame_id}'"
    )


@dataclass(frozen=True)
class _StaticTransform:
    """Pose of a child frame in its parent frame."""

    frame_id: str
    child_frame_id: str
    translation: tuple[float, float, float]
    rotation: tuple[float, float, float, float]
    is_old_style: bool = False


def parsed(arguments: Sequence[str]) -> _StaticTransform:
    """
    Parse the command line of static_transform_publisher.

    Parameters
    ----------
    arguments : Sequence[str]
        The arguments after the program name, without ROS arguments; options or the old
        positional style.

    Returns
    -------
    StaticTransform
        Pose of the child frame in its parent: translation in m, quaternion x, y, z, w.

    Raises
    ------
    SystemExit
        Help was requested, or the arguments are invalid, which a message on stderr explains.

    """
    parser = _parser()
    if arguments and not any(word.startswith('--') or word == '-h' for word in arguments):
        return _old_style(parser, arguments)
    _refuse_unknown_options(parser, arguments)
    known = parser.parse_args(_joined(arguments))
    given = {name: vars(known)[name] for name in _NUMBERS if vars(known)[name] is not None}
    return _transform(parser, given, known.frame_id, known.child_frame_id)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='static_transform_publisher',
        allow_abbrev=False,
        description='Publish the static transform between two frames as long as the program runs.',
        epilog='The rotation is a quaternion or roll, pitch and yaw. Deprecated: the arguments '
        'x y z yaw pitch roll frame_id child_frame_id, or x y z qx qy qz qw frame_id '
        'child_frame_id.',
    )
    for name, text in _NUMBERS.items():
        parser.add_argument(f'--{name}', type=_number, help=text)
    parser.add_argument('--frame-id', required=True, help='the parent frame')
    parser.add_argument('--child-frame-id', required=True, help='the child frame')
    return parser


def _refuse_unknown_options(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    """Exit with a suggestion on unknown options, before argparse reports missing ones."""
    known = ['--help', '--frame-id', '--child-frame-id', *(f'--{name}' for name in _NUMBERS)]
    for word in arguments:
        option = word.partition('=')[0]
        if option.startswith('--') and option not in known:
            from ros_environment.suggestions import did_you_mean

            hint = did_you_mean(option, known) or f'The options are: {", ".join(known)}'
            parser.error(f"there is no option '{option}'. {hint}")


def _old_style(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> _StaticTransform:
    if _ends_with_period(arguments):
        parser.error(
            f"'{arguments[-1]}' is the period that ROS 1 had: leave it out, as ROS 2 publishes a "
            'static transform once, and late subscribers get it, too'
        )
    names = _OLD_STYLE.get(len(arguments))
    if names is None:
        parser.error(
            f'{len(arguments)} arguments are neither x y z yaw pitch roll frame_id child_frame_id '
            'nor x y z qx qy qz qw frame_id child_frame_id'
        )
    try:
        given = {name: _number(word) for name, word in zip(names, arguments)}
    except argparse.ArgumentTypeError as error:
        parser.error(str(error))
    frame, child = arguments[-2:]
    return _transform(parser, given, frame, child, is_old_style=True)


def _ends_with_period(arguments: Sequence[str]) -> bool:
    """Whether a period follows the two frames, as in ROS 1."""
    return len(arguments) - 1 in _OLD_STYLE and [_is_number(word) for word in arguments[-4:]] == [
        True,
        False,
        False,
        True,
    ]


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _transform(
    parser: argparse.ArgumentParser,
    given: dict[str, float],
    frame: str,
    child: str,
    is_old_style: bool = False,
) -> _StaticTransform:
    if not frame.strip('/') or not child.strip('/'):
        parser.error(f"'{frame}' and '{child}' have to be frame names: neither may be empty")
    for name in (frame, child):
        if name.startswith('/'):
            parser.error(
                f"the frame '{name}' starts with a slash, which tf2 does not allow: "
                f"write '{name.lstrip('/')}'"
            )
    if frame == child:
        parser.error(f"'{frame}' cannot be its own parent: give two different frames")
    x, y, z = (given.get(name, 0.0) for name in ('x', 'y', 'z'))
    return _StaticTransform(
        frame, child, (x, y, z), _rotation(parser, given), is_old_style=is_old_style
    )


def _rotation(
    parser: argparse.ArgumentParser, given: dict[str, float]
) -> tuple[float, float, float, float]:
    euler = [name for name in _EULER if name in given]
    quaternion = [name for name in _QUATERNION if name in given]
    if euler and quaternion:
        parser.error(
            f'--{quaternion[0]} and --{euler[0]} exclude each other: give a quaternion, or roll, '
            'pitch and yaw'
        )
    if any(given[name] for name in euler):
        return _from_euler(*(given.get(name, 0.0) for name in _EULER))
    if not quaternion:
        return (0.0, 0.0, 0.0, 1.0)
    qx, qy, qz, qw = (given.get(name, 0.0) for name in _QUATERNION)
    if 'qw' not in given and not any((qx, qy, qz)):
        qw = 1.0
    length = (qx * qx + qy * qy + qz * qz + qw * qw) ** 0.5
    if abs(length - 1.0) > 1e-3:
        parser.error(
            f'the quaternion ({qx:g} {qy:g} {qz:g} {qw:g}) has the length {length:g} instead of 1'
        )
    return (qx, qy, qz, qw)


def _from_euler(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    from scipy.spatial.transform import Rotation

    qx, qy, qz, qw = Rotation.from_euler('xyz', [roll, pitch, yaw]).as_quat().tolist()
    return (qx, qy, qz, qw)


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f'{text!r} is not a number') from None
    if not isfinite(number):
        raise argparse.ArgumentTypeError(f'{text!r} is not a finite number')
    return number


def _joined(arguments: Sequence[str]) -> list[str]:
    """Join numeric options with their values, which may look like options (-1e-3)."""
    words = list(arguments)
    joined = []
    while words:
        word = words.pop(0)
        if word[2:] in _NUMBERS and word.startswith('--') and words:
            word = f'{word}={words.pop(0)}'
        joined.append(word)
    return joined


if __name__ == '__main__':
    sys.exit(main())
