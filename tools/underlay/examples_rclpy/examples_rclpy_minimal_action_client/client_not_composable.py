# SPDX-License-Identifier: Apache-2.0
"""
The executable `client_not_composable`.

The genuine package shows a client of functions instead of a class. For its server it is the same
client, so that one implementation serves both names.
"""

from __future__ import annotations

import sys

from examples_rclpy_minimal_action_client.client import main

__all__ = ['main']


if __name__ == '__main__':
    sys.exit(main())
