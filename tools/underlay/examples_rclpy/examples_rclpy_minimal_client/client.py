# SPDX-License-Identifier: Apache-2.0
"""A client that does nothing else until it has the response."""

from __future__ import annotations

from collections.abc import Sequence
import sys

from examples_rclpy_minimal_client.client_async_member_function import MinimalClientAsync
from tf2_ros.program import run_node

__all__ = ['main']


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(
        lambda _: MinimalClientAsync('minimal_client'), args, MinimalClientAsync.send_request
    )


if __name__ == '__main__':
    sys.exit(main())
