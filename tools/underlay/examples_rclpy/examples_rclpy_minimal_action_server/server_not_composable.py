# SPDX-License-Identifier: Apache-2.0
"""
The executable `server_not_composable`.

The genuine package shows a server of functions instead of a class. For its clients it is the same
server, so that one implementation serves both names.
"""

from __future__ import annotations

import sys

from examples_rclpy_minimal_action_server.server import main

__all__ = ['main']


if __name__ == '__main__':
    sys.exit(main())
