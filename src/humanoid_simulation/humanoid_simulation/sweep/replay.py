# SPDX-License-Identifier: Apache-2.0
"""
Show a finished run of a sweep: `ros2 run humanoid_simulation replay`.

Physics and walking are imported in the node, where Ctrl-C ends cleanly, and as for the run itself:
with the same environment.
"""

from __future__ import annotations

import os
import sys

from humanoid_common.running import run_node
from humanoid_simulation.sweep import ENVIRONMENT
from rclpy.node import Node


def main() -> int:
    """Run the node."""
    return run_node(_replay)


def _replay() -> Node:
    """Import and create the node."""
    os.environ.update(ENVIRONMENT)
    from humanoid_simulation.sweep.replay_node import Replay

    return Replay()


if __name__ == '__main__':
    sys.exit(main())
