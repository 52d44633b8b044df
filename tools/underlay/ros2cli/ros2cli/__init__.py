# SPDX-License-Identifier: Apache-2.0
"""The framework of the `ros2` command line: commands, verbs, exit status and the graph node."""
