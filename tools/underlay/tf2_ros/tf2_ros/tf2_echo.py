# SPDX-License-Identifier: Apache-2.0
"""Print the transform between two frames periodically: `ros2 run tf2_ros tf2_echo`."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
import sys
from typing import Any

from tf2_ros.program import number_in, run, spin

_LOOK_S = 0.1
_LOOKS_UNTIL_WORD = 10
_MOST_DIGITS = 15


def main() -> int:
    """Run the program; return the exit status."""
    return run(_parser().parse_args, _echo)


def _echo(args: argparse.Namespace) -> None:
    spin(Echo(args).node)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='tf2_echo',
        allow_abbrev=False,
        description='Print the pose of the target frame in the source frame, periodically. This '
        'is also the transform that takes data from the target frame to the source frame.',
    )
    parser.add_argument('source_frame', help='the frame in which the pose is given')
    parser.add_argument('target_frame', help='the frame whose pose is printed')
    rate = number_in(1e-6, 1e6, 'rate in Hz')
    parser.add_argument('rate', nargs='?', type=rate, default=1.0, help='in Hz (default: 1)')
    parser.add_argument(
        '-p', '--precision', type=_digits, default=3, help='decimal places (default: 3)'
    )
    return parser


def _digits(text: str) -> int:
    if text not in map(str, range(_MOST_DIGITS + 1)):
        raise argparse.ArgumentTypeError(f'{text!r} is not between 0 and {_MOST_DIGITS} digits')
    return int(text)


class Echo:
    """
    Waits for a transform, then prints it at a fixed rate.

    Parameters
    ----------
    args : argparse.Namespace
        The command line: source_frame, target_frame, rate in Hz, and precision in digits.

    Attributes
    ----------
    node
        The node, to be spun by the caller.

    """

    def __init__(self, args: argparse.Namespace) -> None:
        from rclpy.clock import Clock, ClockType
        from rclpy.node import Node
        from tf2_ros.buffer import Buffer
        from tf2_ros.transform_listener import TransformListener

        self._args = args
        self._looks = 0
        self.node = Node('tf2_echo')
        self._buffer = Buffer()
        self._listener = TransformListener(self._buffer, self.node)
        self._clock = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = self.node.create_timer(_LOOK_S, self._look, clock=self._clock)

    def _look(self) -> None:
        """Print the first transform, or log every second why it is not available."""
        from rclpy.time import Time

        source, target = self._args.source_frame, self._args.target_frame
        is_there, reason = self._buffer.can_transform_core(source, target, Time())
        self._looks += 1
        if is_there:
            self.node.destroy_timer(self._timer)
            period_s = 1.0 / self._args.rate
            self._timer = self.node.create_timer(period_s, self._print, clock=self._clock)
            self._print()
        elif self._looks % _LOOKS_UNTIL_WORD == 0:
            self.node.get_logger().info(f'Waiting for transform {source} ->  {target}: {reason}')

    def _print(self) -> None:
        """Print the latest transform, or the reason why it is not available."""
        from rclpy.time import Time
        from tf2_py import TransformException

        frames = self._args.source_frame, self._args.target_frame
        try:
            message = self._buffer.lookup_transform_core(*frames, Time())
        except TransformException as error:
            now_s = self.node.get_clock().now().nanoseconds / 1e9
            text = f'Failure at {now_s:.6f}\nException thrown:{error}\nThe current list of frames '
            text += f'is:\n{self._buffer.all_frames_as_string()}'
        else:
            text = echo_text(message, self._args.precision)
        print(text, flush=True)


def echo_text(message: Any, precision: int) -> str:
    """
    Format a transform as tf2_echo prints it: translation, quaternion, RPY and matrix.

    Parameters
    ----------
    message
        The `geometry_msgs/TransformStamped`.
    precision
        Digits after the decimal point.

    Returns
    -------
    str
        Several lines: translation in m, rotation also as roll, pitch and yaw in rad and in
        degrees.

    """
    from scipy.spatial.transform import Rotation

    place, turn = message.transform.translation, message.transform.rotation
    translation = [place.x, place.y, place.z]
    quaternion = [turn.x, turn.y, turn.z, turn.w]
    rotation = Rotation.from_quat(quaternion)
    rows = [[*row, x] for row, x in zip(rotation.as_matrix().tolist(), translation)]
    return '\n'.join(
        [
            f'At time {_time(message.header.stamp)}',
            f'- Translation: {_vector(translation, precision)}',
            f'- Rotation: in Quaternion (xyzw) {_vector(quaternion, precision)}',
            f'- Rotation: in RPY (radian) {_vector(_euler(rotation), precision)}',
            f'- Rotation: in RPY (degree) {_vector(_euler(rotation, True), precision)}',
            '- Matrix:',
            *(_row(row, precision) for row in [*rows, [0.0, 0.0, 0.0, 1.0]]),
        ]
    )


def _euler(rotation: Any, degrees: bool = False) -> list[float]:
    """Return roll, pitch and yaw; in gimbal lock (pitch 90 degrees) they are not unique."""
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter('ignore', UserWarning)
        return rotation.as_euler('xyz', degrees=degrees).tolist()  # type: ignore[no-any-return]


def _time(stamp: Any) -> str:
    """Format a time with nanoseconds; that of static transforms is 0.0."""
    if not stamp.sec and not stamp.nanosec:
        return '0.0'
    return f'{stamp.sec}.{stamp.nanosec:09d}'


def _vector(numbers: Iterable[float], precision: int) -> str:
    return '[' + ', '.join(f'{number:.{precision}f}' for number in numbers) + ']'


def _row(numbers: Iterable[float], precision: int) -> str:
    return ''.join(f' {number:{precision + 3}.{precision}f}' for number in numbers)


if __name__ == '__main__':
    sys.exit(main())
