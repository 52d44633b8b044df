# SPDX-License-Identifier: Apache-2.0
"""
Start the simulator: `ros2 run humanoid_simulation simulator`.

Physics and walk take seconds to load. They are loaded here, where Ctrl-C ends the node in order.
"""

from __future__ import annotations

import os
import sys

from humanoid_common.running import run_node
from rclpy.node import Node

NO_GL = 'disable'
"""This process draws nothing; whatever the user has set, mujoco would load it here, or fail."""


def main() -> int:
    """Run the node."""
    return run_node(_simulator)


def _simulator() -> Node:
    """Load and make the node."""
    os.environ['MUJOCO_GL'] = NO_GL
    from humanoid_simulation.simulator import Simulator

    return Simulator()


if __name__ == '__main__':
    sys.exit(main())
