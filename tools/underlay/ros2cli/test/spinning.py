# SPDX-License-Identifier: Apache-2.0
"""What the processes of the tests have in common."""

from collections.abc import Callable
import signal
import sys

import rclpy
from rclpy.executors import ExternalShutdownException


def run_until_signal(main: Callable[[], None]) -> None:
    """Run `main`, which spins, and end well when a signal comes."""
    try:
        main()
    except (KeyboardInterrupt, ExternalShutdownException):
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        rclpy.try_shutdown()
        sys.exit(0)
