# SPDX-License-Identifier: Apache-2.0
"""Record like `ros2 bag record`, until the console closes standard input."""

from __future__ import annotations

import argparse
import sys

from robot_console.recordings.child import interrupt_self, Lifeline
from ros2bag.api.record_arguments import add_record_arguments, usage_error

__all__ = ['main']


def main() -> None:
    """Run the program, with the options of `ros2 bag record`."""
    Lifeline(interrupt_self)
    parser = argparse.ArgumentParser()
    add_record_arguments(parser)
    args = parser.parse_args()
    error = usage_error(args)
    if error:
        parser.error(error)
    from ros2bag.api.recording import record

    try:
        record(args)
    except RuntimeError as failure:
        sys.exit(str(failure))


if __name__ == '__main__':
    main()
