# SPDX-License-Identifier: Apache-2.0
"""Print the transform between two frames periodically: `ros2 run tf2_ros tf2_echo`."""

from __future__ import annotations

import argparse
import sys

from tf2_ros.argument_types import number_in
from tf2_ros.program import run, spin

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
        description='Print where the target frame is in the source frame, again and again. This '
        'is also the transform that takes data from the target frame to the source frame.',
    )
    parser.add_argument('source_frame', help='the frame in which the other one is looked for')
    parser.add_argument('target_frame', help='the frame that is looked for')
    rate = number_in(1e-6, 1e6, 'rate in Hz')
    parser.add_argument('rate', nargs='?', type=rate, default=1.0, help='in Hz; 1 if not given')
    parser.add_argument(
        '-p', '--precision', type=_digits, default=3, help='digits after the point; 3 if not given'
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
        from tf2_ros._echo_text import echo_text

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


if __name__ == '__main__':
    sys.exit(main())
