# SPDX-License-Identifier: Apache-2.0
"""
Start the simulator: `ros2 run humanoid_simulation simulator`.

Physics and walking take seconds to import. They are imported here, where Ctrl-C ends cleanly.
"""

from __future__ import annotations

import os
import sys

from humanoid_common.running import run_node
from rclpy.node import Node

NO_GL = 'disable'
"""This process renders nothing; mujoco would load any OpenGL that the user has set, or fail."""


def main() -> int:
    """Run the node."""
    return run_node(_simulator)


def _simulator() -> Node:
    """Import and create the node."""
    os.environ['MUJOCO_GL'] = NO_GL
    from humanoid_simulation.simulator import Simulator

    return Simulator()


if __name__ == '__main__':
    sys.exit(main())
