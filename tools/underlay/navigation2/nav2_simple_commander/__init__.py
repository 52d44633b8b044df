# SPDX-License-Identifier: Apache-2.0
"""Navigate from a Python program: `from nav2_simple_commander.robot_navigator import ...`."""
